// Looks from a re-identification model in ONNX, through cv::dnn: each detection is cut out, resized to the model's input
// and turned into an embedding, which the tracker compares. Any model will do that takes a batch of RGB crops and gives a
// row of numbers for each, such as OSNet's.
//
//   reid_embeddings walk.mp4 walk-det.txt model.onnx WIDTHxHEIGHT > walk.txt     (128x256 for most models)
//
//   c++ -std=c++17 reid_embeddings.cpp $(pkg-config --cflags --libs opencv4) -lgentrack2

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

using Detections = std::map<int, std::vector<gentrack2::Detection>>;

// MOTChallenge rows by frame. Put your own detector in its place.
static Detections read_detections(const std::string &path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    Detections all;
    for (std::string line; std::getline(file, line);) {
        int frame = 0;
        double left = 0, top = 0, width = 0, height = 0, score = 0;
        if (std::sscanf(line.c_str(), "%d,%*d,%lf,%lf,%lf,%lf,%lf", &frame, &left, &top, &width, &height, &score) == 6) {
            all[frame].push_back(gentrack2::detection(left, top, width, height, score));
        }
    }
    return all;
}

class Embedder {
public:
    Embedder(const std::string &model, cv::Size input) : net_(cv::dnn::readNetFromONNX(model)), input_(input) {}

    /// One row of floats per detection.
    cv::Mat operator()(const cv::Mat &image, const std::vector<gentrack2::Detection> &detections) {
        std::vector<cv::Mat> crops;
        for (const gentrack2::Detection &d : detections) {
            const cv::Rect inside = cv::Rect(gentrack2::rect(d)) & cv::Rect({0, 0}, image.size());
            // Of what lies outside nothing is to be seen; a grey crop resembles nobody in particular.
            cv::Mat crop(input_, CV_8UC3, cv::Scalar::all(114));
            if (!inside.empty()) cv::resize(image(inside), crop, input_);
            crops.push_back(crop);
        }
        if (crops.empty()) return {};
        // The usual normalisation: mean and one common deviation of ImageNet, channels in the order R, G, B.
        net_.setInput(cv::dnn::blobFromImages(crops, 1.0 / (255 * 0.226), input_, cv::Scalar(123.7, 116.3, 103.5), true));
        return net_.forward().reshape(1, static_cast<int>(crops.size())).clone();
    }

private:
    cv::dnn::Net net_;
    cv::Size input_;
};

int main(int argc, char **argv) {
    cv::Size input;
    if (argc != 5 || std::sscanf(argv[4], "%dx%d", &input.width, &input.height) != 2 || input.empty()) {
        std::cerr << "usage: reid_embeddings VIDEO DETECTIONS MODEL WIDTHxHEIGHT\n";
        return EXIT_FAILURE;
    }
    try {
        // OpenCV tells of each of its readers that a file is not for; what this program says is enough.
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        Detections detections = read_detections(argv[2]);
        cv::VideoCapture video(argv[1]);
        if (!video.isOpened()) throw std::runtime_error(std::string("cannot open ") + argv[1]);
        const double reported = video.get(cv::CAP_PROP_FPS), rate = reported >= 1 && reported <= 1000 ? reported : 30.0;
        Embedder embed(argv[3], input);
        gentrack2::Tracker tracker(gentrack2::Config("gentrack2").set("frame_rate", rate));
        cv::Mat image;
        for (int t = 1; video.read(image); ++t) {
            const cv::Mat looks = embed(image, detections[t]);
            gentrack2::Frame frame(detections[t]);
            if (!looks.empty()) frame.embeddings(looks.ptr<float>(), static_cast<std::size_t>(looks.cols));
            for (const gentrack2::Track &track : tracker.step(frame)) {
                std::printf("%d,%llu,%.2f,%.2f,%.2f,%.2f,%.4f,-1,-1,-1\n", t, static_cast<unsigned long long>(track.id),
                            track.left, track.top, track.width, track.height, track.score);
            }
        }
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
