#include "canvas.hpp"

#include <opencv2/imgproc.hpp>

#include "palette.hpp"

namespace examples {

cv::Mat canvas_for(const FrameInput &input, const cv::Size &plain_size) {
    if (!input.image.empty()) return input.image.clone();
    cv::Mat canvas(plain_size, CV_8UC3, palette::plain);
    const int mesh = std::max(8, plain_size.height / 12);
    const cv::Scalar faint = palette::plain * 1.6;
    for (int x = mesh; x < canvas.cols; x += mesh) cv::line(canvas, {x, 0}, {x, canvas.rows}, faint);
    for (int y = mesh; y < canvas.rows; y += mesh) cv::line(canvas, {0, y}, {canvas.cols, y}, faint);
    return canvas;
}

}  // namespace examples
