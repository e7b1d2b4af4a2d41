// A counter on a terminal; nothing in a pipe.
#pragma once

#include <chrono>
#include <string>

namespace examples {

class Progress {
public:
    /// `total` is the number of frames, 0 if unknown.
    explicit Progress(long total);
    ~Progress() { clear(); }

    void at(long frame);

    /// Removes the line from the terminal.
    void clear();

private:
    long total_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace examples
