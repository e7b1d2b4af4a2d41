//! Whole sequences of calls of the C ABI.

use std::collections::BTreeSet;
use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

use gentrack2::capi::*;

use super::bytes::Bytes;

/// The trackers, and a name that is none.
pub const ALGORITHMS: [&CStr; 9] =
    [c"gentrack2", c"sort", c"deepsort", c"bytetrack", c"ocsort", c"botsort", c"smiletrack", c"conftrack", c"none"];
const VALUES: [&CStr; 16] = [
    c"0",
    c"1",
    c"true",
    c"false",
    c"0.5",
    c"-1",
    c"1e308",
    c"nan",
    c"inf",
    c"3",
    c"30",
    c"ignore",
    c"same_class",
    c"separate",
    c"paper",
    c"1,2,3,4; 5,6,7,8",
];
/// Keys that are set more often than chance would.
const KEYS: [&CStr; 10] = [
    c"class_policy",
    c"preset",
    c"max_tracks",
    c"max_detections",
    c"frame_rate",
    c"first_id",
    c"particles",
    c"seed",
    c"min_iou",
    c"no_such_key",
];
/// Bytes of an image; larger ones are not handed in.
const PIXELS: usize = 1 << 16;

/// Runs the calls that the bytes say. The contract of the header is kept: pointers are live or NULL.
pub fn run(data: &[u8]) -> Accepted {
    let mut caller = Caller::new(data);
    // So many that long inputs are not slow inputs.
    for _ in 0..96 {
        if caller.bytes.is_empty() {
            break;
        }
        caller.call();
    }
    caller.accepted
}

/// How many frames were accepted that had this, and how many snapshots: what is refused gets nowhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct Accepted {
    pub detections: usize,
    pub embeddings: usize,
    pub images: usize,
    pub camera_motions: usize,
    pub timestamps: usize,
    pub rests: usize,
    pub snapshots: usize,
}

struct Caller<'a> {
    bytes: Bytes<'a>,
    configs: [*mut gt2_config; 2],
    trackers: [*mut gt2_tracker; 2],
    /// Identities that ended, by tracker.
    ended: [BTreeSet<u64>; 2],
    time: i64,
    pixels: Vec<u8>,
    accepted: Accepted,
}

impl Drop for Caller<'_> {
    fn drop(&mut self) {
        // SAFETY: live handles or NULL, used nowhere else.
        unsafe {
            self.configs.iter().for_each(|c| gt2_config_free(*c));
            self.trackers.iter().for_each(|t| gt2_tracker_free(*t));
        }
    }
}

impl<'a> Caller<'a> {
    fn new(data: &'a [u8]) -> Self {
        Self {
            bytes: Bytes::new(data),
            configs: [null_mut(); 2],
            trackers: [null_mut(); 2],
            ended: Default::default(),
            time: 0,
            pixels: (0..PIXELS).map(|i| (i * 31 % 251) as u8).collect(),
            accepted: Accepted::default(),
        }
    }

    fn call(&mut self) {
        let which = self.bytes.below(2);
        match self.bytes.below(16) {
            0 => self.new_config(which),
            1 => self.set_text(which),
            2 => self.set_number(which),
            3 => self.load_toml(which),
            4 => self.read_config(which),
            5 => self.new_tracker(which),
            6 => self.reset(which),
            7 => self.save_and_load(which),
            8 => self.look_around(which),
            _ => self.step(which),
        }
    }

    fn new_config(&mut self, which: usize) {
        let name = self.bytes.pick(&ALGORITHMS);
        let mut made = null_mut();
        // SAFETY: live arguments.
        unsafe {
            if check(gt2_config_new(name.as_ptr(), &mut made)) {
                gt2_config_free(std::mem::replace(&mut self.configs[which], made));
            }
        }
    }

    fn key(&mut self, config: *const gt2_config) -> CString {
        if self.bytes.rarely(3) {
            return CString::from(*self.bytes.pick(&KEYS));
        }
        // SAFETY: a live handle or NULL; the count of NULL is 0.
        let count = unsafe { gt2_config_parameter_count(config) };
        // SAFETY: all zero is a legal output struct.
        let mut info: gt2_parameter_info = unsafe { std::mem::zeroed() };
        if count == 0 {
            return c"seed".into();
        }
        let index = self.bytes.byte() as usize % count;
        // SAFETY: a live handle, an index in range and a live output; keys are static.
        unsafe {
            assert_eq!(gt2_config_parameter_info(config, index, &mut info), GT2_OK);
            CStr::from_ptr(info.key).into()
        }
    }

