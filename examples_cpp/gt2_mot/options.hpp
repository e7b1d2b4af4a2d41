// The command line.
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gt2_mot {

struct Options {
    bool help = false;
    std::string tracker;
    std::string det, detector;
    std::string out;
    std::string video, images;
    std::string gmc;
    std::string embeddings;
    int dimension = 0;
    std::optional<double> min_score, max_height;
    bool normalise_scores = false;
    std::optional<cv::Size> size;
    std::optional<double> fps;
    std::optional<long> frames;
    std::optional<std::string> seed;
    std::string config;
    std::vector<std::pair<std::string, std::string>> set;
    std::string annotate, sheet;
    std::vector<long> sheet_frames;
    bool particles = false;
    bool all_states = false;
    bool time = false;
    std::string save_det;
};

/// Reads the arguments after the program's name. Throws `UserError` for an unknown option, a missing or malformed
/// value, or options that do not go together.
Options parse_options(const std::vector<std::string> &arguments);

/// What `--help` prints.
std::string usage();

}  // namespace gt2_mot
