// A tracker on a moving camera's frames, from C++11.
#include <iostream>
#include <vector>

#include <gentrack2.hpp>

int main() {
    gentrack2::Tracker tracker(gentrack2::Config("botsort"));
    std::uint64_t id = 0;
    for (int t = 0; t < 30; t++) {
        const std::vector<gentrack2::Detection> detections(1, gentrack2::detection(100.0 + 30 * t, 60, 40, 100, 0.9));
        gentrack2::Frame frame(detections);
        frame.camera_motion({{1, 0, 30, 0, 1, 0}});
        for (const gentrack2::Track &track : tracker.step(frame)) id = track.id;
    }
    std::cout << "gentrack2 " << gt2_version() << " from C++11: track " << id << " kept by a camera that moves\n";
    return id == 1 ? 0 : 1;
}
