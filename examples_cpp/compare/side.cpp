#include "side.hpp"

#include <cstdio>
#include <filesystem>

#include "band.hpp"
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

}  // namespace

Side::Side(const TrackerSettings &settings, double video_rate, const std::string &video, std::optional<double> fps,
           const DrawingOptions &drawing, bool plain)
    : option_(settings.option),
      title_(title_of(settings)),
      session_(with_rate(settings, fps), video_rate, video),
      drawing_(drawing),
      annotator_(drawing.layers(plain)) {}

void Side::mark_switches() { marks_.emplace(session_.frame_rate()); }

cv::Mat Side::step(const FrameInput &input, cv::Mat canvas, const std::vector<TrueBox> &truth) {
    try {
        session_.step(input, times_);
    } catch (const UserError &error) {
        throw UserError(option_ + ": " + error.what());
    }
    const auto tracks = drawn_tracks(session_, drawing_);
    std::vector<TrackedBox> reported;
    for (const TrackedObject &t : session_.tracks(false)) {
        identities_.insert(t.row.id);
        reported.push_back({t.row.id, {t.row.left, t.row.top, t.row.width, t.row.height}});
    }
    boxes_ += reported.size();
    annotator_.draw(canvas, "frame " + std::to_string(input.frame), tracks, input.motion);
    Band band;
    band.title = title_;
    band.counts = "tracks now " + std::to_string(reported.size()) + "   identities so far " +
                  std::to_string(identities_.size());
    if (marks_) {
        marks_->add(truth, reported);
        marks_->draw(canvas);
        band.switches = "identity switches " + std::to_string(marks_->count());
        band.alarm = marks_->active();
    }
    return under_band(canvas, band);
}

std::string Side::summary() const {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, "%zu identities, %zu boxes, mean step %.2f us", identities_.size(), boxes_,
                  times_.mean());
    const std::string switches = marks_ ? ", " + std::to_string(marks_->count()) + " identity switches" : "";
    return option_.substr(2) + " " + title_ + ": " + numbers + switches;
}

}  // namespace compare
