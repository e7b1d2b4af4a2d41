// Every template of the OpenCV headers in use, to be compiled as C++11.
#include "gentrack2_opencv.hpp"

#include "gentrack2.hpp"

void estimate_everything(const cv::Mat &mat, const gentrack2::Tracker &tracker);

void estimate_everything(const cv::Mat &mat, const gentrack2::Tracker &tracker) {
    const std::vector<gentrack2::Detection> detections;
    gentrack2::Frame frame(detections);
    gt2_frame raw = GT2_FRAME_INIT;
    gentrack2::CameraMotionEstimator estimator;
    estimator.estimate(mat, detections).give_to(frame);
    const gentrack2::CameraMotion motion = estimator.estimate(mat, detections.data(), detections.size());
    motion.give_to(raw);
    estimator.estimate(mat, tracker.reported());
    estimator.estimate(mat);
    estimator.reset();
}
