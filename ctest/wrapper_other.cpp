// The other translation unit: both include the wrapper, and pass its types to each other.
#include <gentrack2.hpp>

std::vector<gentrack2::Track> track_elsewhere(gentrack2::Tracker &tracker, int from, int to);
std::vector<gentrack2::Detection> objects(int t);

std::vector<gentrack2::Detection> objects(int t) {
    return {gentrack2::detection(50 + 2 * t, 60, 40, 100, 0.9, 0, 101),
            gentrack2::detection(300 - 2 * t, 200, 40, 100, 0.8, 0, 102)};
}

std::vector<gentrack2::Track> track_elsewhere(gentrack2::Tracker &tracker, int from, int to) {
    for (int t = from; t < to; t++) {
        const std::vector<gentrack2::Detection> detections = objects(t);
        tracker.step(gentrack2::Frame(detections));
    }
    return tracker.reported().to_vector();
}
