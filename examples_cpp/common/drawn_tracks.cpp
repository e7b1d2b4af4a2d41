#include "drawn_tracks.hpp"

#include <algorithm>

#include "mot_rows.hpp"
#include "text.hpp"

namespace examples {
namespace {

// Whether a track is in the list of those that are seen, but not trusted yet, or not here.
bool is_doubtful(const TrackedObject &t) { return !t.reported && t.state != TrackState::lost; }

Look look(const TrackedObject &t) {
    if (t.reported) return t.matched ? Look::strong : Look::weak;
    return is_doubtful(t) ? Look::tentative : Look::lost;
}

std::string label(const TrackedObject &t, const std::vector<std::string> &names) {
    const std::string id = std::to_string(t.row.id);
    const auto k = static_cast<std::size_t>(t.class_id);
    return t.class_id >= 0 && k < names.size() ? id + " " + names[k] : id;
}

}  // namespace

std::vector<DrawnTrack> drawn_tracks(const Session &session, const DrawingOptions &o) {
    std::vector<DrawnTrack> tracks;
    for (const TrackedObject &t : session.tracks(true)) {
        if (is_doubtful(t) && !o.tentative) continue;
        DrawnTrack d{t.row.id, {t.row.left, t.row.top, t.row.width, t.row.height}, look(t), label(t, o.class_names),
                     o.focus.count(t.row.id) > 0, {}, {}};
        const bool explained = o.focus.empty() || d.in_focus;
        if (o.particles && explained) d.particles = session.particles(d.id);
        if (o.neighbours && explained) d.neighbours = session.neighbours(d.id);
        tracks.push_back(std::move(d));
    }
    return tracks;
}

std::size_t reported_count(const std::vector<DrawnTrack> &tracks) {
    return static_cast<std::size_t>(std::count_if(tracks.begin(), tracks.end(), [](const DrawnTrack &t) {
        return t.look == Look::strong || t.look == Look::weak;
    }));
}

std::vector<std::string> read_class_names(const std::string &path) {
    std::vector<std::string> names;
    for_each_line(read_file(path), [&](long, std::string_view line) { names.emplace_back(line); });
    if (names.empty()) throw UserError(path + ": holds no names");
    return names;
}

}  // namespace examples
