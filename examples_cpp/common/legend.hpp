// Which line stands for what.
#pragma once

#include <opencv2/core.hpp>

#include "drawing.hpp"
#include "drawn_track.hpp"

namespace examples {

/// The pen for the box of a track.
Pen pen_of(const DrawnTrack &track, double scale);

/// Explains the boxes at the lower left, and the layers that are drawn, in as many rows as that takes.
void draw_legend(cv::Mat &image, bool particles, bool neighbours);

}  // namespace examples
