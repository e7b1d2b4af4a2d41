// The tracker as this program uses it: the only file that calls gentrack2.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "mot_io.hpp"
#include "options.hpp"
#include "timing.hpp"

namespace gt2_mot {

/// What is known about one frame.
struct FrameInput {
    const FrameRows *rows = nullptr;
    /// Numbers per embedding, 0 without.
    int dimension = 0;
    /// BGR; empty without images.
    cv::Mat image;
    /// Size without images, if known.
    std::optional<cv::Size> size;
    std::optional<Affine> motion;
};

enum class TrackState { tentative, confirmed, lost };

/// One track after a step.
struct TrackedObject {
    TrackRow row;
    TrackState state;
    /// The tracker stands for this box.
    bool reported;
    /// A detection was taken in this frame.
    bool matched;
};

class Session {
public:
    /// A tracker with the settings of the options. `video_rate` is the video's, 0 if unknown. Throws `UserError`.
    Session(const Options &options, double video_rate);
    ~Session();

    /// Hands the tracker one frame and adds the time that took.
    void step(const FrameInput &frame, StepTimes &times);

    /// The tracks after the last step: the reported ones, and with `all` also those only kept.
    std::vector<TrackedObject> tracks(bool all) const;

    /// The particles of a track, none for trackers without.
    std::vector<cv::Rect2d> particles(std::uint64_t id) const;

    /// The frame rate the tracker was set to.
    double frame_rate() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace gt2_mot