    fn set_text(&mut self, which: usize) {
        let config = self.configs[which];
        let key = self.key(config);
        let value = match self.bytes.rarely(4) {
            true => CString::new(self.bytes.text().into_iter().filter(|b| *b != 0).collect::<Vec<_>>()).unwrap(),
            false => CString::from(*self.bytes.pick(&VALUES)),
        };
        // SAFETY: a live handle or NULL, and live texts.
        check(unsafe { gt2_config_set(config, key.as_ptr(), value.as_ptr()) });
    }

    fn set_number(&mut self, which: usize) {
        let config = self.configs[which];
        let key = self.key(config);
        let scale = *self.bytes.pick(&[1.0, 10.0, 100.0, 1e4]);
        let value = self.bytes.number(scale);
        // SAFETY: a live handle or NULL, and a live text.
        check(unsafe {
            match self.bytes.below(3) {
                0 => gt2_config_set_number(config, key.as_ptr(), value),
                1 => gt2_config_set_integer(config, key.as_ptr(), value as i64),
                _ => gt2_config_set_boolean(config, key.as_ptr(), self.bytes.below(3) as i32),
            }
        });
    }

    fn load_toml(&mut self, which: usize) {
        let text = self.bytes.text();
        // SAFETY: a live handle or NULL, and a live array.
        check(unsafe { gt2_config_load_toml(self.configs[which], text.as_ptr().cast(), text.len()) });
    }

    fn read_config(&mut self, which: usize) {
        let config = self.configs[which];
        let mut needed = 0;
        let mut buffer = [0 as c_char; 64];
        let capacity = self.bytes.below(buffer.len() + 1);
        let mut copy = null_mut();
        // SAFETY: a live handle or NULL, and live outputs.
        unsafe {
            check(gt2_config_to_toml(config, buffer.as_mut_ptr(), capacity, &mut needed));
            if check(gt2_config_clone(config, &mut copy)) {
                gt2_config_free(copy);
            }
        }
        for index in 0..capacity {
            self.read_parameter(config, index, capacity);
        }

        // SAFETY: a live handle or NULL; the count of NULL is 0.
        unsafe {
            assert_eq!(text(gt2_config_algorithm(config)).is_some(), !config.is_null());
            let presets = gt2_config_preset_count(config);
            assert!((0..presets).all(|index| text(gt2_config_preset_name(config, index)).is_some()));
            assert!(gt2_config_preset_name(config, presets + capacity).is_null());
        }
    }

    /// What a parameter is set to is told in every form, and reads back from its text.
    fn read_parameter(&self, config: *mut gt2_config, index: usize, capacity: usize) {
        // SAFETY: all zero is a legal output struct.
        let mut info: gt2_parameter_info = unsafe { std::mem::zeroed() };
        let mut buffer = [0 as c_char; 256];
        let (mut needed, mut number, mut integer) = (0, 0.0, 0);
        // SAFETY: a live handle or NULL, live outputs, and buffers of the sizes given.
        unsafe {
            if !check(gt2_config_parameter_info(config, index, &mut info)) {
                return;
            }
            check(gt2_config_get(config, info.key, buffer.as_mut_ptr(), capacity, &mut needed));
            if check(gt2_config_get_number(config, info.key, &mut number)) {
                assert!((info.minimum..=info.maximum.max(1.0)).contains(&number));
            }
            if check(gt2_config_get_integer(config, info.key, &mut integer)) {
                assert!(info.kind == GT2_PARAMETER_INTEGER || info.kind == GT2_PARAMETER_BOOLEAN);
            }
            if check(gt2_config_get(config, info.key, buffer.as_mut_ptr(), buffer.len(), null_mut())) {
                let read = text(buffer.as_ptr());
                assert_eq!(gt2_config_set(config, info.key, buffer.as_ptr()), GT2_OK, "{read:?}");
                assert_eq!(gt2_config_get(config, info.key, buffer.as_mut_ptr(), buffer.len(), null_mut()), GT2_OK);
                assert_eq!(text(buffer.as_ptr()), read);
            }
        }
    }

