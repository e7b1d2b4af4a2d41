// The C++ wrapper: particles, an error as an exception, ended tracks.
#include <iostream>
#include <vector>

#include <gentrack2.hpp>

int main() {
    gentrack2::Tracker tracker(gentrack2::Config("gentrack2").set("frame_rate", 25).set("max_missed", 5));
    std::size_t ended = 0, particles = 0;
    for (int t = 0; t < 60; t++) {
        std::vector<gentrack2::Detection> detections;
        if (t < 30) detections.push_back(gentrack2::detection(20.0 + 4 * t, 60, 40, 100, 0.9));
        for (const auto &track : tracker.step(gentrack2::Frame(detections))) {
            particles = tracker.particles(track.id).size();
        }
        ended += tracker.ended().size();
    }
    bool refused = false;
    try {
        gentrack2::Config("gentrack2").set("no_such_parameter", 1);
    } catch (const gentrack2::Error &) {
        refused = true;
    }
    std::cout << "gentrack2 " << gt2_version() << " from C++17: " << particles << " particles, " << ended << " track ended\n";
    return refused && ended == 1 && particles > 0 ? 0 : 1;
}
