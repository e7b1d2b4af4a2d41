// What tracks are drawn on: the image of a frame, or a plain ground where there is none.
#pragma once

#include <opencv2/core.hpp>

#include "frame_input.hpp"

namespace examples {

/// A copy of the frame's image, or a dark ground of that size with a faint grid, by which motion is seen.
cv::Mat canvas_for(const FrameInput &input, const cv::Size &plain_size);

}  // namespace examples
