// Where detections come from when no file is given.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "mot_io.hpp"

namespace examples {

/// Finds people in an image.
class Detector {
public:
    virtual ~Detector() = default;

    /// The people in a BGR image, best first, in an order that depends on nothing but the image. Boxes are whole
    /// hundredths of a pixel and scores whole ten-thousandths, so that they survive a trip through a text file.
    std::vector<DetectionRow> detect(const cv::Mat &image);

protected:
    virtual std::vector<DetectionRow> find(const cv::Mat &image) = 0;
};

/// OpenCV's HOG people detector: old and weak, but part of every OpenCV.
std::unique_ptr<Detector> make_hog_detector();

/// A YOLOX-style ONNX model. Input: one BGR image 1x3xHxW, values 0..255, scaled to fit the upper left and padded with
/// 114. Output: 1xNx(5+classes), one row per cell of the grids of stride 8, 16 and 32: centre offset and log size in
/// cells, objectness and class scores in [0, 1]; class 0 is taken. Throws `UserError` for a file that is none.
std::unique_ptr<Detector> make_onnx_detector(const std::string &path);

/// The detector named on the command line: "hog" or "onnx:FILE".
std::unique_ptr<Detector> make_detector(const std::string &name);

/// Best first; ties by position, so that the order is total.
void sort_by_score(std::vector<DetectionRow> &rows);

/// Intersection over union.
double overlap(const DetectionRow &a, const DetectionRow &b);

}  // namespace examples
