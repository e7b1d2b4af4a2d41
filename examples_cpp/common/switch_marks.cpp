#include "switch_marks.hpp"

#include <algorithm>
#include <cmath>

#include "drawing.hpp"
#include "labels.hpp"
#include "palette.hpp"

namespace examples {

SwitchMarks::SwitchMarks(double frame_rate) : duration_(std::max(1, static_cast<int>(std::lround(frame_rate)))) {}

void SwitchMarks::add(const std::vector<TrueBox> &truth, const std::vector<TrackedBox> &tracks) {
    for (Mark &mark : marks_) ++mark.age;
    const auto over = [&](const Mark &mark) { return mark.age >= duration_; };
    marks_.erase(std::remove_if(marks_.begin(), marks_.end(), over), marks_.end());
    for (const IdentitySwitch &s : switches_.add(truth, tracks)) {
        // A second switch of the same object replaces the mark of the first.
        const auto same = [&](const Mark &mark) { return mark.object == s.object; };
        marks_.erase(std::remove_if(marks_.begin(), marks_.end(), same), marks_.end());
        marks_.push_back({s.object, std::to_string(s.before) + " -> " + std::to_string(s.now), {}, 0});
    }
    for (Mark &mark : marks_) {
        for (const TrueBox &t : truth) {
            if (t.object == mark.object) mark.box = t.box;
        }
    }
}

void SwitchMarks::draw(cv::Mat &image) const {
    const double scale = scale_of(image);
    Labels labels(image);
    for (const Mark &mark : marks_) {
        // It closes in during the first third, and leaves room for the label of the track.
        const double open = std::max(0.0, 1.0 - 3.0 * mark.age / duration_);
        const double away = scale * (5 + 30 * open), label = 20 * scale;
        const cv::Rect2d around(mark.box.x - away, mark.box.y - away - label, mark.box.width + 2 * away,
                                mark.box.height + 2 * away + label);
        draw_box(image, around, {palette::identity_switch, 3 * scale});
        labels.add(around, mark.text, palette::identity_switch, 0.6 * scale);
    }
}

}  // namespace examples
