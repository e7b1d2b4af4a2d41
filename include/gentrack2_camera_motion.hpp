/*
 * gentrack2_camera_motion.hpp: how the camera moved, for those whom nobody tells. Header-only, C++11, with OpenCV's
 * modules imgproc, video and calib3d; gentrack2_opencv.hpp includes it where these are installed. Only who uses it must
 * link them (opencv_core opencv_imgproc opencv_video opencv_calib3d).
 *
 *     gentrack2::CameraMotionEstimator camera;                              // one per video
 *     while (next_frame(mat, detections)) {
 *         gentrack2::Frame frame(detections);
 *         const gentrack2::CameraMotion motion = camera.estimate(mat, detections);   // every frame, in order
 *         motion.give_to(frame);                                            // or to a gt2_frame
 *         tracker.step(frame);
 *     }
 *
 * Corners of the background, which is all that lies outside the detections' boxes, are followed from the previous frame
 * into this one with pyramidal Lucas-Kanade optical flow and back again; those that do not come back to where they
 * started are dropped. A similarity (pan, zoom, rotation) or, on request, a full affine map is fitted with RANSAC, and
 * again by least squares to the corners that agree with it.
 *
 * The map is that of gt2_frame.camera_motion: it takes a point (x, y) of the previous frame to (a x + b y + c,
 * d x + e y + f) in this one, in pixels of the image as given, whose first pixel has its centre at (0, 0).
 *
 * The same images and boxes give the same map, whatever the number of threads. It takes some 10 ms for an image of
 * 768x576 pixels and 15 ms for one of 1920x1080, on one or two cores of a server.
 */
#ifndef GENTRACK2_CAMERA_MOTION_HPP
#define GENTRACK2_CAMERA_MOTION_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "gentrack2.h"

namespace gentrack2 {

/// What became of an estimate.
enum class CameraMotionStatus {
    /// The map is to be relied on.
    estimated,
    /// There is no previous frame: the first one, or the first after reset().
    first_frame,
    /// The frame has another size than the previous one; the estimator went on with the new size.
    size_changed,
    /// The previous frame had too few corners outside its boxes.
    too_few_features,
    /// Too few of them were found again outside the boxes of this frame.
    too_few_matches,
    /// Too few of those moved alike: a cut, a scene at many depths, or things in motion without a box.
    no_consensus,
    /// They lie too close together or are too inexact to tell how the rest of the image moved.
    inexact,
    /// They agree on a motion beyond the limits of the options.
    implausible
};

/// The motion of the camera from the previous frame to this one.
struct CameraMotion {
    /// The 2x3 map {a, b, c, d, e, f} row by row, in pixels; the identity unless `reliable`.
    std::array<double, 6> affine = {{1.0, 0.0, 0.0, 0.0, 1.0, 0.0}};
    /// Whether the map was estimated.
    bool reliable = false;
    /// `estimated`, or why it was not.
    CameraMotionStatus status = CameraMotionStatus::first_frame;
    /// Corners of the previous frame, at most CameraMotionOptions::max_features.
    std::size_t features = 0;
    /// How many of them were found again.
    std::size_t matches = 0;
    /// How many of those agree with the map; 0 if nothing was fitted.
    std::size_t inliers = 0;
    /// Standard error of the map in pixels, at that corner of the image where it is largest; 0 if nothing was fitted.
    double standard_error = 0.0;

    /// The status in words; static.
    const char *reason() const {
        switch (status) {
            case CameraMotionStatus::estimated: return "estimated";
            case CameraMotionStatus::first_frame: return "no previous frame";
            case CameraMotionStatus::size_changed: return "the size of the frames changed";
            case CameraMotionStatus::too_few_features: return "too few corners in the background";
            case CameraMotionStatus::too_few_matches: return "too few corners found again";
            case CameraMotionStatus::no_consensus: return "no motion common to the background";
            case CameraMotionStatus::inexact: return "too inexact";
            case CameraMotionStatus::implausible: return "implausible motion";
        }
        return "";
    }

    /// Gives the map to a frame if it is reliable. Otherwise the frame gets none: the identity would say that the
    /// camera stood still. The frame points to this object, which must live until the step.
    void give_to(gt2_frame &frame) const & { frame.camera_motion = reliable ? affine.data() : nullptr; }
    /// A temporary would be gone before the step.
    void give_to(gt2_frame &frame) const && = delete;

