#include "timing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace examples {

double StepTimes::mean() const {
    if (microseconds_.empty()) return 0.0;
    const double total = std::accumulate(microseconds_.begin(), microseconds_.end(), 0.0);
    return total / static_cast<double>(microseconds_.size());
}

std::string StepTimes::summary() const {
    if (microseconds_.empty()) return "steps 0";
    std::vector<double> sorted = microseconds_;
    std::sort(sorted.begin(), sorted.end());
    // Nearest rank: the smallest time that at least that share of the steps did not exceed.
    const auto at = [&](double share) {
        const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
        return sorted[std::max<std::size_t>(rank, 1) - 1];
    };
    const double total = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    char line[160];
    std::snprintf(line, sizeof line, "steps %zu, total %.3f ms, mean %.2f us, median %.2f us, p99 %.2f us",
                  sorted.size(), total / 1000, total / static_cast<double>(sorted.size()), at(0.5), at(0.99));
    return line;
}

}  // namespace examples
