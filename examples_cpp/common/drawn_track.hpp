// What the annotator needs to know of a track.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace examples {

/// How a track is drawn.
enum class Look {
    /// Solid green.
    strong,
    /// Dashed red.
    weak,
    /// Dotted red: the tracker keeps it but does not stand for its box.
    lost,
    /// Thin grey, without a label.
    tentative,
};

/// A particle of a track.
struct DrawnParticle {
    cv::Rect2d box;
    /// In 0..1.
    double fitness;
};

/// What guided a weak track.
struct DrawnNeighbours {
    /// Identities, the trustworthy ones first.
    std::vector<std::uint64_t> ids;
    std::size_t trusted = 0;
    /// The median velocity of the trustworthy ones in pixels per second; 0 if there are none.
    cv::Point2d velocity;
    /// The rule that moved the track, in a word or two; empty for a track that is not weak.
    std::string rule;
    /// Whether that rule took the track along with its neighbours.
    bool followed = false;
};

struct DrawnTrack {
    std::uint64_t id = 0;
    cv::Rect2d box;
    Look look = Look::strong;
    /// What stands on its label.
    std::string label;
    /// Drawn bold.
    bool in_focus = false;
    /// Empty unless they are to be drawn.
    std::vector<DrawnParticle> particles;
    DrawnNeighbours neighbours;
};

}  // namespace examples