    /// The same for a new gentrack2::Frame, which copies the map.
    template <class Frame>
    void give_to(Frame &frame) const {
        if (reliable) frame.camera_motion(affine);
    }
};

/// How to estimate. The defaults are meant for cameras that are carried, turned or zoomed at ten or more frames per
/// second.
struct CameraMotionOptions {
    /// Images with a longer side than this, in pixels, are scaled down to it first; 0: never. Smaller is faster.
    int max_side = 960;
    /// Most corners to follow, at least 10.
    int max_features = 400;
    /// The fewest that must agree on a motion, at least 3.
    int min_inliers = 12;
    /// The least share of those found again that must agree, in 0..=1.
    double min_inlier_share = 0.4;
    /// How far a corner may be from where the map puts it and still agree with it, as a share of the image's longer
    /// side, in 0..1; never less than 1 pixel of the scaled image. A scene of many depths needs several pixels; the
    /// last fit is made with a narrower one, as far as the corners agree better.
    double tolerance = 0.004;
    /// Boxes are enlarged on every side by this share of their width and height, in 0..=10: detectors cut off feet and
    /// shadows.
    double box_margin = 0.1;
    /// Fit six parameters (with shear and a zoom for each axis) instead of four. It needs corners all over the image;
    /// where these are few or far from the edges, it is the less exact.
    bool full_affine = false;
    /// The largest plausible shift of the image's centre from one frame to the next, as a share of the longer side,
    /// above 0.
    double max_shift = 0.4;
    /// The largest plausible zoom from one frame to the next, in or out, as a factor above 1.
    double max_zoom = 1.5;
    /// The largest plausible rotation from one frame to the next, in degrees, above 0.
    double max_rotation = 30.0;
    /// The largest standard error of a map to be relied on, as a share of the longer side, above 0.
    double max_error = 0.003;
};

/// Estimates the motion of the camera of one video; see the head of this file. Copies nothing but what it needs of an
/// image, so that may be overwritten after the call. Objects are independent; one must not be used by two threads at
/// once.
class CameraMotionEstimator {
public:
    /// Throws std::invalid_argument for options out of range.
    explicit CameraMotionEstimator(const CameraMotionOptions &options = CameraMotionOptions()) : options_(options) {
        const CameraMotionOptions &o = options_;
        // Written so that NaN is refused, too.
        const bool fine = o.max_side >= 0 && o.max_features >= 10 && o.min_inliers >= 3 && o.min_inlier_share >= 0.0 &&
                          o.min_inlier_share <= 1.0 && o.tolerance >= 0.0 && o.tolerance < 1.0 && o.box_margin >= 0.0 &&
                          o.box_margin <= 10.0 && o.max_shift > 0.0 && o.max_zoom > 1.0 && o.max_rotation > 0.0 &&
                          o.max_error > 0.0;
        if (!fine) throw std::invalid_argument("gentrack2::CameraMotionEstimator: an option is out of range");
    }

    /// The motion from the image of the previous call to this one. `image` is CV_8UC1, CV_8UC3 (BGR) or CV_8UC4 (BGRA),
    /// regions of interest are fine; `boxes` is what moves by itself in it, in pixels: a container of gt2_detection,
    /// gt2_track or anything else with left, top, width and height. Boxes may lie outside the image.
    ///
    /// If no motion can be told, `reliable` is false, `status` says why and the map is the identity; the next call
    /// starts from this image all the same.
    ///
    /// Throws std::invalid_argument for an empty matrix, another type, or a box that is not finite or has a negative
    /// side, and is then as before.
    template <class Boxes>
    CameraMotion estimate(const cv::Mat &image, const Boxes &boxes) {
        check_image(image);
        std::vector<cv::Rect2d> foreground;
        for (const auto &box : boxes) {
            foreground.push_back(enlarged(static_cast<double>(box.left), static_cast<double>(box.top),
                                          static_cast<double>(box.width), static_cast<double>(box.height)));
        }
        return advance(image, foreground);
    }

    /// The same with an array of detections.
    CameraMotion estimate(const cv::Mat &image, const gt2_detection *detections, std::size_t count) {
        struct Span {
            const gt2_detection *first, *last;
            const gt2_detection *begin() const { return first; }
            const gt2_detection *end() const { return last; }
        };
        return estimate(image, Span{detections, detections + count});
    }

    /// The same where all of the image is background.
    CameraMotion estimate(const cv::Mat &image) { return estimate(image, nullptr, 0); }

