#include "side.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "drawn_tracks.hpp"
#include "text.hpp"

namespace compare {
namespace {

using namespace examples;

TrackerSettings with_rate(TrackerSettings settings, std::optional<double> fps) {
    if (fps) settings.settings.push_back({"frame_rate", text_of(*fps), "--fps"});
    return settings;
}

/// The name, and what was set: that tells two sides of the same name apart.
std::string title_of(const TrackerSettings &settings) {
    std::string rest = std::filesystem::path(settings.config).filename().string();
    for (const Setting &s : settings.settings) rest += (rest.empty() ? "" : ", ") + s.key + "=" + s.value;
    return rest.empty() ? settings.name : settings.name + " (" + rest + ")";
}

/// A line of text, made smaller where it would not fit.
void write_line(cv::Mat &image, const std::string &text, double baseline, double size, const cv::Scalar &colour) {
    const double margin = 14 * size;
    const int thickness = size >= 0.9 ? 2 : 1;
    int below = 0;
    const int width = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, thickness, &below).width;
    const double fitted = size * std::min(1.0, (image.cols - 2 * margin) / std::max(1, width));
    if (fitted <= 0) return;
    const cv::Point start(static_cast<int>(std::lround(margin)), static_cast<int>(std::lround(baseline)));
    cv::putText(image, text, start, cv::FONT_HERSHEY_SIMPLEX, fitted, colour, thickness, cv::LINE_AA);
}

}  // namespace

Side::Side(const TrackerSettings &settings, double video_rate, const std::string &video, std::optional<double> fps)
    : option_(settings.option),
      title_(title_of(settings)),
      session_(with_rate(settings, fps), video_rate, video) {}

cv::Mat Side::step(const FrameInput &input) {
    try {
        session_.step(input, times_);
    } catch (const UserError &error) {
        throw UserError(option_ + ": " + error.what());
    }
    const auto tracks = drawn_tracks(session_, false, false);
    for (const TrackedObject &t : session_.tracks(false)) identities_.insert(t.row.id);
    const std::size_t now = reported_count(tracks);
    boxes_ += now;

    const double scale = std::max(1.0, input.image.rows / 576.0);
    const int band = static_cast<int>(std::lround(54 * scale));
    cv::Mat whole(band + input.image.rows, input.image.cols, CV_8UC3, cv::Scalar::all(30));
    cv::Mat picture = whole.rowRange(band, whole.rows);
    input.image.copyTo(picture);
    annotator_.draw(picture, "frame " + std::to_string(input.frame), tracks, input.motion);
    const std::string counts =
        "tracks now " + std::to_string(now) + "   identities so far " + std::to_string(identities_.size());
    write_line(whole, title_, 22 * scale, 0.65 * scale, cv::Scalar::all(255));
    write_line(whole, counts, 44 * scale, 0.55 * scale, cv::Scalar(160, 220, 255));
    return whole;
}

std::string Side::summary() const {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, "%zu identities, %zu boxes, mean step %.2f us", identities_.size(), boxes_,
                  times_.mean());
    return option_.substr(2) + " " + title_ + ": " + numbers;
}

}  // namespace compare
