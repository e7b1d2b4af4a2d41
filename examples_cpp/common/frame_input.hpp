// What is known about one frame, as a tracker gets it.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "mot_io.hpp"

namespace examples {

struct FrameInput {
    /// From 1.
    long frame = 0;
    FrameRows rows;
    /// Whether the detector ran; without it there are no rows.
    bool detected = true;
    std::optional<std::int64_t> timestamp_ns;
    /// Numbers per embedding, 0 without.
    int dimension = 0;
    /// BGR; empty without images.
    cv::Mat image;
    /// Size without images, if known.
    std::optional<cv::Size> size;
    std::optional<Affine> motion;
};

}  // namespace examples
