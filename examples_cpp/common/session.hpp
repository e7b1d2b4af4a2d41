// The tracker as the programs use it: the only file that calls gentrack2.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "drawn_track.hpp"
#include "frame_input.hpp"
#include "mot_io.hpp"
#include "timing.hpp"

namespace examples {

/// A parameter, and what set it, for messages.
struct Setting {
    std::string key, value, place;
};

/// Which tracker, and how it is set up: the frame rate of the video first, then the file, then the settings in order.
struct TrackerSettings {
    std::string name;
    /// The option that named it, for messages.
    std::string option;
    /// A TOML file of parameters; empty for none.
    std::string config;
    std::vector<Setting> settings;
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
    int class_id;
};

class Session {
public:
    /// `video_rate` is the frame rate of the video of that name, 0 if unknown. Throws `UserError`.
    Session(const TrackerSettings &settings, double video_rate, const std::string &video);
    ~Session();

    /// Hands the tracker one frame and adds the time that took. Throws `UserError` with the number of the frame.
    void step(const FrameInput &frame, StepTimes &times);

    /// The tracks after the last step: the reported ones, and with `all` also those only kept.
    std::vector<TrackedObject> tracks(bool all) const;

    /// The particles of a track, none for trackers without.
    std::vector<DrawnParticle> particles(std::uint64_t id) const;

    /// What guided a track if it is weak; empty for others, and for trackers without.
    DrawnNeighbours neighbours(std::uint64_t id) const;

    /// The frame rate the tracker was set to.
    double frame_rate() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace examples
