//! The parameters that the family shares.

/// Declares the parameters of a member of the family: the shared ones, of which two have defaults of their own, and
/// its own.
macro_rules! two_round_parameters {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            match_thresh = $match_thresh:literal;
            use_camera_motion = $use_camera_motion:literal;
            $($own:tt)*
        }
    ) => {
        $crate::parameters::parameters! {
            $(#[$meta])*
            pub struct $name {
                /// Detections of a greater score are matched first. One of exactly this score is ignored.
                track_high_thresh: f64 = 0.6, [0.0, 1.0], "", "";
                /// Detections of a score between this one and track_high_thresh, both exclusive, are matched second;
                /// the rest is ignored.
                track_low_thresh: f64 = 0.1, [0.0, 1.0], "", "";
                /// Smallest score of a detection that starts a track. It must also exceed track_high_thresh.
                new_track_thresh: f64 = 0.7, [0.0, 1.0], "", "";
                /// Largest cost of a pair in the first round: confirmed and lost tracks, high scores. Leaving both
                /// sides unmatched costs as much.
                match_thresh: f64 = $match_thresh, [0.0, 1.0], "", "";
                /// The same in the second round: confirmed tracks left over, low scores, 1 - IoU.
                second_match_thresh: f64 = 0.5, [0.0, 1.0], "", "";
                /// The same in the third round: unconfirmed tracks, high scores left over.
                unconfirmed_match_thresh: f64 = 0.7, [0.0, 1.0], "", "";
                /// Time for which a lost track is kept: frames at 30 frames per second. At frame_rate it is
                /// frame_rate/30 times as many, rounded down.
                track_buffer: i64 = 30, [0, 1_000_000], "frames", "";
                /// Whether the IoU counts in proportion to the detection's score.
                fuse_score: bool = true, [], "", "";
                /// Of a tracked and a lost track with a smaller 1 - IoU the one of the shorter life is dropped.
                duplicate_thresh: f64 = 0.15, [0.0, 1.0], "", "";
                /// Whether tracks go along with the camera, where its motion is given. With bytetrack not in the
                /// publication.
                use_camera_motion: bool = $use_camera_motion, [], "", "";
                $($own)*
            }
        }

        impl $name {
            /// What is the same for the whole family.
            fn shared_rules(&self) -> $crate::trackers::two_round::Rules {
                $crate::trackers::two_round::Rules {
                    high_score: self.track_high_thresh,
                    low_score: self.track_low_thresh,
                    new_track_score: self.new_track_thresh,
                    limits: [self.match_thresh, self.second_match_thresh, self.unconfirmed_match_thresh],
                    buffer: self.track_buffer as f64,
                    fuse_score: self.fuse_score,
                    duplicate_distance: self.duplicate_thresh,
                    report_unconfirmed: false,
                    follow_camera: self.use_camera_motion,
                    looks: $crate::trackers::two_round::Looks::Unused,
                    momentum: 0.0,
                    smallest_width: 0.0,
                }
            }
        }
    };
}
pub(in crate::trackers) use two_round_parameters;
