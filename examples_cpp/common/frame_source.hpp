// The images of a run: a video, a directory, or nothing at all.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

namespace examples {

class FrameSource {
public:
    /// Opens a video or a directory; the other is empty, or both. Throws `UserError` if that does not open.
    FrameSource(const std::string &video, const std::string &images);

    /// Whether there are images.
    bool has_images() const { return !name_.empty(); }

    /// What it reads, for messages; empty without images.
    const std::string &name() const { return name_; }

    /// Frames per second as the video says, 0 if it does not.
    double frame_rate();

    /// Number of frames, as far as is known beforehand; 0 if it is not.
    long expected_frames();

    /// Reads the next image into `image` (BGR); false at the end.
    bool read(cv::Mat &image);

private:
    std::string name_;
    cv::VideoCapture video_;
    std::vector<std::string> files_;
    std::size_t next_file_ = 0;
    cv::Size size_;
};

}  // namespace examples
