#include "annotator.hpp"

#include <algorithm>

#include "drawing.hpp"
#include "labels.hpp"
#include "layers.hpp"
#include "legend.hpp"
#include "palette.hpp"

namespace examples {
namespace {

/// Nearer ones last: what stands lower in the picture hides what is behind it.
std::vector<const DrawnTrack *> far_to_near(const std::vector<DrawnTrack> &tracks) {
    std::vector<const DrawnTrack *> order;
    for (const DrawnTrack &track : tracks) order.push_back(&track);
    std::stable_sort(order.begin(), order.end(), [](const DrawnTrack *a, const DrawnTrack *b) {
        return a->in_focus != b->in_focus ? b->in_focus : a->box.br().y < b->box.br().y;
    });
    return order;
}

/// Identities, the oldest in the best places, so that they jump little; and below weak tracks the rule that moved them.
void draw_labels(cv::Mat &image, std::vector<const DrawnTrack *> tracks) {
    const double scale = scale_of(image);
    std::sort(tracks.begin(), tracks.end(), [](const DrawnTrack *a, const DrawnTrack *b) { return a->id < b->id; });
    Labels labels(image);
    for (const DrawnTrack *track : tracks) {
        if (track->look == Look::tentative) continue;
        labels.add(track->box, track->label, identity_colour(track->id), 0.5 * scale);
    }
    for (const DrawnTrack *track : tracks) {
        if (track->neighbours.rule.empty()) continue;
        labels.add_below(track->box, track->neighbours.rule, palette::motion, 0.4 * scale);
    }
}

}  // namespace

void Annotator::draw(cv::Mat &image, const std::string &caption, const std::vector<DrawnTrack> &tracks,
                     const std::optional<Affine> &motion) {
    trails_.begin_frame(motion);
    // Where the feet are: trails then lie on the ground and tell crossing people apart.
    for (const DrawnTrack &track : tracks) trails_.add(track.id, foot_of(track.box));
    const auto order = far_to_near(tracks);
    if (layers_.tinted) {
        for (const DrawnTrack *track : order) tint_box(image, track->box, identity_colour(track->id), 0.3);
    }
    for (const DrawnTrack *track : order) {
        if (track->look != Look::tentative) trails_.draw(image, track->id);
    }
    for (const DrawnTrack *track : order) draw_particle_boxes(image, *track);
    for (const DrawnTrack *track : order) draw_box(image, track->box, pen_of(*track, scale_of(image)));
    for (const DrawnTrack *track : order) draw_particle_centres(image, *track);
    for (const DrawnTrack *track : order) draw_neighbours(image, *track, tracks);
    // Labels last, so that no box crosses them out.
    draw_labels(image, order);
    draw_plate(image, caption, {0, 0}, palette::black, 0.5 * scale_of(image));
    draw_legend(image, layers_.particles, layers_.neighbours);
}

}  // namespace examples
