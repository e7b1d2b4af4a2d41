// The strip above each half, with the tracker's name and counts.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace compare {

struct Band {
    std::string title, counts;
    /// Number of identity switches; empty if they are not counted.
    std::string switches;
    /// One was just now.
    bool alarm = false;
};

/// The picture with the band above it.
cv::Mat under_band(const cv::Mat &picture, const Band &band);

}  // namespace compare
