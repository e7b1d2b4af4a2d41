// What fragments that are about one frame stand in.
#include <opencv2/core.hpp>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

void fragment(gentrack2::Tracker &tracker, const cv::Mat &mat, const std::vector<gentrack2::Detection> &detections);

void fragment(gentrack2::Tracker &tracker, const cv::Mat &mat, const std::vector<gentrack2::Detection> &detections) {
    (void)mat;
@BLOCK@
}
