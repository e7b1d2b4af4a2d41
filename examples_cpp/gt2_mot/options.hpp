// The command line.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drawn_tracks.hpp"
#include "inputs.hpp"
#include "session.hpp"

namespace gt2_mot {

struct Options {
    bool help = false;
    std::string tracker;
    std::string out;
    examples::InputOptions input;
    std::optional<double> fps;
    std::optional<std::string> seed;
    std::string config;
    std::vector<std::pair<std::string, std::string>> set;
    std::string annotate, sheet;
    std::vector<long> sheet_frames;
    examples::DrawingOptions drawing;
    bool all_states = false;
    bool time = false;
    std::string save_det;
};

/// Reads the arguments after the program's name. Throws `UserError` for an unknown option, a missing or malformed
/// value, or options that do not go together.
Options parse_options(const std::vector<std::string> &arguments);

/// The tracker that they ask for.
examples::TrackerSettings tracker_settings(const Options &options);

/// What `--help` prints.
std::string usage();

}  // namespace gt2_mot
