// Draws tracks on frames: box, identity, trail and particles.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mot_io.hpp"

namespace examples {

/// How a track is drawn.
enum class Look {
    /// Solid green.
    strong,
    /// Solid red.
    weak,
    /// Dashed red: the tracker keeps it but does not stand for its box.
    lost,
    /// Thin grey, without a label.
    tentative,
};

struct DrawnTrack {
    std::uint64_t id;
    cv::Rect2d box;
    Look look;
    /// A detection was taken in this frame: a bold box.
    bool matched;
    /// Boxes of its particles, if they are to be drawn.
    std::vector<cv::Rect2d> particles;
};

class Annotator {
public:
    /// Draws the tracks of a frame on `image` (BGR, 8 bits), with a caption and a legend. `motion` is the camera's
    /// since the previous frame: trails move with the scene.
    void draw(cv::Mat &image, const std::string &caption, const std::vector<DrawnTrack> &tracks,
              const std::optional<Affine> &motion);

private:
    void remember(const std::vector<DrawnTrack> &tracks, const std::optional<Affine> &motion);

    std::map<std::uint64_t, std::deque<cv::Point2d>> trails_;
};

/// The colour of an identity, for trail and label; the same in every run, and different for neighbouring ids.
cv::Scalar identity_colour(std::uint64_t id);

}  // namespace examples
