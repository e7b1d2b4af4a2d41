// Draws tracks on frames: box, identity, trail, and on request what guided them. The styles are those of the figures in
// GenTrack2's paper: green boxes are strong, red ones weak, and bold ones those to look at.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "drawn_track.hpp"
#include "mot_io.hpp"
#include "trails.hpp"

namespace examples {

class Annotator {
public:
    /// `layers` says what the legend is to explain beside boxes: particles, neighbours. On frames without an image
    /// boxes are `tinted`.
    struct Layers {
        bool particles = false, neighbours = false, tinted = false;
    };

    explicit Annotator(const Layers &layers) : layers_(layers) {}

    /// Draws the tracks of a frame on `image` (BGR, 8 bits), with a caption and a legend. `motion` is the camera's
    /// since the previous frame.
    void draw(cv::Mat &image, const std::string &caption, const std::vector<DrawnTrack> &tracks,
              const std::optional<Affine> &motion);

private:
    Layers layers_;
    Trails trails_;
};

}  // namespace examples
