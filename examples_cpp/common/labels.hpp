// Labels at boxes, where they hide each other least.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace examples {

class Labels {
public:
    explicit Labels(cv::Mat &image) : image_(image) {}

    /// Writes `text` on a plate at a corner of the box, above it if that place is free; nothing if the box is outside.
    void add(const cv::Rect2d &box, const std::string &text, const cv::Scalar &plate, double size);

    /// The same below the box, if there is room.
    void add_below(const cv::Rect2d &box, const std::string &text, const cv::Scalar &plate, double size);

private:
    bool is_free(const cv::Rect2d &place) const;
    void write(const cv::Rect2d &place, const std::string &text, const cv::Scalar &plate, double size);

    cv::Mat &image_;
    std::vector<cv::Rect2d> taken_;
};

}  // namespace examples
