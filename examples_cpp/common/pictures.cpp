#include "pictures.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "text.hpp"

namespace examples {
namespace {

constexpr int gap = 6;

}  // namespace

void VideoFile::open(const cv::Size &size) {
    const bool mp4 = path_.size() >= 4 && path_.compare(path_.size() - 4, 4, ".mp4") == 0;
    // H.264 plays in browsers; MPEG-4 part 2 is what every FFmpeg can write; MJPG needs no FFmpeg.
    const int h264 = cv::VideoWriter::fourcc('a', 'v', 'c', '1'), mpeg4 = cv::VideoWriter::fourcc('m', 'p', '4', 'v');
    const int mjpg = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    for (const int codec : mp4 ? std::vector<int>{h264, mpeg4} : std::vector<int>{mpeg4, mjpg}) {
        if (writer_.open(path_, codec, frame_rate_, size)) return;
    }
    throw UserError(path_ + ": OpenCV cannot write this as a video (.mp4 and .avi are usual)");
}

void VideoFile::add(const cv::Mat &image) {
    // H.264 wants even sides.
    const cv::Size even(std::max(2, image.cols & ~1), std::max(2, image.rows & ~1));
    if (!writer_.isOpened()) open(even);
    if (image.size() == even) return writer_.write(image);
    cv::Mat fitted(even, image.type(), cv::Scalar::all(0));
    const cv::Rect common(0, 0, std::min(even.width, image.cols), std::min(even.height, image.rows));
    image(common).copyTo(fitted(common));
    writer_.write(fitted);
}

std::vector<long> ContactSheet::spread_over(long frames) {
    std::vector<long> numbers;
    for (long i = 0; i < count; ++i) numbers.push_back(std::max(1L, (2 * i + 1) * frames / (2L * count)));
    return numbers;
}

void ContactSheet::add(long frame, const cv::Mat &image) {
    if (std::find(frames_.begin(), frames_.end(), frame) == frames_.end()) return;
    if (tiles_.size() == static_cast<std::size_t>(count)) return;
    cv::Mat tile;
    const double zoom = static_cast<double>(tile_width_) / image.cols;
    cv::resize(image, tile, {tile_width_, std::max(1, static_cast<int>(image.rows * zoom))}, 0, 0, cv::INTER_AREA);
    tiles_.push_back(tile);
}

void ContactSheet::write() const {
    if (tiles_.empty()) throw UserError(path_ + ": none of the frames for the contact sheet was reached");
    const int height = tiles_.front().rows, rows = (count + columns_ - 1) / columns_;
    cv::Mat sheet(rows * height + (rows + 1) * gap, columns_ * tile_width_ + (columns_ + 1) * gap, CV_8UC3,
                  cv::Scalar::all(255));
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        const int column = static_cast<int>(i) % columns_, row = static_cast<int>(i) / columns_;
        const cv::Rect place(gap + column * (tile_width_ + gap), gap + row * (height + gap), tile_width_, height);
        tiles_[i].copyTo(sheet(place));
    }
    bool written = false;
    try {
        written = cv::imwrite(path_, sheet);
    } catch (const cv::Exception &) {
        // An unknown extension.
    }
    if (!written) throw UserError(path_ + ": OpenCV cannot write this picture (.png is usual)");
}

}  // namespace examples
