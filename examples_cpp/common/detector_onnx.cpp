#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "detector.hpp"
#include "onnx_input.hpp"
#include "text.hpp"

namespace examples {
namespace {

constexpr int strides[] = {8, 16, 32};
/// The size YOLOX models are made for, where the file leaves it open.
const cv::Size usual_input(640, 640);
/// Below this a tracker does not want to hear of it.
constexpr double min_score = 0.05;
/// Boxes of one class that overlap this much are one object.
constexpr double same_object = 0.65;
/// Larger exponents are the output of something that is no detector; without a limit they become infinite boxes.
constexpr float max_log_size = 10.0f;

class OnnxDetector final : public Detector {
public:
    explicit OnnxDetector(const std::string &path) : path_(path) {
        const std::string model = read_file(path);
        input_ = onnx_input_size(model).value_or(usual_input);
        if (input_.width % 32 || input_.height % 32) {
            throw UserError(path + ": its input of " + std::to_string(input_.width) + "x" +
                            std::to_string(input_.height) + " pixels is not a multiple of 32");
        }
        try {
            net_ = cv::dnn::readNetFromONNX(model.data(), model.size());
        } catch (const cv::Exception &) {
            throw UserError(path + ": OpenCV cannot read this as an ONNX model");
        }
        if (net_.empty()) throw UserError(path + ": OpenCV cannot read this as an ONNX model");
    }

protected:
    std::vector<DetectionRow> find(const cv::Mat &image) override {
        const double zoom = std::min(static_cast<double>(input_.width) / image.cols,
                                     static_cast<double>(input_.height) / image.rows);
        try {
            net_.setInput(letterboxed(image, zoom));
            return without_doubles(decoded(net_.forward(), zoom));
        } catch (const cv::Exception &) {
            throw UserError(path_ + ": OpenCV cannot run this model on an image of " + std::to_string(input_.width) +
                            "x" + std::to_string(input_.height));
        }
    }

private:
    cv::Mat letterboxed(const cv::Mat &image, double zoom) const {
        cv::Mat canvas(input_, CV_8UC3, cv::Scalar::all(114));
        const cv::Size size(std::clamp(static_cast<int>(image.cols * zoom), 1, input_.width),
                            std::clamp(static_cast<int>(image.rows * zoom), 1, input_.height));
        cv::Mat part = canvas(cv::Rect({0, 0}, size));
        cv::resize(image, part, size, 0, 0, cv::INTER_LINEAR);
        return cv::dnn::blobFromImage(canvas);
    }

    std::vector<DetectionRow> decoded(const cv::Mat &output, double zoom) const {
        int cells = 0;
        for (const int stride : strides) cells += input_.width / stride * (input_.height / stride);
        if (output.dims != 3 || output.size[0] != 1 || output.size[1] != cells || output.size[2] < 6 ||
            output.type() != CV_32F) {
            throw UserError(path_ + ": its output is not 1x" + std::to_string(cells) +
                            "x(5+classes) as of a YOLOX model");
        }
        std::vector<DetectionRow> rows;
        int cell = 0;
        for (const int stride : strides) {
            for (int y = 0; y < input_.height / stride; ++y) {
                for (int x = 0; x < input_.width / stride; ++x, ++cell) {
                    const float *p = output.ptr<float>(0, cell);
                    const double score = static_cast<double>(p[4]) * p[5];
                    // Written so that a NaN is dropped too.
                    if (!(score >= min_score)) continue;
                    const double width = std::exp(std::min(p[2], max_log_size)) * stride / zoom;
                    const double height = std::exp(std::min(p[3], max_log_size)) * stride / zoom;
                    const double left = (p[0] + x) * stride / zoom - width / 2;
                    const double top = (p[1] + y) * stride / zoom - height / 2;
                    if (!std::isfinite(left + top + width + height)) continue;
                    rows.push_back({left, top, width, height, std::min(score, 1.0)});
                }
            }
        }
        return rows;
    }

    static std::vector<DetectionRow> without_doubles(std::vector<DetectionRow> rows) {
        sort_by_score(rows);
        std::vector<DetectionRow> kept;
        for (const DetectionRow &row : rows) {
            const bool doubled = std::any_of(kept.begin(), kept.end(),
                                             [&](const auto &k) { return overlap(k, row) > same_object; });
            if (!doubled) kept.push_back(row);
        }
        return kept;
    }

    std::string path_;
    cv::Size input_;
    cv::dnn::Net net_;
};

}  // namespace

std::unique_ptr<Detector> make_onnx_detector(const std::string &path) { return std::make_unique<OnnxDetector>(path); }

}  // namespace examples
