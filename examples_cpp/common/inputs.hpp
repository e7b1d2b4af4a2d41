// What a run reads: frames, detections and camera motion, frame by frame.
#pragma once

#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "detector.hpp"
#include "frame_input.hpp"
#include "frame_source.hpp"
#include "gentrack2_camera_motion.hpp"
#include "mot_io.hpp"

namespace examples {

struct InputOptions {
    /// Frames; empty for none, at most one of the two.
    std::string video, images;
    /// Detections: a file or a detector, one of the two.
    std::string det, detector;
    DetectionFilter filter;
    bool normalise_scores = false;
    std::string embeddings;
    int dimension = 0;
    /// `det` has class ids in its eighth field.
    bool classes = false;
    /// Camera motion: a file or an estimate, or none.
    std::string gmc;
    bool estimate_camera_motion = false;
    /// Size of frames that there are no images of.
    std::optional<cv::Size> size;
    /// How many to read; by default all there are.
    std::optional<long> frames;
    /// The detector runs on the first of so many frames, and rests on the others.
    long detect_every = 1;
    /// Frames per second by which frames get timestamps; by default they get none.
    std::optional<double> timestamp_rate;

    bool has_images() const { return !video.empty() || !images.empty(); }
};

class Inputs {
public:
    /// Opens everything. Throws `UserError`.
    explicit Inputs(const InputOptions &options);

    /// Frames per second as the video says, 0 if it does not.
    double frame_rate() { return source_.frame_rate(); }

    /// Number of frames, as far as is known beforehand; 0 if it is not.
    long expected_frames();

    /// Size of the frames that there are no images of: as given, or else large enough for all detections.
    cv::Size plain_size() const;

    /// Reads the next frame into `input`; false at the end.
    bool next(FrameInput &input);

    /// Throws `UserError` if the images ended before the frames that were asked for or have detections.
    void check_end() const;

    /// One line: in how many frames the camera motion could not be estimated, and why.
    std::string camera_summary() const;

private:
    std::optional<long> length() const;
    bool detector_runs() const { return (frame_ - 1) % options_.detect_every == 0; }
    FrameRows rows_of(const cv::Mat &image);
    std::optional<std::int64_t> timestamp() const;
    std::optional<Affine> motion_of(const FrameInput &input);

    InputOptions options_;
    FrameSource source_;
    DetectionFile file_;
    std::unique_ptr<Detector> detector_;
    std::vector<Affine> motions_;
    gentrack2::CameraMotionEstimator estimator_;
    std::map<std::string, long> failures_;
    long frame_ = 0;
};

}  // namespace examples
