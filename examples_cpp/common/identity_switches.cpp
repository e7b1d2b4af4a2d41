#include "identity_switches.hpp"

#include <algorithm>
#include <limits>

#include "best_pairs.hpp"

namespace examples {
namespace {

constexpr double least_iou = 0.5 - std::numeric_limits<double>::epsilon();
/// What a pair of the frame before is worth: more than any IoU.
constexpr double loyalty = 1000;

double iou(const cv::Rect2d &a, const cv::Rect2d &b) {
    const double both = (a & b).area(), either = a.area() + b.area() - both;
    return either > 0 ? both / either : 0;
}

template <typename Bonus>
std::vector<int> matched(const std::vector<TrueBox> &truth, const std::vector<TrackedBox> &tracks, Bonus bonus) {
    cv::Mat1d scores(static_cast<int>(truth.size()), static_cast<int>(tracks.size()), 0.0);
    for (int row = 0; row < scores.rows; ++row) {
        for (int column = 0; column < scores.cols; ++column) {
            const double overlap = iou(truth[row].box, tracks[column].box);
            if (overlap >= least_iou) scores(row, column) = overlap + bonus(truth[row], tracks[column]);
        }
    }
    return best_pairs(scores);
}

/// The tracks that are not on a distractor.
std::vector<TrackedBox> judged(const std::vector<TrueBox> &truth, const std::vector<TrackedBox> &tracks) {
    if (std::none_of(truth.begin(), truth.end(), [](const TrueBox &t) { return t.distractor; })) return tracks;
    const auto columns = matched(truth, tracks, [](const TrueBox &, const TrackedBox &) { return 0.0; });
    std::vector<bool> dropped(tracks.size(), false);
    for (std::size_t row = 0; row < truth.size(); ++row) {
        if (columns[row] >= 0 && truth[row].distractor) dropped[columns[row]] = true;
    }
    std::vector<TrackedBox> rest;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (!dropped[i]) rest.push_back(tracks[i]);
    }
    return rest;
}

}  // namespace

std::vector<IdentitySwitch> IdentitySwitches::add(const std::vector<TrueBox> &truth,
                                                  const std::vector<TrackedBox> &tracks) {
    const auto rows = judged(truth, tracks);
    std::vector<TrueBox> objects;
    std::copy_if(truth.begin(), truth.end(), std::back_inserter(objects), [](const TrueBox &t) { return t.counts; });
    std::vector<IdentitySwitch> switches;
    if (objects.empty() || rows.empty()) return switches;

    const auto columns = matched(objects, rows, [&](const TrueBox &object, const TrackedBox &track) {
        const auto had = before_.find(object.object);
        return had != before_.end() && had->second == track.id ? loyalty : 0.0;
    });
    before_.clear();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (columns[i] < 0) continue;
        const std::uint64_t object = objects[i].object, now = rows[columns[i]].id;
        before_[object] = now;
        const auto [last, first] = last_.emplace(object, now);
        if (!first && last->second != now) {
            switches.push_back({object, last->second, now});
            last->second = now;
        }
    }
    count_ += static_cast<long>(switches.size());
    return switches;
}

}  // namespace examples
