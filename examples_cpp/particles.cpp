// What GenTrack2 thinks of its targets: every particle of every track is drawn, the fitter the brighter, and the box that
// came of them.
//
//   particles walk.mp4 walk-det.txt walk-particles.mp4     (the last may be a picture, .png: of the last frame)
//
//   c++ -std=c++17 particles.cpp $(pkg-config --cflags --libs opencv4) -lgentrack2

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
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

static std::size_t draw(cv::Mat &image, const gentrack2::Tracker &tracker) {
    std::size_t drawn = 0;
    for (const gentrack2::Track &track : tracker.reported()) {
        for (const gentrack2::Particle &particle : tracker.particles(track.id)) {
            const double brightness = 60 + 195 * particle.fitness;
            const cv::Point centre(cvRound(particle.left + particle.width / 2), cvRound(particle.top + particle.height / 2));
            // Where the particle would be in a tenth of a second.
            const cv::Point ahead = centre + cv::Point(cvRound(particle.velocity_u / 10), cvRound(particle.velocity_v / 10));
            cv::rectangle(image, gentrack2::rect(particle), cv::Scalar(brightness, brightness / 2, 0), 1);
            cv::line(image, centre, ahead, cv::Scalar(0, brightness, brightness), 1);
            cv::circle(image, centre, 2, cv::Scalar(0, brightness, brightness), cv::FILLED);
            ++drawn;
        }
        cv::rectangle(image, gentrack2::rect(track), cv::Scalar(60, 200, 40), 2);
        cv::putText(image, std::to_string(track.id), cv::Point(cvRound(track.left), cvRound(track.top) - 4),
                    cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(60, 200, 40), 1);
    }
    return drawn;
}

int main(int argc, char **argv) {
    if (argc != 4) {
        std::cerr << "usage: particles VIDEO DETECTIONS RESULT\n";
        return EXIT_FAILURE;
    }
    try {
        // OpenCV tells of each of its readers that a file is not for; what this program says is enough.
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        const std::string result = argv[3];
        const bool picture = result.size() > 4 && result.substr(result.size() - 4) == ".png";
        Detections detections = read_detections(argv[2]);
        cv::VideoCapture video(argv[1]);
        if (!video.isOpened()) throw std::runtime_error(std::string("cannot open ") + argv[1]);
        const double reported = video.get(cv::CAP_PROP_FPS), rate = reported >= 1 && reported <= 1000 ? reported : 30.0;
        gentrack2::Tracker tracker(gentrack2::Config("gentrack2").set("frame_rate", rate));
        cv::VideoWriter writer;
        std::size_t drawn = 0;
        cv::Mat last;
        int t = 0;
        for (cv::Mat image; video.read(image); last = image.clone()) {
            ++t;
            gentrack2::Frame frame(detections[t]);
            frame.image(gentrack2::image(image));
            tracker.step(frame);
            drawn += draw(image, tracker);
            if (picture) continue;
            if (!writer.isOpened() &&
                !writer.open(result, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), rate, image.size())) {
                throw std::runtime_error("cannot write " + result);
            }
            writer.write(image);
        }
        if (picture && (last.empty() || !cv::imwrite(result, last))) throw std::runtime_error("cannot write " + result);
        std::cout << drawn << " particles drawn\n";
        return drawn > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
