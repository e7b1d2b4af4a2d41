// Tracks people in a video or in front of a camera: open, detect, track, draw.
//
//   webcam_or_video                    the first camera, in a window; Esc or q ends
//   webcam_or_video walk.mp4           a video, in a window
//   webcam_or_video walk.mp4 out.mp4   a video, to a file
//
//   c++ -std=c++17 webcam_or_video.cpp $(pkg-config --cflags --libs opencv4) -lgentrack2

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

// Put your own detector here: a box in pixels and a score in 0..1 for each object is all that is needed.
class PeopleDetector {
public:
    PeopleDetector() { hog_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector()); }

    std::vector<gentrack2::Detection> operator()(const cv::Mat &image) {
        std::vector<cv::Rect> windows;
        std::vector<double> margins;
        hog_.detectMultiScale(image, windows, margins, 0.0, {8, 8}, {16, 16}, 1.1, 0);
        std::vector<cv::Rect> boxes;
        std::vector<float> scores;
        for (std::size_t i = 0; i < windows.size(); ++i) {
            // The person fills the middle of the window; the margin becomes a probability.
            const cv::Rect &w = windows[i];
            boxes.emplace_back(w.x + w.width / 4, w.y + w.height / 8, w.width / 2, w.height * 3 / 4);
            scores.push_back(static_cast<float>(1.0 / (1.0 + std::exp(-3.0 * (margins[i] - 0.75)))));
        }
        // The best window of each person: those that overlap a better one go.
        std::vector<std::size_t> order(boxes.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
        std::vector<gentrack2::Detection> detections;
        std::vector<cv::Rect> kept;
        for (const std::size_t i : order) {
            const bool doubled = std::any_of(kept.begin(), kept.end(), [&](const cv::Rect &k) {
                return (k & boxes[i]).area() > 0.4 * (k | boxes[i]).area();
            });
            if (doubled) continue;
            kept.push_back(boxes[i]);
            detections.push_back(gentrack2::detection(boxes[i], scores[i]));
        }
        return detections;
    }

private:
    cv::HOGDescriptor hog_;
};

static void draw(cv::Mat &image, const gentrack2::Track &track) {
    const bool seen = track.detection_index >= 0;
    const cv::Scalar colour = seen ? cv::Scalar(60, 200, 40) : cv::Scalar(50, 50, 235);
    const cv::Rect box = gentrack2::rect(track);
    cv::rectangle(image, box, colour, seen ? 2 : 1);
    cv::putText(image, std::to_string(track.id), box.tl() - cv::Point(0, 4), cv::FONT_HERSHEY_SIMPLEX, 0.6, colour, 2);
}

int main(int argc, char **argv) {
    const std::string input = argc > 1 ? argv[1] : "", output = argc > 2 ? argv[2] : "";
    // OpenCV tells of each of its readers that a file is not for; what this program says is enough.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    cv::VideoCapture video;
    if (!(input.empty() ? video.open(0) : video.open(input))) {
        std::cerr << "cannot open " << (input.empty() ? "the camera" : input) << '\n';
        return EXIT_FAILURE;
    }
    const double reported_rate = video.get(cv::CAP_PROP_FPS);
    const double rate = reported_rate >= 1 && reported_rate <= 1000 ? reported_rate : 30.0;
    try {
        gentrack2::Tracker tracker(gentrack2::Config("gentrack2").set("frame_rate", rate));
        PeopleDetector detect;
        cv::VideoWriter writer;
        for (cv::Mat image; video.read(image) && !image.empty();) {
            const std::vector<gentrack2::Detection> detections = detect(image);
            gentrack2::Frame frame(detections);
            frame.image(gentrack2::image(image));
            const gentrack2::Tracks tracks = tracker.step(frame);
            for (const gentrack2::Track &track : tracks) draw(image, track);
            if (output.empty()) {
                cv::imshow("gentrack2", image);
                const int key = cv::waitKey(1);
                if (key == 27 || key == 'q') break;
                continue;
            }
            if (!writer.isOpened() &&
                !writer.open(output, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), rate, image.size())) {
                std::cerr << "cannot write " << output << '\n';
                return EXIT_FAILURE;
            }
            writer.write(image);
        }
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
