// The command line of compare.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "drawn_tracks.hpp"
#include "inputs.hpp"
#include "session.hpp"

namespace compare {

struct Options {
    bool help = false;
    examples::InputOptions input;
    /// Left and right.
    std::array<examples::TrackerSettings, 2> trackers;
    examples::DrawingOptions drawing;
    /// Ground truth; empty for none.
    std::string truth;
    std::string out, sheet;
    std::vector<long> sheet_frames;
    /// The frame rate of both trackers and of the result, if the user gives one.
    std::optional<double> fps;
};

/// Reads the arguments after the program's name. Throws `examples::UserError`.
Options parse_options(const std::vector<std::string> &arguments);

/// What `--help` prints.
std::string usage();

}  // namespace compare