    fn new_tracker(&mut self, which: usize) {
        let mut made = null_mut();
        // SAFETY: a live handle or NULL, and a live output.
        unsafe {
            if check(gt2_tracker_new(self.configs[self.bytes.below(2)], &mut made)) {
                self.replace(which, made);
            }
        }
    }

    fn replace(&mut self, which: usize, made: *mut gt2_tracker) {
        // SAFETY: a live handle or NULL, not used any more.
        unsafe { gt2_tracker_free(std::mem::replace(&mut self.trackers[which], made)) };
        self.ended[which].clear();
    }

    fn reset(&mut self, which: usize) {
        // SAFETY: a live handle or NULL.
        if check(unsafe { gt2_tracker_reset(self.trackers[which]) }) {
            self.ended[which].clear();
        }
    }

    fn save_and_load(&mut self, which: usize) {
        let tracker = self.trackers[which];
        let mut size = 0;
        let mut loaded = null_mut();
        // SAFETY: a live handle or NULL, and live buffers of the sizes given.
        unsafe {
            if !check(gt2_tracker_save(tracker, null_mut(), 0, &mut size)) {
                return;
            }
            let mut bytes = vec![0; size];
            assert_eq!(gt2_tracker_save(tracker, bytes.as_mut_ptr(), size, &mut size), GT2_OK);
            if self.bytes.rarely(2) {
                let at = self.bytes.word() as usize % size;
                let (before, after) = (bytes[at], self.bytes.byte());
                bytes[at] = after;
                let status = gt2_tracker_load(bytes.as_ptr(), size, &mut loaded);
                assert_eq!(status == GT2_OK, before == after, "a damaged snapshot is refused");
            } else {
                assert_eq!(gt2_tracker_load(bytes.as_ptr(), size, &mut loaded), GT2_OK);
            }
        }
        if !loaded.is_null() {
            self.accepted.snapshots += 1;
            let ended = std::mem::take(&mut self.ended[which]);
            self.replace(which, loaded);
            self.ended[which] = ended;
        }
    }

    fn look_around(&mut self, which: usize) {
        let tracker = self.trackers[which];
        // SAFETY: all zero is a legal track.
        let mut buffer: [gt2_track; 4] = unsafe { std::mem::zeroed() };
        let mut needed = 0;
        let mut particles = gt2_particle_list { struct_size: 0, particles: null(), count: 0, stride: 0 };
        // SAFETY: all zero is a legal neighbourhood.
        let mut around: gt2_neighbourhood = unsafe { std::mem::zeroed() };
        let (kind, capacity) = (self.bytes.below(5) as i32 - 1, self.bytes.below(5));
        let element = *self.bytes.pick(&[size_of::<gt2_track>(), 0, 8, 5000]);
        let id = self.bytes.below(40) as u64;
        // SAFETY: a live handle or NULL, and live buffers; an element size that does not fit is refused.
        unsafe {
            check(gt2_tracker_copy_tracks(tracker, kind, buffer.as_mut_ptr(), element, capacity, &mut needed));
            check(gt2_tracker_particles(tracker, id, &mut particles));
            check(gt2_tracker_neighbourhood(tracker, id, &mut around));
            assert_eq!(text(gt2_tracker_algorithm(tracker)).is_some(), !tracker.is_null());
        }
        // What needs no handle.
        let algorithms = gt2_algorithm_count();
        let named = capacity + id as usize;
        for found in [gt2_algorithm_name(named), gt2_algorithm_description(named)] {
            // SAFETY: static texts or NULL.
            assert_eq!(unsafe { text(found) }.is_some(), named < algorithms);
        }
    }

