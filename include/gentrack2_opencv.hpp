/*
 * gentrack2_opencv.hpp: OpenCV's images and boxes for gentrack2. Header-only, C++11.
 *
 *     gt2_image view = gentrack2::image(mat);                // no copy: `mat` must live until the step is done
 *     gt2_detection d = gentrack2::detection(rect, 0.9);     // from any cv::Rect_
 *     cv::Rect2d box = gentrack2::rect(track);               // from a track, detection or particle
 *
 * It goes with gentrack2.h alone as well as with gentrack2.hpp, and all of the above links with opencv_core alone.
 *
 *     gentrack2::CameraMotionEstimator camera;               // camera.estimate(mat, detections).give_to(frame)
 *
 * is in gentrack2_camera_motion.hpp, which this header includes where OpenCV's modules imgproc, video and calib3d are
 * installed; define GENTRACK2_OPENCV_CORE_ONLY to spare the compiler their headers.
 */
#ifndef GENTRACK2_OPENCV_HPP
#define GENTRACK2_OPENCV_HPP

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <stdexcept>
#include <string>

#include "gentrack2.h"

namespace gentrack2 {

/// A view of an 8-bit image: CV_8UC1 as grey, CV_8UC3 as BGR and CV_8UC4 as BGRA, the orders of cv::imread and
/// cv::VideoCapture. Regions of interest are fine. The pixels are not copied, so the matrix must outlive the call that
/// the view is for. Throws std::invalid_argument for an empty matrix or any other type.
inline gt2_image image(const cv::Mat &mat) {
    if (mat.empty()) throw std::invalid_argument("gentrack2::image: the matrix is empty");
    if (mat.dims != 2) {
        throw std::invalid_argument("gentrack2::image: the matrix has " + std::to_string(mat.dims) +
                                    " dimensions, must have 2");
    }
    gt2_image view = GT2_IMAGE_INIT;
    switch (mat.type()) {
        case CV_8UC1: view.format = GT2_PIXEL_GRAY8; break;
        case CV_8UC3: view.format = GT2_PIXEL_BGR24; break;
        case CV_8UC4: view.format = GT2_PIXEL_BGRA32; break;
        default:
            throw std::invalid_argument("gentrack2::image: the matrix has " + std::to_string(mat.channels()) +
                                        " channels of depth " + std::to_string(mat.depth()) +
                                        ", must be CV_8UC1, CV_8UC3 or CV_8UC4");
    }
    view.data = mat.data;
    view.stride = mat.step[0];
    view.width = static_cast<std::uint32_t>(mat.cols);
    view.height = static_cast<std::uint32_t>(mat.rows);
    return view;
}

/// A detection from a box in pixels (cv::Rect, cv::Rect2f or cv::Rect2d) and a score in 0..=1. `class_id` and `tag` are
/// any numbers and come back on the track that takes it. Nothing is checked before the step.
template <typename T>
gt2_detection detection(const cv::Rect_<T> &box, double score, std::int32_t class_id = 0, std::uint64_t tag = 0) {
    gt2_detection d = gt2_detection();
    d.left = static_cast<double>(box.x);
    d.top = static_cast<double>(box.y);
    d.width = static_cast<double>(box.width);
    d.height = static_cast<double>(box.height);
    d.score = score;
    d.class_id = class_id;
    d.tag = tag;
    return d;
}

/// The box of a track, detection or particle in pixels: `rect(track)` is a cv::Rect2d, `rect<float>(track)` a
/// cv::Rect2f.
template <typename T = double, typename Box>
cv::Rect_<T> rect(const Box &box) {
    return cv::Rect_<T>(static_cast<T>(box.left), static_cast<T>(box.top), static_cast<T>(box.width),
                        static_cast<T>(box.height));
}

}  // namespace gentrack2

// Before C++17 __has_include is an extension, which all the usual compilers have.
#if !defined(GENTRACK2_OPENCV_CORE_ONLY) && defined(__has_include)
#if __has_include(<opencv2/imgproc.hpp>) && __has_include(<opencv2/video/tracking.hpp>) && \
    __has_include(<opencv2/calib3d.hpp>)
#include "gentrack2_camera_motion.hpp"
#endif
#endif

#endif  // GENTRACK2_OPENCV_HPP
