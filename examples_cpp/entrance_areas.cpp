// Where people may leave: somebody walks to a door and somebody else stands beside a pillar, and both are unseen from then
// on. With the door as an entrance area the tracker forgets the one at the door sooner, so that the next visitor
// does not get that number; the one behind the pillar keeps theirs.
//
//   c++ -std=c++17 entrance_areas.cpp -lgentrack2

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "gentrack2.hpp"

namespace {

constexpr int seen_until = 50, frames = 400;

/// For how many frames each of the two, of tags 1 and 2, is remembered after the last detection.
struct Memory {
    int at_the_door = 0, at_the_pillar = 0;
};

Memory watch(const std::string &areas) {
    gentrack2::Config config("gentrack2");
    config.set("frame_rate", 25).set("entrance_penalty", 1.0);
    // left,top,width,height of each area in pixels, separated by semicolons.
    if (!areas.empty()) config.set("entrance_areas", areas);
    gentrack2::Tracker tracker(config);
    std::uint64_t door = 0, pillar = 0;
    Memory memory;
    for (int t = 0; t < frames; ++t) {
        std::vector<gentrack2::Detection> detections;
        if (t < seen_until) {
            detections.push_back(gentrack2::detection(340 + 4 * std::min(t, 40), 200, 40, 100, 0.9, 0, 1));
            detections.push_back(gentrack2::detection(150, 220, 40, 100, 0.9, 0, 2));
        }
        gentrack2::Frame frame(detections);
        frame.size(640, 480);
        for (const gentrack2::Track &track : tracker.step(frame)) {
            if (track.tag == 1) door = track.id;
            if (track.tag == 2) pillar = track.id;
        }
        for (const std::uint64_t id : tracker.ended()) {
            if (id == door) memory.at_the_door = t - seen_until;
            if (id == pillar) memory.at_the_pillar = t - seen_until;
        }
    }
    return memory;
}

}  // namespace

int main() {
    try {
        const Memory without = watch(""), with = watch("500,100,140,300");
        std::cout << "remembered for so many frames   at the door   behind the pillar\n"
                  << "without areas                   " << without.at_the_door << "            " << without.at_the_pillar
                  << "\nthe door is an entrance area    " << with.at_the_door << "            " << with.at_the_pillar
                  << '\n';
        const bool as_meant = with.at_the_door > 0 && with.at_the_door < without.at_the_door &&
                              with.at_the_pillar == without.at_the_pillar;
        return as_meant ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const gentrack2::Error &error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
