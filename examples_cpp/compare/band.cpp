#include "band.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "drawing.hpp"
#include "palette.hpp"

namespace compare {
namespace {

using namespace examples;

/// A line of text, made smaller where it would not fit into the first `width` columns.
void write_line(cv::Mat &image, const std::string &text, double baseline, double size, int width,
                const cv::Scalar &colour) {
    const double margin = 14 * size;
    const int thickness = size >= 0.9 ? 2 : 1;
    int below = 0;
    const int extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, thickness, &below).width;
    const double fitted = size * std::min(1.0, (width - 2 * margin) / std::max(1, extent));
    if (fitted <= 0) return;
    const cv::Point start(static_cast<int>(std::lround(margin)), static_cast<int>(std::lround(baseline)));
    cv::putText(image, text, start, cv::FONT_HERSHEY_SIMPLEX, fitted, colour, thickness, cv::LINE_AA);
}

}  // namespace

cv::Mat under_band(const cv::Mat &picture, const Band &band) {
    const double scale = scale_of(picture);
    const int height = static_cast<int>(std::lround(54 * scale));
    cv::Mat whole(height + picture.rows, picture.cols, CV_8UC3, palette::band);
    picture.copyTo(whole.rowRange(height, whole.rows));
    int room = whole.cols;
    if (!band.switches.empty()) {
        const double size = 0.6 * scale * std::min(1.0, whole.cols / (600.0 * scale));
        const cv::Size plate = plate_size(band.switches, size);
        room -= plate.width + cvRound(10 * scale);
        draw_plate(whole, band.switches, {whole.cols - plate.width - 8 * scale, height / 2.0 + plate.height / 2.0},
                   band.alarm ? palette::identity_switch : palette::quiet, size);
    }
    write_line(whole, band.title, 22 * scale, 0.65 * scale, room, palette::white);
    write_line(whole, band.counts, 44 * scale, 0.55 * scale, room, cv::Scalar(160, 220, 255));
    return whole;
}

}  // namespace compare
