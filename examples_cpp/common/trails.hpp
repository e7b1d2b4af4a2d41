// Where tracks have been.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <opencv2/core.hpp>
#include <optional>

#include "mot_io.hpp"

namespace examples {

class Trails {
public:
    /// Starts a frame: what was added in it before goes on, the trails of others end. `motion` is the camera's since
    /// the previous frame: trails move with the scene.
    void begin_frame(const std::optional<Affine> &motion);

    /// Where the track is in this frame.
    void add(std::uint64_t id, const cv::Point2d &place);

    /// Draws the trail of a track, the older the thinner.
    void draw(cv::Mat &image, std::uint64_t id) const;

private:
    std::map<std::uint64_t, std::deque<cv::Point2d>> before_, now_;
};

}  // namespace examples
