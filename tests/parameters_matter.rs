//! No parameter of any algorithm is dead: each, set to another value, changes what the tracker makes of at least one of
//! a few scenes. A step that no longer happens, or that no longer listens to its parameter, shows here.

mod simulator;

use gentrack2::parameters::{Kind, ParameterSpec, Value};
use gentrack2::{Algorithm, Config, Detection, Embeddings, Frame, ImageView, PixelFormat, Tracker};
use simulator::contract::all_tracks;
use simulator::scene::{Observation, Scene};
use simulator::stage;

/// Parameters that do nothing, and are there all the same.
const DEAD: [(&str, &str); 8] = [
    // Only GenTrack2 has random numbers; the handle has the seed for all.
    ("sort", "seed"),
    ("deepsort", "seed"),
    ("bytetrack", "seed"),
    ("ocsort", "seed"),
    ("botsort", "seed"),
    ("smiletrack", "seed"),
    ("conftrack", "seed"),
    // It makes the confidence of a lost track fade, and only a tentative track is ever asked for its confidence: so it
    // is in the publication's program.
    ("conftrack", "confidence_decay"),
];

/// What a tracker is given besides detections.
#[derive(Clone, Copy, Debug, Default)]
struct Given {
    image: bool,
    embeddings: bool,
    camera: bool,
    /// Two classes, now and then mistaken for each other.
    classes: bool,
    /// A picture of the scene's left half alone, with whole boxes beyond its border.
    half: bool,
}

const NOTHING: Given = Given { image: false, embeddings: false, camera: false, classes: false, half: false };
const IMAGE: Given = Given { image: true, ..NOTHING };
const EMBEDDINGS: Given = Given { embeddings: true, ..NOTHING };
const CAMERA: Given = Given { camera: true, ..NOTHING };
const HALF: Given = Given { half: true, ..NOTHING };
const CLASSES: Given = Given { classes: true, ..NOTHING };

/// A scene with what the tracker is given of it, and the settings under which a parameter may matter.
struct Setup {
    algorithm: Algorithm,
    scene: Scene,
    seen: Vec<Observation>,
    given: Given,
    settings: &'static [(&'static str, &'static str)],
}

impl Setup {
    fn new(
        algorithm: Algorithm,
        scene: Scene,
        given: Given,
        settings: &'static [(&'static str, &'static str)],
    ) -> Self {
        let seen = scene.play(given.image).collect();
        Self { algorithm, scene, seen, given, settings }
    }

    /// Everything that comes out, particles included; `None` if the settings do not go together.
    fn outcome(&self, key: &str, value: Option<&Value>) -> Option<Vec<String>> {
        let mut config = Config::of(self.algorithm);
        for (key, text) in self.settings {
            config.set_text(key, text).unwrap();
        }
        if let Some(value) = value {
            config.set(key, value).unwrap();
        }
        let mut tracker = Tracker::new(&config).ok()?;
        Some(self.seen.iter().map(|seen| self.step(&mut tracker, seen)).collect())
    }

    fn step(&self, tracker: &mut Tracker, seen: &Observation) -> String {
        let (width, height) = (self.scene.width, self.scene.height);
        let (looks, detections) = (looks(seen), self.detections(seen));
        let image = seen.image.as_ref().filter(|_| self.given.image);
        let result = tracker.step(&Frame {
            detections: &detections,
            image: image.map(|d| ImageView::new(d, width, height, 0, PixelFormat::Gray8).unwrap()),
            size: Some((if self.given.half { width / 2 } else { width }, height)),
            embeddings: self.given.embeddings.then(|| Embeddings::new(&looks, 4)),
            camera_motion: self.given.camera.then_some(seen.camera_motion),
            timestamp_ns: Some((seen.time * 1e9) as i64),
            ..Frame::default()
        });
        match result.cloned() {
            Ok(output) => {
                let particles: Vec<_> = all_tracks(&output).map(|t| tracker.particles(t.id).unwrap()).collect();
                format!("{output:?} {particles:?}")
            }
            Err(error) => error.to_string(),
        }
    }

