#include "detector.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "text.hpp"

namespace examples {
namespace {

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

}  // namespace

std::vector<DetectionRow> Detector::detect(const cv::Mat &image) {
    std::vector<DetectionRow> rows = find(image);
    for (DetectionRow &r : rows) {
        for (double *side : {&r.left, &r.top, &r.width, &r.height}) *side = rounded(*side, 100);
        r.score = rounded(r.score, 10000);
    }
    rows.erase(std::remove_if(rows.begin(), rows.end(), [](const auto &r) { return r.width <= 0 || r.height <= 0; }),
               rows.end());
    sort_by_score(rows);
    return rows;
}

std::unique_ptr<Detector> make_detector(const std::string &name) {
    constexpr std::string_view onnx = "onnx:";
    if (name == "hog") return make_hog_detector();
    if (name.compare(0, onnx.size(), onnx) == 0) return make_onnx_detector(name.substr(onnx.size()));
    throw UserError("--detector " + name + ": expected hog or onnx:FILE");
}

void sort_by_score(std::vector<DetectionRow> &rows) {
    std::sort(rows.begin(), rows.end(), [](const DetectionRow &a, const DetectionRow &b) {
        return std::tie(b.score, a.left, a.top, a.width, a.height) <
               std::tie(a.score, b.left, b.top, b.width, b.height);
    });
}

double overlap(const DetectionRow &a, const DetectionRow &b) {
    const double width = std::min(a.left + a.width, b.left + b.width) - std::max(a.left, b.left);
    const double height = std::min(a.top + a.height, b.top + b.height) - std::max(a.top, b.top);
    if (width <= 0 || height <= 0) return 0.0;
    const double common = width * height;
    return common / (a.width * a.height + b.width * b.height - common);
}

}  // namespace examples
