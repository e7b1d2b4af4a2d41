// A tracker that outlives its process: the first run tracks half of a scene and saves the tracker to a file, the second
// one goes on from there. Nobody gets another number.
//
//   save_restore tracker.snapshot        twice; the file is removed in the end
//
//   c++ -std=c++17 save_restore.cpp -lgentrack2

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "gentrack2.hpp"

// Two people who walk towards each other; stands for a camera and a detector.
static std::vector<gentrack2::Detection> detect(int t) {
    return {gentrack2::detection(20.0 + 4 * t, 60, 40, 100, 0.9), gentrack2::detection(380.0 - 4 * t, 80, 40, 100, 0.9)};
}

static void track(gentrack2::Tracker &tracker, int from, int to) {
    for (int t = from; t < to; ++t) {
        const std::vector<gentrack2::Detection> detections = detect(t);
        tracker.step(gentrack2::Frame(detections));
    }
    for (const gentrack2::Track &track : tracker.reported()) {
        std::cout << "frame " << to - 1 << ": track " << track.id << " at " << track.left << ", age " << track.age << '\n';
    }
}

int main(int argc, char **argv) {
    if (argc != 2) {
        std::cerr << "usage: save_restore FILE\n";
        return EXIT_FAILURE;
    }
    try {
        std::ifstream saved(argv[1], std::ios::binary);
        if (!saved) {
            gentrack2::Tracker tracker(gentrack2::Config("gentrack2").set("frame_rate", 25));
            track(tracker, 0, 45);  // they are side by side now
            const std::vector<std::uint8_t> bytes = tracker.save();
            std::ofstream file(argv[1], std::ios::binary);
            file.write(reinterpret_cast<const char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
            if (!file.flush()) throw std::runtime_error("the file cannot be written");
            std::cout << "saved in " << bytes.size() << " bytes; run this again\n";
            return EXIT_SUCCESS;
        }
        const std::vector<char> read((std::istreambuf_iterator<char>(saved)), std::istreambuf_iterator<char>());
        const std::vector<std::uint8_t> bytes(read.begin(), read.end());
        // A file that was cut, changed or is something else is refused here, with the reason.
        gentrack2::Tracker tracker = gentrack2::Tracker::load(bytes);
        track(tracker, 45, 90);
        std::remove(argv[1]);
        const gentrack2::Ids ids = tracker.track_of_detection();
        const std::vector<std::uint64_t> kept(ids.begin(), ids.end());
        return kept == std::vector<std::uint64_t>{1, 2} ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