    fn detections(&self, seen: &Observation) -> Vec<Detection> {
        let class = |row: usize| match self.given.classes {
            true => (seen.source[row].unwrap_or(0) + usize::from((seen.frame + row).is_multiple_of(11))) as i32 % 2,
            false => 0,
        };
        seen.detections.iter().enumerate().map(|(row, d)| Detection { class_id: class(row), ..*d }).collect()
    }
}

/// Each object has its own direction, clutter has one of its own, too; how clear it is varies.
fn looks(seen: &Observation) -> Vec<f32> {
    let doubt = |row: usize| 0.2 + 0.1 * ((seen.frame + 3 * row) % 5) as f32;
    let look = |(row, source): (usize, &Option<usize>)| {
        let own = source.map_or(3, |s| s % 3);
        (0..4).map(move |k| if own == k { 1.0 } else { doubt(row) }).collect::<Vec<_>>()
    };
    seen.source.iter().enumerate().flat_map(look).collect()
}

/// Ten targets, a third of whose detections are missed.
fn crowd() -> Scene {
    Scene { duration: 3.5, ..stage::ten_targets(3, 0.3) }
}

fn setups(algorithm: Algorithm) -> Vec<Setup> {
    let hidden = || stage::full_occlusion(0, 1.0);
    let camera = |swing| Scene { duration: 4.0, ..stage::moving_camera(0, swing) };
    let comings_and_goings = || Scene { duration: 9.0, ..stage::entering_and_leaving(1) };
    let new = |scene, given, settings| Setup::new(algorithm, scene, given, settings);
    let mut setups = vec![
        new(crowd(), NOTHING, &[]),
        new(camera(stage::SLOW_PAN), NOTHING, &[]),
        new(stage::meeting_and_turning_back(0), EMBEDDINGS, &[]),
        new(stage::turn_while_hidden(2), NOTHING, &[]),
        new(comings_and_goings(), NOTHING, &[]),
        new(crowd(), CLASSES, &[]),
        // Few look at images; too large a one all refuse.
        new(Scene { duration: 0.1, ..crowd() }, IMAGE, &[]),
    ];
    let given_more = [
        new(crowd(), EMBEDDINGS, &[]),
        new(hidden(), NOTHING, &[]),
        new(camera(stage::SHAKE), CAMERA, &[]),
        new(camera(stage::SHAKE), Given { embeddings: true, ..CAMERA }, &[]),
    ];
    match algorithm {
        Algorithm::GenTrack2 => setups.extend([
            new(crowd(), IMAGE, &[]),
            new(crowd(), IMAGE, &[("preset", "paper")]),
            new(crowd(), NOTHING, &[("resampling", "discard"), ("particle_source", "prior_particles")]),
            new(crowd(), NOTHING, &[("strong_update", "replace"), ("jump_distance", "0.05")]),
            // Somebody is lost for more than a second.
            new(hidden(), NOTHING, &[("entrance_areas", "0,0,768,576"), ("fitness_floor", "0")]),
            new(hidden(), IMAGE, &[("preset", "paper")]),
            // Nobody moves as predicted, and the gates are narrow.
            new(camera(stage::SHAKE), NOTHING, &[]),
            new(camera(stage::SHAKE), CAMERA, &[]),
            new(crowd(), NOTHING, &[("cost_gate", "0.15")]),
            new(crowd(), EMBEDDINGS, &[("cost_gate", "0.1"), ("min_iou", "0.02")]),
            new(hidden(), NOTHING, &[("reacquire_reach", "0")]),
            // Many have no better scores than a birth needs.
            new(comings_and_goings(), HALF, &[("birth_score", "0.88")]),
            // Those who were lost come back, sooner than anybody could go far and beside others.
            new(stage::turning_back_unseen(0), IMAGE, &[("recognition_speed", "0.001")]),
            new(stage::turning_back_unseen(0), IMAGE, &[("recognition_margin", "0.2")]),
            new(crowd(), IMAGE, &[("cost_gate", "0.02"), ("hog_gate", "0.1"), ("recognition_margin", "0.01")]),
        ]),
        Algorithm::OcSort => {
            setups.extend(given_more);
            // The low scores in question are those between the thresholds.
            setups.push(new(crowd(), NOTHING, &[("use_byte", "true"), ("det_thresh", "0.8")]));
        }
        Algorithm::ByteTrack | Algorithm::BotSort | Algorithm::SmileTrack | Algorithm::ConfTrack => {
            setups.extend(given_more);
            // Where next to no pair is too dear it does not matter what it costs.
            setups.push(new(crowd(), NOTHING, &[("match_thresh", "0.4")]));
        }
        Algorithm::Sort | Algorithm::DeepSort => setups.extend(given_more),
    }
    match algorithm {
        Algorithm::BotSort => setups.push(new(crowd(), EMBEDDINGS, &[("appearance_thresh", "0.03")])),
        Algorithm::SmileTrack => setups.push(new(crowd(), EMBEDDINGS, &[("similarity_gate", "0.1")])),
        // Who is lost is seldom found again, and a new track in its place is doubtful for a while.
        Algorithm::ConfTrack => {
            setups.push(new(crowd(), NOTHING, &[("proximity_thresh", "0.2"), ("confirm_thresh", "1")]));
        }
        _ => {}
    }
    setups
}