    /// Forgets the previous image, as at a cut or the start of another video.
    void reset() { previous_ = View(); }

private:
    /// What is kept of an image.
    struct View {
        cv::Size size;                     // of the image as given
        std::vector<cv::Mat> pyramid;      // of the scaled grey image, with derivatives
        cv::Mat background;                // of the scaled image, not 0 outside the boxes
        std::vector<cv::Point2f> corners;  // in the scaled image
    };

    static constexpr int window = 21, levels = 4;

    static void check_image(const cv::Mat &image) {
        if (image.empty()) throw std::invalid_argument("gentrack2::CameraMotionEstimator: the matrix is empty");
        if (image.dims != 2) {
            throw std::invalid_argument("gentrack2::CameraMotionEstimator: the matrix has " +
                                        std::to_string(image.dims) + " dimensions, must have 2");
        }
        if (image.type() != CV_8UC1 && image.type() != CV_8UC3 && image.type() != CV_8UC4) {
            throw std::invalid_argument("gentrack2::CameraMotionEstimator: the matrix has " +
                                        std::to_string(image.channels()) + " channels of depth " +
                                        std::to_string(image.depth()) + ", must be CV_8UC1, CV_8UC3 or CV_8UC4");
        }
    }

    cv::Rect2d enlarged(double left, double top, double width, double height) const {
        if (!std::isfinite(left) || !std::isfinite(top) || !std::isfinite(width) || !std::isfinite(height) ||
            width < 0.0 || height < 0.0) {
            throw std::invalid_argument(
                "gentrack2::CameraMotionEstimator: a box is not finite or has a negative side");
        }
        const double dx = options_.box_margin * width, dy = options_.box_margin * height;
        return cv::Rect2d(left - dx, top - dy, width + 2.0 * dx, height + 2.0 * dy);
    }

    /// Scaled pixels per pixel, in x and y; they differ by rounding.
    static cv::Point2d zoom_of(const View &view) {
        const cv::Size &scaled = view.background.size();
        return cv::Point2d(static_cast<double>(scaled.width) / view.size.width,
                           static_cast<double>(scaled.height) / view.size.height);
    }

