// The colours of all pictures, BGR.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace examples {
namespace palette {

// Strong and weak as in the paper's figures. They also differ in lightness, and in the line that they are drawn with,
// for who cannot tell red from green.
inline const cv::Scalar strong(70, 225, 60), weak(70, 60, 255), tentative(190, 190, 190);
inline const cv::Scalar neighbours(255, 230, 120), motion(60, 225, 255), identity_switch(255, 60, 255);
inline const cv::Scalar white(255, 255, 255), black(0, 0, 0), plain(40, 40, 40), band(30, 30, 30), quiet(80, 80, 80);

}  // namespace palette

/// The colour of an identity, for trail and label; the same in every run, and different for neighbouring ids.
cv::Scalar identity_colour(std::uint64_t id);

/// Black or white, whichever is read better on that colour.
cv::Scalar readable_on(const cv::Scalar &colour);

}  // namespace examples
