#include "inputs.hpp"

#include <algorithm>
#include <cmath>

#include "text.hpp"

namespace examples {
namespace {

DetectionOptions options_of(const InputOptions &o) {
    return {o.filter, o.normalise_scores, o.embeddings, o.dimension, o.classes};
}

}  // namespace

Inputs::Inputs(const InputOptions &o) : options_(o), source_(o.video, o.images) {
    if (!o.det.empty()) file_ = read_detections(o.det, options_of(o));
    if (!o.gmc.empty()) motions_ = read_camera_motion(o.gmc);
    if (!o.detector.empty()) detector_ = make_detector(o.detector);
}

/// The number of frames to step; none for "until the images end".
std::optional<long> Inputs::length() const {
    if (options_.frames) return *options_.frames;
    if (source_.has_images()) return std::nullopt;
    return std::max(file_.last_frame, static_cast<long>(motions_.size()));
}

long Inputs::expected_frames() {
    const auto frames = length();
    return frames ? *frames : source_.expected_frames();
}

cv::Size Inputs::plain_size() const {
    if (options_.size) return *options_.size;
    cv::Point2d corner(320, 240);
    for (const auto &[frame, rows] : file_.frames) {
        for (const DetectionRow &r : rows.detections) {
            corner = {std::max(corner.x, r.left + r.width), std::max(corner.y, r.top + r.height)};
        }
    }
    // Beyond this somebody's boxes are wrong.
    const auto side = [](double x) { return static_cast<int>(std::ceil(std::min(x, 8192.0))); };
    return {side(corner.x), side(corner.y)};
}

bool Inputs::next(FrameInput &input) {
    const auto frames = length();
    if (frames && frame_ == *frames) return false;
    if (source_.has_images() && !source_.read(input.image)) return false;
    input.frame = ++frame_;
    input.detected = detector_runs();
    input.rows = input.detected ? rows_of(input.image) : FrameRows{};
    input.timestamp_ns = timestamp();
    input.dimension = options_.dimension;
    input.size = options_.size;
    input.motion = motion_of(input);
    return true;
}

/// The detections of this frame: found in the image or looked up.
FrameRows Inputs::rows_of(const cv::Mat &image) {
    if (!detector_) {
        const auto found = file_.frames.find(frame_);
        return found == file_.frames.end() ? FrameRows{} : std::move(found->second);
    }
    FrameRows rows{detector_->detect(image), {}};
    auto &all = rows.detections;
    const auto dropped = [&](const DetectionRow &row) { return !options_.filter.passes(row); };
    all.erase(std::remove_if(all.begin(), all.end(), dropped), all.end());
    return rows;
}

std::optional<std::int64_t> Inputs::timestamp() const {
    if (!options_.timestamp_rate) return std::nullopt;
    return std::llround(static_cast<double>(frame_ - 1) * 1e9 / *options_.timestamp_rate);
}

std::optional<Affine> Inputs::motion_of(const FrameInput &input) {
    if (!options_.estimate_camera_motion) {
        const auto index = static_cast<std::size_t>(frame_ - 1);
        return index < motions_.size() ? std::optional<Affine>(motions_[index]) : std::nullopt;
    }
    const gentrack2::CameraMotion motion = estimator_.estimate(input.image, input.rows.detections);
    if (motion.reliable) return motion.affine;
    // The first frame has nothing to be estimated.
    if (motion.status != gentrack2::CameraMotionStatus::first_frame) ++failures_[motion.reason()];
    return std::nullopt;
}

void Inputs::check_end() const {
    if (!source_.has_images()) return;
    const std::string ends = source_.name() + ": ends after " + std::to_string(frame_) + " frames, but ";
    if (options_.frames && frame_ < *options_.frames) {
        throw UserError(ends + "--frames asks for " + std::to_string(*options_.frames));
    }
    if (!options_.frames && file_.last_frame > frame_) {
        throw UserError(ends + options_.det + " has detections up to frame " + std::to_string(file_.last_frame));
    }
}

std::string Inputs::camera_summary() const {
    long total = 0;
    std::string reasons;
    for (const auto &[reason, count] : failures_) {
        total += count;
        reasons += (reasons.empty() ? " (" : ", ") + reason + ": " + std::to_string(count);
    }
    return "camera motion: not estimated in " + std::to_string(total) + " of " +
           std::to_string(std::max(frame_ - 1, 0L)) + " frames" + reasons + (reasons.empty() ? "" : ")");
}

}  // namespace examples
