// Files made of annotated frames: a video, and a contact sheet of six.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

namespace examples {

/// Writes a video in the best format that this OpenCV can write and most players can play.
class VideoFile {
public:
    VideoFile(std::string path, double frame_rate) : path_(std::move(path)), frame_rate_(frame_rate) {}

    /// Appends a frame; the first opens the file. Throws `UserError` if the file cannot be written.
    void add(const cv::Mat &image);

private:
    void open(const cv::Size &size);

    std::string path_;
    double frame_rate_;
    cv::VideoWriter writer_;
};

/// Six frames on one picture.
class ContactSheet {
public:
    static constexpr int count = 6;

    /// Collects the frames of those numbers, and sets them in so many columns of tiles of that width.
    ContactSheet(std::string path, std::vector<long> frames, int columns = 3, int tile_width = 640)
        : path_(std::move(path)), frames_(std::move(frames)), columns_(columns), tile_width_(tile_width) {}

    /// Frame numbers spread evenly over a run of that length.
    static std::vector<long> spread_over(long frames);

    void add(long frame, const cv::Mat &image);

    /// Writes the picture. Throws `UserError` if that fails.
    void write() const;

private:
    std::string path_;
    std::vector<long> frames_;
    int columns_, tile_width_;
    std::vector<cv::Mat> tiles_;
};

}  // namespace examples
