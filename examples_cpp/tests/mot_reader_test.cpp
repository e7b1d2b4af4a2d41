// gt2_mot's reader on the seeds of its fuzzer, on random children of them, and on bytes at random: what fuzz/mot_reader
// runs, with any compiler, in a few seconds.
//
//   usage: mot_reader_test SEEDS [INPUTS]

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "drive.hpp"
#include "text.hpp"

namespace {

using Noise = std::mt19937_64;

std::size_t below(Noise &noise, std::size_t n) { return static_cast<std::size_t>(noise() % n); }

/// What breaks readers of numbers and lines, beside single bytes.
const std::vector<std::string> snippets = {
    "\n", "\r\n", ",", ",,", " ", "\x1e", "-", "+", "+-1", "1e999", "-1e-999", "nan", "inf", "0x1p3", "1e12",
    "1.0000001e12", "9007199254740993", "10000001", "\xef\xbb\xbf", std::string(1, '\0'), "0.5", "1e-300",
    "1\n2,-1,10,10,20,40,0.9",
};

void mutate(std::string &input, Noise &noise, const std::vector<std::string> &seeds) {
    const auto at = below(noise, input.size() + 1);
    switch (below(noise, 6)) {
        case 0:
            if (at < input.size()) input[at] = static_cast<char>(noise());
            break;
        case 1:
            input.insert(at, snippets[below(noise, snippets.size())]);
            break;
        case 2:
            input.erase(at, 1 + below(noise, 12));
            break;
        case 3:  // digits become other digits: still numbers
            for (std::size_t i = at; i < std::min(input.size(), at + 8); ++i) {
                if (input[i] >= '0' && input[i] <= '9') input[i] = static_cast<char>('0' + below(noise, 10));
            }
            break;
        case 4: {
            const std::string &other = seeds[below(noise, seeds.size())];
            const auto from = below(noise, other.size() + 1);
            input.insert(at, other.substr(from, below(noise, 80)));
            break;
        }
        default:
            input.resize(std::max(at, input.size() / 2));
    }
}

bool run(const std::string &input) {
    return mot_reader::run(reinterpret_cast<const std::uint8_t *>(input.data()), input.size());
}

}  // namespace

int main(int argc, char **argv) {
    if (argc < 2) return std::fprintf(stderr, "usage: mot_reader_test SEEDS [INPUTS]\n"), 2;
    const long inputs = argc > 2 ? std::strtol(argv[2], nullptr, 10) : 100000;
    std::vector<std::string> paths, seeds;
    for (const auto &entry : std::filesystem::directory_iterator(argv[1])) paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    for (const std::string &path : paths) seeds.push_back(examples::read_file(path));
    if (seeds.empty()) return std::fprintf(stderr, "%s: there are no seeds\n", argv[1]), 1;
    long accepted = 0;
    for (const std::string &seed : seeds) run(seed);
    Noise noise(1);
    for (long i = 0; i < inputs; ++i) {
        std::string input = seeds[below(noise, seeds.size())];
        if (i % 50 == 0) {
            input.resize(below(noise, 400));
            for (char &c : input) c = static_cast<char>(noise());
        }
        for (auto times = 1 + below(noise, 4); times > 0; --times) mutate(input, noise, seeds);
        accepted += run(input);
    }
    std::printf("%zu seeds, %ld inputs, %ld of them accepted\n", seeds.size(), inputs, accepted);
    // Neither all nor none, or there was nothing to see.
    return accepted > inputs / 20 && accepted < inputs ? 0 : 1;
}
