// How long the tracker's steps took.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace examples {

class StepTimes {
public:
    using Clock = std::chrono::steady_clock;

    void add(Clock::duration step) { microseconds_.push_back(std::chrono::duration<double, std::micro>(step).count()); }

    /// Mean in microseconds, 0 without steps.
    double mean() const;

    /// One line: steps, total in ms; mean, median and 99th percentile in microseconds.
    std::string summary() const;

private:
    std::vector<double> microseconds_;
};

}  // namespace examples
