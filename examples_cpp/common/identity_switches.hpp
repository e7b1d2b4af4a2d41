// Counts identity switches as CLEAR MOT does (Bernardin and Stiefelhagen 2008), frame by frame.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "ground_truth.hpp"

namespace examples {

/// A box of a result.
struct TrackedBox {
    std::uint64_t id;
    cv::Rect2d box;
};

/// An object that another track has than the one before.
struct IdentitySwitch {
    std::uint64_t object, before, now;
};

class IdentitySwitches {
public:
    /// Matches a frame's tracks with its true boxes at an IoU of 0.5 or more, pairs of the frame before first, and
    /// returns the switches. Tracks that are on distractors are left out, as the MOTChallenge's judges do.
    std::vector<IdentitySwitch> add(const std::vector<TrueBox> &truth, const std::vector<TrackedBox> &tracks);

    /// Switches so far.
    long count() const { return count_; }

private:
    /// By object: the track that had it last, and the one that had it in the last frame with anything to match.
    std::map<std::uint64_t, std::uint64_t> last_, before_;
    long count_ = 0;
};

}  // namespace examples
