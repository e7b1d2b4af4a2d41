#include "drawn_tracks.hpp"

#include <algorithm>

namespace examples {
namespace {

Look look(const TrackedObject &t) {
    if (t.reported) return t.matched ? Look::strong : Look::weak;
    return t.state == TrackState::tentative ? Look::tentative : Look::lost;
}

}  // namespace

std::vector<DrawnTrack> drawn_tracks(const Session &session, bool tentative, bool particles) {
    std::vector<DrawnTrack> tracks;
    for (const TrackedObject &t : session.tracks(true)) {
        if (t.state == TrackState::tentative && !t.reported && !tentative) continue;
        DrawnTrack d{t.row.id, {t.row.left, t.row.top, t.row.width, t.row.height}, look(t), t.matched, {}};
        if (particles) d.particles = session.particles(t.row.id);
        tracks.push_back(std::move(d));
    }
    return tracks;
}

std::size_t reported_count(const std::vector<DrawnTrack> &tracks) {
    return static_cast<std::size_t>(std::count_if(tracks.begin(), tracks.end(), [](const DrawnTrack &t) {
        return t.look == Look::strong || t.look == Look::weak;
    }));
}

}  // namespace examples