    fn step(&mut self, which: usize) {
        let tracker = self.trackers[which];
        let count = match self.bytes.rarely(8) {
            true => self.bytes.below(64),
            false => self.bytes.below(6),
        };
        let detections: Vec<gt2_detection> = (0..count).map(|_| self.detection()).collect();
        let dimension: usize = *self.bytes.pick(&[0, 0, 4, 4, 4, 1, 7]);
        // Rows of their own length, packed, with room between them, and too short ones.
        let stride = [dimension, dimension, dimension + 3, dimension.saturating_sub(1)][count % 4];
        let room = stride.max(dimension);
        let mut embeddings = vec![f32::NAN; count * room];
        for row in embeddings.chunks_exact_mut(room.max(1)) {
            row[..dimension].fill_with(|| self.bytes.number(1.0) as f32);
        }
        let image = self.image();
        let motion = self.camera_motion();
        // SAFETY: all zero is a legal frame.
        let mut frame: gt2_frame = unsafe { std::mem::zeroed() };
        frame.detections = if count == 0 && self.bytes.rarely(2) { null() } else { detections.as_ptr() };
        frame.detection_count = count;
        frame.detection_stride = *self.bytes.pick(&[0, size_of::<gt2_detection>(), 8]);
        frame.embeddings = if dimension == 0 { null() } else { embeddings.as_ptr() };
        frame.embedding_dimension = dimension;
        frame.embedding_stride = if count % 8 == 1 { 0 } else { stride };
        frame.struct_size = if count % 3 == 0 { 0 } else { size_of::<gt2_frame>() };
        frame.image = image.as_ref().map_or(null(), |i| i);
        frame.camera_motion = motion.as_ref().map_or(null(), |m| m.as_ptr());
        (frame.image_width, frame.image_height) = *self.bytes.pick(&[(0, 0), (640, 480), (64, 48), (0, 9)]);
        frame.has_timestamp = *self.bytes.pick(&[0, 0, 1, 1, 1, 2]);
        frame.timestamp_ns = self.timestamp();
        frame.detector_skipped = *self.bytes.pick(&[0, 0, 0, 0, 0, 1, 7]);
        let before = (!tracker.is_null()).then(|| self.results(tracker));
        // SAFETY: a live handle or NULL, and a frame whose pointers are live and whose counts are true.
        let done = check(unsafe { gt2_tracker_step(tracker, &frame) });
        let Some(before) = before else { return };
        let after = self.results(tracker);
        if done {
            self.count(&frame);
            self.examine(which, &after, count);
        } else {
            assert!(same_bits(&before, &after), "a refused frame changes nothing");
        }
    }

    fn count(&mut self, frame: &gt2_frame) {
        let accepted = &mut self.accepted;
        accepted.detections += usize::from(frame.detection_count > 0);
        accepted.embeddings += usize::from(frame.detection_count > 0 && !frame.embeddings.is_null());
        accepted.images += usize::from(!frame.image.is_null());
        accepted.camera_motions += usize::from(!frame.camera_motion.is_null());
        accepted.timestamps += usize::from(frame.has_timestamp == 1);
        accepted.rests += usize::from(frame.detector_skipped == 1);
    }

    fn detection(&mut self) -> gt2_detection {
        // SAFETY: all zero is a legal detection.
        let mut d: gt2_detection = unsafe { std::mem::zeroed() };
        d.left = self.bytes.number(640.0);
        d.top = self.bytes.number(480.0);
        d.width = self.bytes.number(80.0);
        d.height = self.bytes.number(160.0);
        d.score = self.bytes.number(1.0);
        d.class_id = self.bytes.below(3) as i32 - 1;
        d.reserved = i32::from(self.bytes.byte() == 1);
        d.tag = self.bytes.byte() as u64;
        d
    }

    fn image(&mut self) -> Option<gt2_image> {
        if !self.bytes.rarely(3) {
            return None;
        }
        // SAFETY: all zero is a legal image as far as types go.
        let mut image: gt2_image = unsafe { std::mem::zeroed() };
        image.width = self.bytes.byte() as u32;
        image.height = self.bytes.byte() as u32;
        image.format = self.bytes.below(9) as i32 - 1;
        image.stride = *self.bytes.pick(&[0, 1, 64, 255, 1024]);
        image.struct_size = *self.bytes.pick(&[0, size_of::<gt2_image>(), 4]);
        // Whatever is made of the numbers, it stays within the memory.
        let row = image.stride.max(4 * image.width as usize);
        if row * image.height as usize > PIXELS {
            image.height = (PIXELS / row) as u32;
        }
        image.data = if self.bytes.rarely(16) { null() } else { self.pixels.as_ptr() };
        Some(image)
    }

