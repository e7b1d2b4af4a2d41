#include "trails.hpp"

#include "drawing.hpp"
#include "palette.hpp"

namespace examples {
namespace {

constexpr std::size_t longest = 40;

}  // namespace

void Trails::begin_frame(const std::optional<Affine> &motion) {
    before_ = std::move(now_);
    now_.clear();
    if (!motion) return;
    const Affine &m = *motion;
    for (auto &[id, trail] : before_) {
        for (cv::Point2d &p : trail) p = {m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]};
    }
}

void Trails::add(std::uint64_t id, const cv::Point2d &place) {
    auto &trail = now_[id] = std::move(before_[id]);
    trail.push_back(place);
    if (trail.size() > longest) trail.pop_front();
}

void Trails::draw(cv::Mat &image, std::uint64_t id) const {
    const auto found = now_.find(id);
    if (found == now_.end()) return;
    const auto &trail = found->second;
    const double scale = scale_of(image);
    for (std::size_t i = 1; i < trail.size(); ++i) {
        const double newness = static_cast<double>(i + longest - trail.size()) / longest;
        const Pen pen{identity_colour(id), scale * (1 + 1.5 * newness), Stroke::solid, false};
        draw_line(image, trail[i - 1], trail[i], pen);
    }
}

}  // namespace examples
