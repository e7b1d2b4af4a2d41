// What the annotator draws of a tracker.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "annotator.hpp"
#include "session.hpp"

namespace examples {

/// What to draw beside reported and lost tracks.
struct DrawingOptions {
    bool tentative = false, particles = false, neighbours = false;
    /// Identities to draw bold; particles and neighbours are those of these tracks only, unless it is empty.
    std::set<std::uint64_t> focus;
    /// Names of the classes 0, 1, ..., to stand on labels.
    std::vector<std::string> class_names;

    Annotator::Layers layers(bool tinted) const { return {particles, neighbours, tinted}; }
};

/// The tracks after the last step.
std::vector<DrawnTrack> drawn_tracks(const Session &session, const DrawingOptions &options);

/// How many of them are reported.
std::size_t reported_count(const std::vector<DrawnTrack> &tracks);

/// Reads names of classes, one per line, that of class 0 first. Throws `UserError`.
std::vector<std::string> read_class_names(const std::string &path);

}  // namespace examples
