#include "frame_source.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio/registry.hpp>
#include <set>

#include "text.hpp"

namespace examples {
namespace {

std::vector<std::string> image_files(const std::string &directory) {
    static const std::set<std::string> extensions = {".bmp", ".jpeg", ".jpg",  ".pgm",
                                                     ".png", ".ppm",  ".tiff", ".tif", ".webp"};
    if (!std::filesystem::is_directory(directory)) throw UserError(directory + ": no such directory");
    std::vector<std::string> files;
    for (const auto &entry : std::filesystem::directory_iterator(directory)) {
        std::string extension = entry.path().extension().string();
        for (char &c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (extensions.count(extension)) files.push_back(entry.path().string());
    }
    if (files.empty()) throw UserError(directory + ": holds no images");
    std::sort(files.begin(), files.end());
    return files;
}

/// What OpenCV's GStreamer has to say of a file that it cannot play goes straight to stderr, whatever the log level. So
/// it is asked only for its pipelines ("... ! appsink"), and where there is no FFmpeg.
bool open_video(cv::VideoCapture &video, const std::string &name) {
    const std::vector<cv::VideoCaptureAPIs> readers = cv::videoio_registry::getStreamBackends();
    const bool has_ffmpeg = std::find(readers.begin(), readers.end(), cv::CAP_FFMPEG) != readers.end();
    if (!has_ffmpeg || name.find(" ! ") != std::string::npos) return video.open(name);
    return std::any_of(readers.begin(), readers.end(), [&](cv::VideoCaptureAPIs reader) {
        return reader != cv::CAP_GSTREAMER && video.open(name, reader);
    });
}

}  // namespace

FrameSource::FrameSource(const std::string &video, const std::string &images) : name_(video.empty() ? images : video) {
    if (!images.empty()) files_ = image_files(images);
    if (video.empty()) return;
    // OpenCV also takes addresses and numbered patterns, which are no files.
    const bool is_file = name_.find("://") == std::string::npos && name_.find('%') == std::string::npos;
    if (is_file && !std::filesystem::exists(name_)) throw UserError(name_ + ": no such file");
    if (!open_video(video_, name_)) throw UserError(name_ + ": OpenCV cannot open this as a video");
}

double FrameSource::frame_rate() {
    if (!video_.isOpened()) return 0.0;
    const double rate = video_.get(cv::CAP_PROP_FPS);
    return std::isfinite(rate) && rate >= 1 && rate <= 1000 ? rate : 0.0;
}

long FrameSource::expected_frames() {
    if (!video_.isOpened()) return static_cast<long>(files_.size());
    const double count = video_.get(cv::CAP_PROP_FRAME_COUNT);
    return count >= 1 && count < 1e9 ? std::lround(count) : 0;
}

bool FrameSource::read(cv::Mat &image) {
    if (video_.isOpened()) {
        if (!video_.read(image) || image.empty()) return false;
    } else {
        if (next_file_ == files_.size()) return false;
        const std::string &file = files_[next_file_++];
        image = cv::imread(file, cv::IMREAD_COLOR);
        if (image.empty()) throw UserError(file + ": OpenCV cannot read this image");
    }
    if (size_.empty()) size_ = image.size();
    if (image.size() != size_) throw UserError(name_ + ": its frames differ in size");
    return true;
}

}  // namespace examples
