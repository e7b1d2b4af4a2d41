//! Each class tracked as if the others were not there: one tracker of the algorithm per class, all with identities from
//! one source.

use std::collections::BTreeMap;
use std::mem::swap;

use super::{AlgorithmParameters, TrackingAlgorithm};
use crate::buffers::refill;
use crate::error::Error;
use crate::faults::{self, Stage};
use crate::frame::{Detection, Embeddings, Frame};
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::{Neighbourhood, Output, Particle, Track, WeakMove};
use crate::tracker::StepContext;

/// Trackers of classes without live tracks are kept, with what they learnt of the scene, while there are no more
/// classes than this. Class ids are any numbers, so somebody may use very many.
const MOST_IDLE: usize = 256;

/// The trackers by class.
pub struct SeparateClasses {
    parameters: AlgorithmParameters,
    classes: BTreeMap<i32, ClassTracker>,
    /// Rows of the frame by class.
    order: Vec<u32>,
    detections: Vec<Detection>,
    embeddings: Vec<f32>,
    /// Identities for these detections.
    ids: Vec<u64>,
}

struct ClassTracker {
    inner: Box<dyn TrackingAlgorithm>,
    live: usize,
}

impl ClassTracker {
    fn new(parameters: &AlgorithmParameters) -> Self {
        Self { inner: parameters.build().expect("these parameters have been built before"), live: 0 }
    }
}

impl SeparateClasses {
    /// Without tracks; refuses combinations of parameters that make no sense.
    pub fn new(parameters: &AlgorithmParameters) -> Result<Self, Error> {
        parameters.build()?;
        Ok(Self {
            parameters: parameters.clone(),
            classes: BTreeMap::new(),
            order: Vec::new(),
            detections: Vec::new(),
            embeddings: Vec::new(),
            ids: Vec::new(),
        })
    }

    /// Sorts the rows by class, and sees to it that each class has a tracker.
    fn sort(&mut self, frame: &Frame<'_>) {
        faults::point(Stage::ClassSplit);
        let class = |row: u32| frame.detections[row as usize].class_id;
        self.order.clear();
        self.order.extend(0..frame.detections.len() as u32);
        self.order.sort_unstable_by_key(|row| (class(*row), *row));
        for rows in self.order.chunk_by(|a, b| class(*a) == class(*b)) {
            self.classes.entry(class(rows[0])).or_insert_with(|| ClassTracker::new(&self.parameters));
        }
    }

    fn drop_idle(&mut self) {
        if self.classes.len() > MOST_IDLE {
            self.classes.retain(|_, c| c.live > 0);
        }
    }
}

impl TrackingAlgorithm for SeparateClasses {
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output) {
        self.sort(frame);
        let mut live: usize = self.classes.values().map(|c| c.live).sum();
        let mut rest = &self.order[..];
        for (&class, tracker) in &mut self.classes {
            let count = rest.iter().take_while(|row| frame.detections[**row as usize].class_id == class).count();
            let (rows, others) = rest.split_at(count);
            rest = others;
            self.detections.clear();
            self.detections.extend(rows.iter().map(|row| frame.detections[*row as usize]));
            self.embeddings.clear();
            if let Some(all) = &frame.embeddings {
                self.embeddings.extend(rows.iter().flat_map(|row| all.row(*row as usize)));
            }
            let of_class = Frame {
                detections: &self.detections,
                embeddings: frame.embeddings.as_ref().map(|all| Embeddings::new(&self.embeddings, all.dimension)),
                ..*frame
            };
            let others = live - tracker.live;
            let mut context = StepContext {
                max_tracks: context.max_tracks.saturating_sub(others),
                ids: &mut *context.ids,
                ..*context
            };
            // It adds its tracks to everybody's, with rows of its own.
            refill(&mut self.ids, count, 0);
            let listed = lists(output).map(|list| list.len());
            swap(&mut self.ids, &mut output.track_of_detection);
            tracker.inner.step(&of_class, &mut context, output);
            swap(&mut self.ids, &mut output.track_of_detection);
            tracker.live = 0;
            for (list, listed) in lists(output).into_iter().zip(listed) {
                faults::point(Stage::ClassMerge);
                tracker.live += list.len() - listed;
                let indices = list[listed..].iter_mut().filter_map(|track| track.detection_index.as_mut());
                indices.for_each(|index| *index = rows[*index] as usize);
            }
            for (row, id) in rows.iter().zip(&self.ids) {
                output.track_of_detection[*row as usize] = *id;
            }
            live = others + tracker.live;
        }
        self.drop_idle();
    }

    fn reset(&mut self) {
        self.classes.clear();
    }

    #[cfg(feature = "snapshot")]
    fn save(&self, state: &mut Encoder) {
        state.put(&self.classes.len());
        for (class, tracker) in &self.classes {
            faults::point(Stage::Saving);
            state.put(&(class, tracker.live));
            tracker.inner.save(state);
        }
    }

    #[cfg(feature = "snapshot")]
    fn load(&mut self, state: &mut Decoder<'_>) -> Result<(), Error> {
        self.classes.clear();
        for _ in 0..state.take::<usize>()? {
            faults::fallible(Stage::Loading, Error::Snapshot)?;
            let (class, live) = state.take()?;
            let mut tracker = ClassTracker { live, ..ClassTracker::new(&self.parameters) };
            tracker.inner.load(state)?;
            self.classes.insert(class, tracker);
        }
        Ok(())
    }

    fn particles(&self, id: u64) -> &[Particle] {
        self.classes.values().map(|c| c.inner.particles(id)).find(|p| !p.is_empty()).unwrap_or(&[])
    }

    fn neighbourhood(&self, id: u64) -> Neighbourhood<'_> {
        let told = |n: &Neighbourhood<'_>| n.rule != WeakMove::None;
        self.classes.values().map(|c| c.inner.neighbourhood(id)).find(told).unwrap_or_default()
    }
}

fn lists(output: &mut Output) -> [&mut Vec<Track>; 3] {
    [&mut output.reported, &mut output.tentative, &mut output.lost]
}
