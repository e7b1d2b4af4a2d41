// Which of the rows goes with which of the columns.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace examples {

/// The pairs of rows and columns of `scores` whose sum is highest, each row and each column in one pair at most: for
/// each row its column, -1 for none. Scores are 0 where a pair is not allowed, and above 0 elsewhere.
std::vector<int> best_pairs(const cv::Mat1d &scores);

}  // namespace examples
