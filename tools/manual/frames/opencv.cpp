// What the fragments of the manual about OpenCV stand in: a video, a detector, a model for looks, something to draw.
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

std::vector<gentrack2::Detection> detect(const cv::Mat &image);
std::vector<float> embed(const cv::Mat &image, const std::vector<gentrack2::Detection> &detections);
void draw(cv::Mat &image, const gentrack2::Track &track);
void use(std::uint64_t id, std::int64_t row, std::int32_t class_id);

void fragment(cv::VideoCapture &video, const cv::Scalar &colour);

void fragment(cv::VideoCapture &video, const cv::Scalar &colour) {
    (void)video, (void)colour;
@BLOCK@
}