    fn camera_motion(&mut self) -> Option<[f64; 6]> {
        if !self.bytes.rarely(3) {
            return None;
        }
        let mut motion = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let at = self.bytes.below(6);
        motion[at] = self.bytes.number(2.0);
        Some(motion)
    }

    fn timestamp(&mut self) -> i64 {
        let step = *self.bytes.pick(&[33_333_333, 33_333_333, 1, 0, -5, 1_000_000_000, i64::MAX / 2, i64::MIN / 2]);
        let next = self.time.wrapping_add(step);
        if step.unsigned_abs() < 10_000_000_000 {
            self.time = next;
        }
        next
    }

    fn results(&self, tracker: *const gt2_tracker) -> Results {
        let mut results = Results::default();
        for kind in [GT2_TRACKS_REPORTED, GT2_TRACKS_TENTATIVE, GT2_TRACKS_LOST] {
            let mut list = gt2_track_list { struct_size: 0, tracks: null(), count: 0, stride: 0 };
            // SAFETY: a live handle and a live output; the list is read before the next call.
            unsafe {
                assert_eq!(gt2_tracker_tracks(tracker, kind, &mut list), GT2_OK);
                results.tracks.extend((0..list.count).map(|i| *list.tracks.byte_add(i * list.stride)));
            }
        }
        results.ended = ids(tracker, gt2_tracker_ended);
        results.owners = ids(tracker, gt2_tracker_track_of_detection);
        results
    }

    fn examine(&mut self, which: usize, after: &Results, detections: usize) {
        assert_eq!(after.owners.len(), detections);
        let mut live = BTreeSet::new();
        for t in &after.tracks {
            assert!(live.insert(t.id), "{} is listed twice", t.id);
            assert!(!self.ended[which].contains(&t.id), "{} had ended", t.id);
            let numbers = [t.left, t.top, t.width, t.height, t.velocity_u, t.velocity_v, t.velocity_w, t.velocity_h];
            assert!(numbers.iter().all(|x| x.is_finite()) && t.width >= 0.0 && t.height >= 0.0, "{t:?}");
            assert!(t.detection_index < detections as i64, "{t:?}");
        }
        for id in &after.ended {
            assert!(!live.contains(id) && self.ended[which].insert(*id), "{id} ended twice or lives on");
        }
        for id in after.owners.iter().filter(|id| **id != 0) {
            assert!(live.contains(id), "{id} took a detection and is not there");
        }
    }
}

#[derive(Default)]
struct Results {
    tracks: Vec<gt2_track>,
    ended: Vec<u64>,
    owners: Vec<u64>,
}

fn same_bits(a: &Results, b: &Results) -> bool {
    format!("{:?}", a.tracks) == format!("{:?}", b.tracks) && a.ended == b.ended && a.owners == b.owners
}

type ListIds = unsafe extern "C" fn(*const gt2_tracker, *mut *const u64, *mut usize) -> gt2_status;

fn ids(tracker: *const gt2_tracker, list: ListIds) -> Vec<u64> {
    let (mut start, mut count) = (null(), 0);
    // SAFETY: a live handle and live outputs; the list is read before the next call.
    unsafe {
        assert_eq!(list(tracker, &mut start, &mut count), GT2_OK);
        (0..count).map(|i| *start.add(i)).collect()
    }
}

/// A text of the library's, `None` for NULL.
///
/// # Safety
/// It ends with a NUL.
unsafe fn text<'a>(found: *const c_char) -> Option<&'a str> {
    // SAFETY: not NULL, and the caller's promise.
    (!found.is_null()).then(|| unsafe { CStr::from_ptr(found) }.to_str().expect("texts are UTF-8"))
}

/// Whether a call succeeded. If it did not, it says why, and it is not for a bug.
fn check(status: gt2_status) -> bool {
    if status == GT2_OK {
        return true;
    }
    // SAFETY: statuses have static names.
    assert!(unsafe { text(gt2_status_str(status)) }.is_some_and(|name| name != "unknown status"), "{status}");
    // SAFETY: the text is valid until the next failing call.
    let message = unsafe { CStr::from_ptr(gt2_last_error_message()) }.to_str().expect("messages are UTF-8");
    assert!(status != GT2_ERR_PANIC && status != GT2_ERR_POISONED, "{message}");
    assert!(status < 0 && !message.is_empty());
    false
}
