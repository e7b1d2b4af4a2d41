//! The algorithms, by name.

#[cfg(feature = "botsort")]
pub mod botsort;
#[cfg(feature = "bytetrack")]
pub mod bytetrack;
#[cfg(feature = "conftrack")]
pub mod conftrack;
#[cfg(feature = "deepsort")]
pub mod deepsort;
#[cfg(feature = "gentrack2")]
pub mod gentrack2;
mod life;
#[cfg(feature = "ocsort")]
pub mod ocsort;
#[cfg(feature = "_kalman")]
mod overlaps;
#[cfg(feature = "_kalman")]
mod pairing;
mod separate_classes;
#[cfg(feature = "smiletrack")]
pub mod smiletrack;
#[cfg(feature = "sort")]
pub mod sort;
#[cfg(feature = "_kalman")]
mod sort_family;
#[cfg(feature = "_kalman")]
mod two_round;

use crate::classes::ClassPolicy;
use crate::error::Error;
use crate::frame::Frame;
use crate::parameters::ParameterSet;
#[cfg(feature = "snapshot")]
use crate::snapshot::{Decoder, Encoder};
use crate::track::{Neighbourhood, Output, Particle};
use crate::tracker::StepContext;

/// What every algorithm can do.
pub trait TrackingAlgorithm: Send {
    /// Advances by one frame, which has been checked, and fills `output`, which is empty but for
    /// `track_of_detection` (all 0).
    fn step(&mut self, frame: &Frame<'_>, context: &mut StepContext<'_>, output: &mut Output);

    /// Forgets all tracks.
    fn reset(&mut self);

    /// Writes down everything that the next steps depend on.
    #[cfg(feature = "snapshot")]
    fn save(&self, state: &mut Encoder);

    /// Takes over what [`TrackingAlgorithm::save`] of a tracker with the same parameters has written.
    #[cfg(feature = "snapshot")]
    fn load(&mut self, state: &mut Decoder<'_>) -> Result<(), Error>;

    /// The particles of a live track.
    fn particles(&self, _id: u64) -> &[Particle] {
        &[]
    }

    /// What guided a live track that has no detection.
    fn neighbourhood(&self, _id: u64) -> Neighbourhood<'_> {
        Neighbourhood::default()
    }
}

/// Declares the registry: per algorithm its name, which is also that of its cargo feature, and its parameters.
macro_rules! algorithms {
    ($($(#[doc = $doc:literal])+ $variant:ident = $name:literal, $parameters:ty;)+) => {
        /// The algorithms that exist.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Algorithm { $($(#[doc = $doc])+ #[cfg(feature = $name)] $variant),+ }

        impl Algorithm {
            /// All of them.
            pub const ALL: &'static [Algorithm] = &[$(#[cfg(feature = $name)] Algorithm::$variant),+];

            /// The name by which it is chosen.
            pub const fn name(self) -> &'static str {
                match self { $(#[cfg(feature = $name)] Algorithm::$variant => $name),+ }
            }

            /// What it is, in a line.
            pub fn description(self) -> &'static str {
                match self { $(#[cfg(feature = $name)] Algorithm::$variant => concat!($($doc),+).trim()),+ }
            }

            /// Names of its parameter presets, the default first.
            pub fn presets(self) -> &'static [&'static str] {
                match self { $(#[cfg(feature = $name)] Algorithm::$variant => <$parameters>::PRESETS),+ }
            }
        }

        /// The parameters of one algorithm.
        // There are few of them, and they are not copied about.
        #[allow(clippy::large_enum_variant)]
        #[derive(Clone, Debug, PartialEq)]
        pub enum AlgorithmParameters { $($(#[doc = $doc])+ #[cfg(feature = $name)] $variant($parameters)),+ }

        impl AlgorithmParameters {
            /// The defaults.
            pub fn defaults(algorithm: Algorithm) -> Self {
                match algorithm {
                    $(#[cfg(feature = $name)] Algorithm::$variant => Self::$variant(Default::default())),+
                }
            }

            /// A named set of values.
            pub fn preset(algorithm: Algorithm, name: &str) -> Option<Self> {
                match algorithm {
                    $(#[cfg(feature = $name)] Algorithm::$variant => <$parameters>::preset(name).map(Self::$variant)),+
                }
            }

            /// As a table.
            pub fn as_set(&self) -> &dyn ParameterSet {
                match self { $(#[cfg(feature = $name)] Self::$variant(p) => p),+ }
            }

            /// As a table to change.
            pub fn as_set_mut(&mut self) -> &mut dyn ParameterSet {
                match self { $(#[cfg(feature = $name)] Self::$variant(p) => p),+ }
            }

            /// A tracker with these parameters; refuses combinations that make no sense.
            pub fn build(&self) -> Result<Box<dyn TrackingAlgorithm>, Error> {
                match self { $(#[cfg(feature = $name)] Self::$variant(p) => p.build()),+ }
            }
        }
    };
}

algorithms! {
    /// GenTrack2: particles guided by swarm optimisation, deterministic association, neighbour-aware updates.
    GenTrack2 = "gentrack2", gentrack2::GenTrack2Parameters;
    /// SORT: a Kalman filter and IoU.
    Sort = "sort", sort::SortParameters;
    /// DeepSORT: SORT with embeddings.
    DeepSort = "deepsort", deepsort::DeepSortParameters;
    /// ByteTrack: IoU in two rounds, high scores first.
    ByteTrack = "bytetrack", bytetrack::ByteTrackParameters;
    /// OC-SORT: SORT steered by observations instead of predictions.
    OcSort = "ocsort", ocsort::OcSortParameters;
    /// BoT-SORT: ByteTrack with camera motion and embeddings.
    BotSort = "botsort", botsort::BotSortParameters;
    /// SMILEtrack: BoT-SORT whose embeddings refuse pairs.
    SmileTrack = "smiletrack", smiletrack::SmileTrackParameters;
    /// ConfTrack: rounds steered by the scores of detections.
    ConfTrack = "conftrack", conftrack::ConfTrackParameters;
}

impl AlgorithmParameters {
    /// A tracker with these parameters that makes of class ids what the policy says.
    pub fn build_for(&self, policy: ClassPolicy) -> Result<Box<dyn TrackingAlgorithm>, Error> {
        match policy {
            ClassPolicy::Ignore | ClassPolicy::SameClass => self.build(),
            ClassPolicy::Separate => Ok(Box::new(separate_classes::SeparateClasses::new(self)?)),
        }
    }
}

impl Algorithm {
    /// The algorithm of that name.
    pub fn from_name(name: &str) -> Result<Self, Error> {
        Self::ALL.iter().copied().find(|a| a.name() == name).ok_or_else(|| Error::UnknownAlgorithm {
            name: name.to_string(),
            known: Self::ALL.iter().map(|a| a.name()).collect::<Vec<_>>().join(", "),
        })
    }
}