    View look_at(const cv::Mat &image, const std::vector<cv::Rect2d> &foreground) const {
        View view;
        view.size = image.size();
        cv::Mat grey;
        switch (image.channels()) {
            case 3: cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY); break;
            case 4: cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY); break;
            default: image.copyTo(grey);
        }
        const int side = std::max(grey.cols, grey.rows);
        if (options_.max_side > 0 && side > options_.max_side) {
            const double zoom = static_cast<double>(options_.max_side) / side;
            const cv::Size size(std::max(1, cvRound(grey.cols * zoom)), std::max(1, cvRound(grey.rows * zoom)));
            cv::Mat scaled;
            cv::resize(grey, scaled, size, 0.0, 0.0, cv::INTER_AREA);
            grey = scaled;
        }
        view.background = cv::Mat(grey.size(), CV_8UC1, cv::Scalar::all(255));
        const cv::Point2d zoom = zoom_of(view);
        for (const cv::Rect2d &box : foreground) {
            // Clamped before they become integers, which a far box would not fit into.
            const auto column = [&](double x) { return cvRound(std::min(std::max(x * zoom.x, 0.0), 1.0 * grey.cols)); };
            const auto row = [&](double y) { return cvRound(std::min(std::max(y * zoom.y, 0.0), 1.0 * grey.rows)); };
            const cv::Rect covered(cv::Point(column(box.x), row(box.y)),
                                   cv::Point(column(box.x + box.width), row(box.y + box.height)));
            if (!covered.empty()) view.background(covered).setTo(cv::Scalar::all(0));
        }
        // The corners keep a distance, so that they spread over the image and do not all sit in its busiest part.
        const double spacing = std::sqrt(static_cast<double>(grey.total()) / (4.0 * options_.max_features));
        cv::goodFeaturesToTrack(grey, view.corners, options_.max_features, 0.002, std::max(3.0, spacing),
                                view.background, 5);
        cv::buildOpticalFlowPyramid(grey, view.pyramid, cv::Size(window, window), levels, true, cv::BORDER_REFLECT_101,
                                    cv::BORDER_CONSTANT, false);
        return view;
    }

    CameraMotion advance(const cv::Mat &image, const std::vector<cv::Rect2d> &foreground) {
        View current = look_at(image, foreground);
        const CameraMotion motion = between(previous_, current);
        std::swap(previous_, current);
        return motion;
    }

    CameraMotion between(const View &from, const View &to) const {
        CameraMotion motion;
        if (from.size.area() == 0) return motion;
        if (from.size != to.size) return failed(motion, CameraMotionStatus::size_changed);
        const std::size_t enough = static_cast<std::size_t>(options_.min_inliers);
        motion.features = from.corners.size();
        if (motion.features < enough) return failed(motion, CameraMotionStatus::too_few_features);

        std::vector<cv::Point2d> before, after;
        follow(from, to, before, after);
        motion.matches = before.size();
        if (motion.matches < enough) return failed(motion, CameraMotionStatus::too_few_matches);

        const Fit fit = fit_robustly(before, after, to);
        motion.inliers = fit.inliers;
        motion.standard_error = fit.standard_error;
        const double needed = options_.min_inlier_share * static_cast<double>(motion.matches);
        if (motion.inliers < enough || static_cast<double>(motion.inliers) < needed) {
            return failed(motion, CameraMotionStatus::no_consensus);
        }
        // Also refuses NaN.
        if (!(fit.standard_error <= options_.max_error * side_of(to))) {
            return failed(motion, CameraMotionStatus::inexact);
        }
        if (!plausible(fit.affine, to)) return failed(motion, CameraMotionStatus::implausible);
        motion.affine = fit.affine;
        motion.reliable = true;
        motion.status = CameraMotionStatus::estimated;
        return motion;
    }

    static CameraMotion failed(CameraMotion motion, CameraMotionStatus status) {
        motion.status = status;
        return motion;
    }

    /// Where the corners of `from` are in `to`, both in pixels of the image as given, without those that got lost.
    static void follow(const View &from, const View &to, std::vector<cv::Point2d> &before,
                       std::vector<cv::Point2d> &after) {
        const cv::Size size(window, window);
        const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01);
        std::vector<cv::Point2f> there, back;
        std::vector<unsigned char> found, found_back;
        cv::calcOpticalFlowPyrLK(from.pyramid, to.pyramid, from.corners, there, found, cv::noArray(), size, levels,
                                 criteria);
        cv::calcOpticalFlowPyrLK(to.pyramid, from.pyramid, there, back, found_back, cv::noArray(), size, levels,
                                 criteria);
        const cv::Point2d zoom = zoom_of(to);
        const auto unscaled = [&zoom](const cv::Point2f &p) {
            return cv::Point2d((p.x + 0.5) / zoom.x - 0.5, (p.y + 0.5) / zoom.y - 0.5);
        };
        const cv::Rect inside(0, 0, to.background.cols, to.background.rows);
        for (std::size_t i = 0; i < there.size(); ++i) {
            if (!found[i] || !found_back[i]) continue;
            const cv::Point2f gap = back[i] - from.corners[i];
            if (!(gap.dot(gap) < 0.25f)) continue;
            const cv::Point at(cvRound(there[i].x), cvRound(there[i].y));
            if (!inside.contains(at) || to.background.at<unsigned char>(at) == 0) continue;
            before.push_back(unscaled(from.corners[i]));
            after.push_back(unscaled(there[i]));
        }
    }

    struct Fit {
        std::array<double, 6> affine;
        std::size_t inliers;
        double standard_error;

        cv::Point2d operator()(const cv::Point2d &p) const {
            return cv::Point2d(affine[0] * p.x + affine[1] * p.y + affine[2],
                               affine[3] * p.x + affine[4] * p.y + affine[5]);
        }
    };

    Fit fit_robustly(const std::vector<cv::Point2d> &before, const std::vector<cv::Point2d> &after,
                     const View &to) const {
        const double scaled_pixel = 1.0 / std::min(zoom_of(to).x, zoom_of(to).y);
        const double tolerance = std::max(scaled_pixel, options_.tolerance * side_of(to));
        Fit fit = Fit();
        // OpenCV's RANSAC starts from a fixed seed.
        const cv::Mat start =
            options_.full_affine
                ? cv::estimateAffine2D(before, after, cv::noArray(), cv::RANSAC, tolerance, 2000, 0.995, 0)
                : cv::estimateAffinePartial2D(before, after, cv::noArray(), cv::RANSAC, tolerance, 2000, 0.995, 0);
        if (start.empty()) return fit;
        for (int i = 0; i < 6; ++i) fit.affine[static_cast<std::size_t>(i)] = start.at<double>(i / 3, i % 3);

        // A map of two or three corners is rough: corners of the background that it misses come in, and those that
        // move nearly as the background leave, with a limit that follows the spread of the ones that agree.
        std::vector<double> distances(before.size()), agreeing;
        for (int round = 0; round < 8; ++round) {
            agreeing.clear();
            for (std::size_t i = 0; i < before.size(); ++i) {
                distances[i] = cv::norm(fit(before[i]) - after[i]);
                if (distances[i] <= tolerance) agreeing.push_back(distances[i]);
            }
            if (agreeing.size() < 3) return Fit();
            const auto middle = agreeing.begin() + static_cast<std::ptrdiff_t>(agreeing.size() / 2);
            std::nth_element(agreeing.begin(), middle, agreeing.end());
            const double limit = std::min(tolerance, std::max(0.1 * scaled_pixel, 2.5 * *middle));
            fit = least_squares(before, after, distances, limit, to);
        }
        fit.inliers = agreeing.size();
        return fit;
    }

    /// The best map for the corners with a distance up to `limit`.
    Fit least_squares(const std::vector<cv::Point2d> &before, const std::vector<cv::Point2d> &after,
                      const std::vector<double> &distances, double limit, const View &to) const {
        cv::Point2d p0, q0;
        double n = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (distances[i] > limit) continue;
            p0 += before[i];
            q0 += after[i];
            n += 1.0;
        }
        p0 *= 1.0 / n;
        q0 *= 1.0 / n;
        // Sums of p p' and of q p' about the means; the map is their quotient.
        cv::Matx22d pp = cv::Matx22d::zeros(), qp = cv::Matx22d::zeros();
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (distances[i] > limit) continue;
            const cv::Point2d p = before[i] - p0, q = after[i] - q0;
            pp += cv::Matx22d(p.x * p.x, p.x * p.y, p.x * p.y, p.y * p.y);
            qp += cv::Matx22d(q.x * p.x, q.x * p.y, q.y * p.x, q.y * p.y);
        }
        if (!options_.full_affine) {
            // Of a similarity, both columns tell the same two numbers.
            const double spread = pp(0, 0) + pp(1, 1), along = qp(0, 0) + qp(1, 1), across = qp(1, 0) - qp(0, 1);
            pp = cv::Matx22d(spread, 0.0, 0.0, spread);
            qp = cv::Matx22d(along, -across, across, along);
        }
        const cv::Matx22d inverse = pp.inv();
        const cv::Matx22d m = qp * inverse;
        Fit fit = Fit();
        fit.affine = {{m(0, 0), m(0, 1), q0.x - m(0, 0) * p0.x - m(0, 1) * p0.y,  //
                       m(1, 0), m(1, 1), q0.y - m(1, 0) * p0.x - m(1, 1) * p0.y}};

        double squares = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (distances[i] > limit) continue;
            const cv::Point2d gap = fit(before[i]) - after[i];
            squares += gap.dot(gap);
        }
        const double freedom = 2.0 * n - (options_.full_affine ? 6.0 : 4.0);
        double farthest = 0.0;
        for (int corner = 0; corner < 4; ++corner) {
            const cv::Vec2d d(corner % 2 * (to.size.width - 1.0) - p0.x, corner / 2 * (to.size.height - 1.0) - p0.y);
            farthest = std::max(farthest, d.dot(inverse * d));
        }
        // Corners all in one place have no inverse, which OpenCV makes 0.
        const bool told = freedom > 0.0 && cv::determinant(pp) > 0.0;
        fit.standard_error = told ? std::sqrt(squares / freedom * 2.0 * (1.0 / n + farthest)) : HUGE_VAL;
        return fit;
    }

    static double side_of(const View &view) { return std::max(view.size.width, view.size.height); }

    bool plausible(const std::array<double, 6> &m, const View &to) const {
        const cv::Point2d centre((to.size.width - 1) / 2.0, (to.size.height - 1) / 2.0);
        const cv::Point2d shift(m[0] * centre.x + m[1] * centre.y + m[2] - centre.x,
                                m[3] * centre.x + m[4] * centre.y + m[5] - centre.y);
        // Of a full affine map, the zoom of areas and the mean rotation.
        const double determinant = m[0] * m[4] - m[1] * m[3];
        const double zoom = std::sqrt(std::max(determinant, 0.0));
        const double rotation = std::atan2(m[3] - m[1], m[0] + m[4]) * (180.0 / CV_PI);
        return cv::norm(shift) <= options_.max_shift * side_of(to) && zoom <= options_.max_zoom &&
               zoom * options_.max_zoom >= 1.0 && std::fabs(rotation) <= options_.max_rotation;
    }

    CameraMotionOptions options_;
    View previous_;
};

}  // namespace gentrack2

#endif  // GENTRACK2_CAMERA_MOTION_HPP
