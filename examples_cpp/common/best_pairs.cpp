#include "best_pairs.hpp"

#include <limits>

namespace examples {
namespace {

/// Shortest augmenting paths (Kuhn 1955, Munkres 1957) over rows, of which there are no more than columns. Index 0 of
/// rows and columns stands for nobody.
class Assignment {
public:
    explicit Assignment(const cv::Mat1d &scores)
        : scores_(scores), row_of_(scores.cols + 1, 0), row_price_(scores.rows + 1, 0.0), price_(scores.cols + 1, 0.0) {
        for (int row = 1; row <= scores.rows; ++row) add(row);
    }

    /// The row of a column, both from 0; -1 for none.
    int row_of(int column) const { return row_of_[column + 1] - 1; }

private:
    double reduced_cost(int row, int column) const {
        return -scores_(row - 1, column - 1) - row_price_[row] - price_[column];
    }

    void add(int row) {
        const int columns = scores_.cols;
        std::vector<double> distance(columns + 1, std::numeric_limits<double>::infinity());
        std::vector<int> came_from(columns + 1, 0);
        std::vector<bool> done(columns + 1, false);
        int at = 0;
        row_of_[0] = row;
        while (row_of_[at] != 0) {
            done[at] = true;
            int next = 0;
            double step = std::numeric_limits<double>::infinity();
            for (int c = 1; c <= columns; ++c) {
                if (done[c]) continue;
                const double cost = reduced_cost(row_of_[at], c);
                if (cost < distance[c]) distance[c] = cost, came_from[c] = at;
                if (distance[c] < step) step = distance[c], next = c;
            }
            for (int c = 0; c <= columns; ++c) {
                if (done[c]) {
                    row_price_[row_of_[c]] += step, price_[c] -= step;
                } else {
                    distance[c] -= step;
                }
            }
            at = next;
        }
        for (; at != 0; at = came_from[at]) row_of_[at] = row_of_[came_from[at]];
    }

    const cv::Mat1d &scores_;
    std::vector<int> row_of_;
    std::vector<double> row_price_, price_;
};

}  // namespace

std::vector<int> best_pairs(const cv::Mat1d &scores) {
    std::vector<int> column_of(scores.rows, -1);
    if (scores.empty()) return column_of;
    const bool wide = scores.rows <= scores.cols;
    const cv::Mat1d oriented = wide ? scores : cv::Mat1d(scores.t());
    const Assignment assignment(oriented);
    for (int column = 0; column < oriented.cols; ++column) {
        const int row = assignment.row_of(column);
        if (row >= 0 && oriented(row, column) > 0) column_of[wide ? row : column] = wide ? column : row;
    }
    return column_of;
}

}  // namespace examples
