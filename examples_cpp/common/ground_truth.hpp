// The true boxes of a sequence, from a file in one of the MOTChallenge's formats.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "mot_rows.hpp"

namespace examples {

struct TrueBox {
    std::uint64_t object;
    cv::Rect2d box;
    /// Counts in scores. Others are marked as not to be scored, or of another kind.
    bool counts;
    /// Of a kind that a tracker may follow without being blamed or praised: MOT17's static persons, reflections and so
    /// on.
    bool distractor;
};

/// By frame.
using GroundTruth = std::map<long, std::vector<TrueBox>>;

/// Reads `frame,id,left,top,width,height[,flag[,class[,visibility]]]`: rows with flag 0 do not count, nor do classes
/// other than 1, the pedestrians. Rows of ten fields, as in MOT15, have no class but the place in the world. Throws
/// `UserError` with the line number and the reason for a bad row.
GroundTruth read_ground_truth(const std::string &path);

/// The same of a file that is in memory already.
GroundTruth parse_ground_truth(const NamedText &file);

}  // namespace examples
