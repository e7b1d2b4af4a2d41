// GenTrack2 with images against OpenCV's HOGDescriptor, in turns: a step of the tracker, everything included, and as many
// descriptors of 32x64 as its particles evaluated in that step, of patches cut out beforehand.
//
//   usage: hog_bench VIDEO DETECTIONS
//
// DETECTIONS is a MOTChallenge file for the first frames of VIDEO, written by OpenCV's people detector where it is missing.
// Prints lines of a name and a number.

#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

namespace {

constexpr int video_frames = 120;
constexpr int warm_up = 10;
constexpr int rounds = 3;

using Detections = std::vector<gentrack2::Detection>;

struct Scene {
    std::string name;
    double frame_rate;
    std::vector<cv::Mat> images;
    std::vector<Detections> detections;
};

double now_us() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::micro>(since).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double mean(const std::vector<double> &values) {
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

void detect(const std::vector<cv::Mat> &images, const std::string &path) {
    std::fprintf(stderr, "detecting people in %zu frames, once\n", images.size());
    cv::HOGDescriptor hog;
    hog.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
    std::ofstream file(path + ".part");
    for (std::size_t i = 0; i < images.size(); i++) {
        std::vector<cv::Rect> boxes;
        std::vector<double> scores;
        hog.detectMultiScale(images[i], boxes, scores, 0, cv::Size(8, 8), cv::Size(), 1.05, 2);
        for (std::size_t k = 0; k < boxes.size(); k++) {
            if (boxes[k].height > 160) continue;
            file << i + 1 << ",-1," << boxes[k].x << ',' << boxes[k].y << ',' << boxes[k].width << ','
                 << boxes[k].height << ',' << std::min(1.0, 0.3 + 0.5 * scores[k]) << "\n";
        }
    }
    file.close();
    if (!file || std::rename((path + ".part").c_str(), path.c_str()) != 0) throw std::runtime_error("cannot write " + path);
}

Scene from_video(const std::string &video, const std::string &path) {
    Scene scene{"vtest", 10, {}, {}};
    cv::VideoCapture capture(video);
    cv::Mat image;
    while (static_cast<int>(scene.images.size()) < video_frames && capture.read(image)) {
        scene.images.push_back(image.clone());
    }
    if (scene.images.empty()) throw std::runtime_error("cannot read " + video);
    if (!std::ifstream(path)) detect(scene.images, path);
    scene.detections.resize(scene.images.size());
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        int frame = 0;
        double x = 0, y = 0, w = 0, h = 0, score = 0;
        if (std::sscanf(line.c_str(), "%d,%*[^,],%lf,%lf,%lf,%lf,%lf", &frame, &x, &y, &w, &h, &score) != 6) {
            throw std::runtime_error(path + ": " + line);
        }
        if (frame >= 1 && frame <= static_cast<int>(scene.images.size())) {
            scene.detections[static_cast<std::size_t>(frame) - 1].push_back(gentrack2::detection(x, y, w, h, score));
        }
    }
    return scene;
}

// Forty-five textured people of 100 x 240 on a textured ground, who walk to and fro.
Scene made_up() {
    constexpr int width = 1920, height = 1080, people = 45, w = 100, h = 240, frames = 40;
    Scene scene{"1080p", 30, {}, {}};
    cv::RNG random(1);
    const auto texture = [&](int columns, int rows, int grain) {
        cv::Mat coarse(rows / grain + 1, columns / grain + 1, CV_8UC3), fine;
        random.fill(coarse, cv::RNG::UNIFORM, 0, 256);
        cv::resize(coarse, fine, cv::Size(columns, rows), 0, 0, cv::INTER_LINEAR);
        return fine;
    };
    const cv::Mat ground = texture(width, height, 24);
    std::vector<cv::Mat> looks;
    for (int i = 0; i < people; i++) looks.push_back(texture(w, h, 12));
    for (int t = 0; t < frames; t++) {
        cv::Mat image = ground.clone();
        Detections detections;
        for (int i = 0; i < people; i++) {
            const int x = 40 + 200 * (i % 9) + (i % 2 ? 2 : -2) * (t - frames / 2);
            const int y = 20 + 200 * (i / 9);
            looks[static_cast<std::size_t>(i)].copyTo(image(cv::Rect(x, y, w, h)));
            if (random.uniform(0, 10) == 0) continue;
            const double jitter = random.uniform(-1.0, 1.0);
            detections.push_back(gentrack2::detection(x + jitter, y - jitter, w, h, random.uniform(0.7, 0.95)));
        }
        scene.images.push_back(image);
        scene.detections.push_back(detections);
    }
    return scene;
}

void measure(const Scene &scene) {
    cv::HOGDescriptor hog(cv::Size(32, 64), cv::Size(16, 16), cv::Size(8, 8), cv::Size(8, 8), 9);
    std::vector<double> ours_rounds, theirs_rounds, per_descriptor_rounds;
    double evaluated = 0;
    for (int round = 0; round < rounds; round++) {
        gentrack2::Config config("gentrack2");
        config.set("frame_rate", scene.frame_rate);
        const auto per_target = config.integer("particles") * (config.integer("pso_iterations") + 1);
        gentrack2::Tracker tracker(config);
        std::vector<double> ours, theirs, descriptors;
        for (std::size_t t = 0; t < scene.images.size(); t++) {
            // Particles are evaluated for the tracks that there are before the step. Lost ones have theirs, too, but are
            // not counted.
            std::vector<cv::Mat> patches;
            for (const gentrack2::Track &track : tracker.reported()) {
                const cv::Rect box(cvRound(track.left), cvRound(track.top), cvRound(track.width), cvRound(track.height));
                const cv::Rect inside = box & cv::Rect(cv::Point(), scene.images[t].size());
                if (inside.area() < box.area() * 3 / 4 || box.width < 8 || box.height < 16) continue;
                cv::Mat gray, patch;
                cv::cvtColor(scene.images[t](inside), gray, cv::COLOR_BGR2GRAY);
                cv::resize(gray, patch, cv::Size(32, 64));
                patches.push_back(patch);
            }
            gentrack2::Frame frame(scene.detections[t]);
            frame.image(gentrack2::image(scene.images[t]));
            const double start = now_us();
            tracker.step(frame);
            const double step = now_us() - start;

            std::vector<float> descriptor;
            const double before = now_us();
            for (const cv::Mat &patch : patches) {
                for (std::int64_t i = 0; i < per_target; i++) hog.compute(patch, descriptor);
            }
            const double opencv = now_us() - before;
            if (t < warm_up) continue;
            ours.push_back(step);
            theirs.push_back(opencv);
            descriptors.push_back(static_cast<double>(patches.size()) * static_cast<double>(per_target));
        }
        ours_rounds.push_back(mean(ours));
        theirs_rounds.push_back(mean(theirs));
        evaluated = mean(descriptors);
    }
    std::printf("%s.step_us %.1f\n", scene.name.c_str(), median(ours_rounds));
    std::printf("%s.opencv_us %.1f\n", scene.name.c_str(), median(theirs_rounds));
    std::printf("%s.descriptors %.1f\n", scene.name.c_str(), evaluated);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: hog_bench VIDEO DETECTIONS\n");
        return 2;
    }
    try {
        cv::setNumThreads(1);
        measure(from_video(argv[1], argv[2]));
        measure(made_up());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "hog_bench: %s\n", error.what());
        return 1;
    }
}
