// A video, or a stream by its URL, with objects found by a YOLOX-style model in ONNX, through cv::dnn. Writes rows of
// frame, identity, left, top, width, height, score, class. The last argument is the size of the model's input,
// multiples of 32; a model of another kind needs another `decoded`.
//
//   onnx_detector walk.mp4 yolox_s.onnx 640x640 > walk.txt
//
//   c++ -std=c++17 onnx_detector.cpp $(pkg-config --cflags --libs opencv4) -lgentrack2

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

// Put your own detector in its place: a box in pixels, a score in 0..1 and a class for each object is enough.
class Detector {
public:
    Detector(const std::string &model, cv::Size input) : net_(cv::dnn::readNetFromONNX(model)), input_(input) {}

    std::vector<gentrack2::Detection> operator()(const cv::Mat &image) {
        // The image fills the model's from the left and the top as far as its shape allows; the rest is grey.
        const double zoom = std::min(input_.width / double(image.cols), input_.height / double(image.rows));
        cv::Mat canvas(input_, CV_8UC3, cv::Scalar::all(114));
        const cv::Size size(std::clamp(int(image.cols * zoom), 1, input_.width),
                            std::clamp(int(image.rows * zoom), 1, input_.height));
        cv::Mat part = canvas(cv::Rect({0, 0}, size));
        cv::resize(image, part, size);
        net_.setInput(cv::dnn::blobFromImage(canvas));
        return decoded(net_.forward(), zoom);
    }

private:
    // A row for each cell of three grids: the centre in cells from the cell's corner, the logarithm of the size in
    // cells, how sure the model is of an object, and of each class.
    std::vector<gentrack2::Detection> decoded(const cv::Mat &output, double zoom) const {
        int cells = 0, row = 0;
        for (const int stride : {8, 16, 32}) cells += input_.width / stride * (input_.height / stride);
        if (output.dims != 3 || output.size[1] != cells || output.size[2] < 6 || output.type() != CV_32F) {
            throw std::runtime_error("the model's output is not 1x" + std::to_string(cells) + "x(5+classes)");
        }
        std::vector<cv::Rect2d> boxes;
        std::vector<float> scores;
        std::vector<int> classes;
        for (const int stride : {8, 16, 32}) {
            for (int y = 0; y < input_.height / stride; ++y) {
                for (int x = 0; x < input_.width / stride; ++x, ++row) {
                    const float *p = output.ptr<float>(0, row);
                    const float *best = std::max_element(p + 5, p + output.size[2]);
                    const float score = p[4] * *best;
                    // Weak ones, too: they start no tracks, but existing ones take them where they are expected.
                    // Written so that what is not a number is left out.
                    if (!(score >= 0.1f && score <= 1.0f)) continue;
                    const double width = std::exp(p[2]) * stride / zoom, height = std::exp(p[3]) * stride / zoom;
                    const double u = (x + p[0]) * stride / zoom, v = (y + p[1]) * stride / zoom;
                    if (!std::isfinite(u + v + width + height)) continue;
                    boxes.emplace_back(u - width / 2, v - height / 2, width, height);
                    scores.push_back(score);
                    classes.push_back(static_cast<int>(best - p - 5));
                }
            }
        }
        // The best box of each object: those of its class that overlap a better one go, so classes are moved apart.
        std::vector<cv::Rect2d> apart = boxes;
        for (std::size_t i = 0; i < apart.size(); ++i) apart[i].x += 1e6 * classes[i];
        std::vector<int> kept;
        cv::dnn::NMSBoxes(apart, scores, 0.1f, 0.45f, kept);
        std::vector<gentrack2::Detection> detections;
        for (const int i : kept) {
            detections.push_back(
                gentrack2::detection(boxes[i].x, boxes[i].y, boxes[i].width, boxes[i].height, scores[i], classes[i]));
        }
        return detections;
    }

    cv::dnn::Net net_;
    cv::Size input_;
};

int main(int argc, char **argv) {
    cv::Size input;
    if (argc != 4 || std::sscanf(argv[3], "%dx%d", &input.width, &input.height) != 2 || input.width <= 0 ||
        input.height <= 0 || input.width % 32 != 0 || input.height % 32 != 0) {
        std::cerr << "usage: onnx_detector VIDEO MODEL WIDTHxHEIGHT, the model's input, multiples of 32\n";
        return EXIT_FAILURE;
    }
    try {
        // OpenCV tells of each of its readers that a file is not for; what this program says is enough.
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        cv::VideoCapture video(argv[1]);
        if (!video.isOpened()) throw std::runtime_error(std::string("cannot open ") + argv[1]);
        const double reported = video.get(cv::CAP_PROP_FPS), rate = reported >= 1 && reported <= 1000 ? reported : 30.0;
        Detector detect(argv[2], input);
        gentrack2::Config config("gentrack2");
        gentrack2::Tracker tracker(config.set("frame_rate", rate).set("class_policy", "same_class"));
        cv::Mat image;
        for (int t = 1; video.read(image); ++t) {
            const std::vector<gentrack2::Detection> detections = detect(image);
            gentrack2::Frame frame(detections);
            frame.image(gentrack2::image(image));
            for (const gentrack2::Track &track : tracker.step(frame)) {
                std::printf("%d,%llu,%.2f,%.2f,%.2f,%.2f,%.4f,%d\n", t, static_cast<unsigned long long>(track.id),
                            track.left, track.top, track.width, track.height, track.score, track.class_id);
            }
        }
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
