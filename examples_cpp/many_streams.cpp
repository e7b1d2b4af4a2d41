// Many cameras on few cores: 64 streams, each with a tracker of its own, stepped by a pool of threads.
//
//   usage: many_streams [STREAMS [FRAMES [TRACKER]]]
//
// Prints frames per second with 1, 2, 4 ... threads, up to the machine's. Trackers share nothing: any thread may step any of
// them, as long as no two step the same one at a time. Here each thread takes the next stream that nobody has.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "gentrack2.hpp"

namespace {

// A camera with a detector: thirty people who walk to and fro.
class Stream {
  public:
    Stream(const std::string &tracker, int number) : tracker_(gentrack2::Config(tracker)), number_(number) {}

    void step(int frame) {
        detections_.clear();
        for (int i = 0; i < 30; i++) {
            if ((frame * 7 + i * 13 + number_) % 11 == 0) continue;  // missed
            const double phase = 0.01 * frame + i + number_;
            detections_.push_back(
                gentrack2::detection(900 + 850 * std::sin(phase), 20 + 30.0 * i, 50, 120, 0.9));
        }
        gentrack2::Frame input(detections_);
        input.size(1920, 1080);
        tracked_ += tracker_.step(input).size();
    }

    std::size_t tracked() const { return tracked_; }

  private:
    gentrack2::Tracker tracker_;
    int number_;
    std::vector<gentrack2::Detection> detections_;
    std::size_t tracked_ = 0;
};

double frames_per_second(std::vector<Stream> &streams, int frames, unsigned threads) {
    std::atomic<std::size_t> next{0};
    std::vector<std::exception_ptr> failures(threads);
    const auto work = [&](std::exception_ptr &failure) {
        try {
            for (std::size_t mine = next++; mine < streams.size(); mine = next++) {
                for (int frame = 0; frame < frames; frame++) streams[mine].step(frame);
            }
        } catch (...) {
            failure = std::current_exception();
        }
    };
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> pool;
    for (std::exception_ptr &failure : failures) pool.emplace_back(work, std::ref(failure));
    for (std::thread &thread : pool) thread.join();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    for (const std::exception_ptr &failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
    return static_cast<double>(streams.size()) * frames / took.count();
}

}  // namespace

int main(int argc, char **argv) {
    const int count = argc > 1 ? std::atoi(argv[1]) : 64;
    const int frames = argc > 2 ? std::atoi(argv[2]) : 300;
    const std::string name = argc > 3 ? argv[3] : "gentrack2";
    if (count < 1 || frames < 1 || argc > 4) {
        std::fprintf(stderr, "usage: many_streams [STREAMS [FRAMES [TRACKER]]]\n");
        return 2;
    }
    try {
        const unsigned most = std::max(1u, std::thread::hardware_concurrency());
        for (unsigned threads = 1; threads <= most; threads *= 2) {
            std::vector<Stream> streams;
            for (int i = 0; i < count; i++) streams.emplace_back(name, i);
            const double rate = frames_per_second(streams, frames, threads);
            std::size_t tracked = 0;
            for (const Stream &stream : streams) tracked += stream.tracked();
            std::printf("%d streams of %s on %u threads: %.0f frames/s, %zu boxes tracked\n", count, name.c_str(),
                        threads, rate, tracked);
        }
    } catch (const std::exception &error) {
        std::fprintf(stderr, "many_streams: %s\n", error.what());
        return 1;
    }
}
