// What the annotator draws of a tracker.
#pragma once

#include <vector>

#include "annotator.hpp"
#include "session.hpp"

namespace examples {

/// The tracks after the last step: reported and lost, with `tentative` also the tentative ones, with `particles` each
/// with its particles.
std::vector<DrawnTrack> drawn_tracks(const Session &session, bool tentative, bool particles);

/// How many of them are reported.
std::size_t reported_count(const std::vector<DrawnTrack> &tracks);

}  // namespace examples