/// Other values than the default, those that change the most first.
fn alternatives(spec: &ParameterSpec) -> Vec<Value> {
    match (&spec.kind, &spec.default) {
        (Kind::Float, Value::Float(default)) => {
            [spec.minimum, spec.maximum, 0.5 * default, 2.0 * default].map(Value::Float).to_vec()
        }
        (Kind::Integer, Value::Integer(default)) => vec![
            Value::Integer(spec.minimum as i64),
            Value::Integer(default - 1),
            Value::Integer(default + 1),
            Value::Integer(spec.minimum as i64 + 1),
        ],
        (Kind::Boolean, Value::Boolean(default)) => vec![Value::Boolean(!default)],
        (Kind::Choice(names), Value::Choice(default)) => {
            names.iter().filter(|name| *name != default).map(|name| Value::Choice(name)).collect()
        }
        (Kind::Areas, _) => vec![spec.parse("0,0,384,576").unwrap()],
        other => panic!("{other:?}"),
    }
}

/// The parameters of an algorithm that change nothing.
fn dead_parameters(algorithm: Algorithm) -> Vec<&'static str> {
    let setups = setups(algorithm);
    let before: Vec<_> = setups.iter().map(|s| s.outcome("", None).expect("the settings go together")).collect();
    let is_dead = |spec: &&ParameterSpec| {
        let in_range = |value: &Value| *value != spec.default && spec.check(value).is_ok();
        let values: Vec<Value> = alternatives(spec).into_iter().filter(in_range).collect();
        let matters = |(setup, before): (&Setup, &Vec<String>)| {
            values.iter().any(|value| setup.outcome(spec.key, Some(value)).is_some_and(|after| after != *before))
        };
        !setups.iter().zip(&before).any(matters)
    };
    Config::of(algorithm).specs().filter(is_dead).map(|spec| spec.key).collect()
}

for_every_algorithm! {
    fn every_parameter_changes_something(algorithm: Algorithm) {
        let known = DEAD.iter().filter(|(name, _)| *name == algorithm.name());
        let mut known: Vec<&str> = known.map(|(_, key)| *key).collect();
        let mut dead = dead_parameters(algorithm);
        known.sort_unstable();
        dead.sort_unstable();
        assert_eq!(dead, known, "parameters that change nothing");
    }
}
