#include "palette.hpp"

#include <algorithm>
#include <cmath>

namespace examples {

cv::Scalar identity_colour(std::uint64_t id) {
    // Golden-angle steps around the colour circle keep neighbouring ids far apart. Ids 8, 13 or 21 apart have nearly
    // the same hue, so the highest and the lowest channel go by another measure.
    static constexpr double values[] = {255, 190, 255, 225, 165}, lows[] = {50, 30, 145, 90, 55};
    const double hue = std::fmod(static_cast<double>(id % 997) * 0.61803398875, 1.0) * 6.0;
    const double value = values[id % 5], low = lows[id % 5];
    const auto channel = [&](double offset) {
        const double k = std::fmod(hue + offset, 6.0);
        return value - (value - low) * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    };
    return {channel(1.0), channel(3.0), channel(5.0)};
}

cv::Scalar readable_on(const cv::Scalar &colour) {
    const double luminance = 0.114 * colour[0] + 0.587 * colour[1] + 0.299 * colour[2];
    return luminance > 120 ? palette::black : palette::white;
}

}  // namespace examples
