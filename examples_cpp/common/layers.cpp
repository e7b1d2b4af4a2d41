#include "layers.hpp"

#include <algorithm>

#include "drawing.hpp"
#include "palette.hpp"

namespace examples {
namespace {

cv::Scalar particle_colour(const DrawnTrack &track, const DrawnParticle &particle) {
    return identity_colour(track.id) * (0.4 + 0.6 * std::clamp(particle.fitness, 0.0, 1.0));
}

}  // namespace

void draw_particle_boxes(cv::Mat &image, const DrawnTrack &track) {
    for (const DrawnParticle &p : track.particles) {
        draw_box(image, p.box, {particle_colour(track, p), scale_of(image), Stroke::solid, false});
    }
}

void draw_particle_centres(cv::Mat &image, const DrawnTrack &track) {
    for (const DrawnParticle &p : track.particles) {
        draw_dot(image, centre_of(p.box), 1.5 * scale_of(image), particle_colour(track, p));
    }
}

void draw_neighbours(cv::Mat &image, const DrawnTrack &track, const std::vector<DrawnTrack> &all) {
    const DrawnNeighbours &near = track.neighbours;
    if (near.rule.empty()) return;
    const double scale = scale_of(image);
    const cv::Point2d here = centre_of(track.box);
    for (std::size_t i = 0; i < near.ids.size(); ++i) {
        const auto other =
            std::find_if(all.begin(), all.end(), [&](const DrawnTrack &t) { return t.id == near.ids[i]; });
        if (other == all.end()) continue;
        const bool trusted = i < near.trusted;
        const cv::Scalar &colour = trusted ? palette::neighbours : palette::tentative;
        const Stroke stroke = trusted ? Stroke::solid : Stroke::dotted;
        draw_line(image, here, centre_of(other->box), {colour, 1.5 * scale, stroke, false});
        draw_dot(image, centre_of(other->box), 3 * scale, colour);
    }
    if (near.trusted > 0) {
        draw_arrow(image, here, here + near.velocity, {palette::motion, (near.followed ? 3.0 : 1.5) * scale});
    }
    draw_dot(image, here, 3 * scale, palette::weak);
}

}  // namespace examples
