#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace examples {

Progress::Progress(long total) : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::at(long frame) {
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (shown_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    shown_ = true;
    if (total_ > 0) {
        std::fprintf(stderr, "\rframe %ld of %ld", frame, total_);
    } else {
        std::fprintf(stderr, "\rframe %ld", frame);
    }
    std::fflush(stderr);
}

void Progress::clear() {
    if (!shown_) return;
    shown_ = false;
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
}

}  // namespace examples
