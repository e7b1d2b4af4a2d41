#include "labels.hpp"

#include <algorithm>

#include "drawing.hpp"

namespace examples {

void Labels::add(const cv::Rect2d &box, const std::string &text, const cv::Scalar &plate, double size) {
    const cv::Rect2d picture(0, 0, image_.cols, image_.rows);
    if ((box & picture).area() <= 0) return;
    const cv::Size2d extent = plate_size(text, size);
    const double left = box.x, right = box.br().x - extent.width, above = box.y - extent.height, below = box.br().y;
    for (const cv::Point2d &corner : {cv::Point2d(left, above), cv::Point2d(right, above), cv::Point2d(left, below),
                                      cv::Point2d(right, below)}) {
        const cv::Rect2d place(corner, extent);
        if ((place & picture) == place && is_free(place)) return write(place, text, plate, size);
    }
    // In a crowd without room: where one looks for it, whatever is there.
    write({cv::Point2d(left, above), extent}, text, plate, size);
}

void Labels::add_below(const cv::Rect2d &box, const std::string &text, const cv::Scalar &plate, double size) {
    const cv::Size2d extent = plate_size(text, size);
    const cv::Rect2d place(box.x, box.br().y + 2, extent.width, extent.height);
    if (is_free(place) && place.y >= 0 && place.br().y < image_.rows) write(place, text, plate, size);
}

bool Labels::is_free(const cv::Rect2d &place) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const cv::Rect2d &t) { return (t & place).area() > 0; });
}

void Labels::write(const cv::Rect2d &place, const std::string &text, const cv::Scalar &plate, double size) {
    taken_.push_back(draw_plate(image_, text, {place.x, place.br().y}, plate, size));
}

}  // namespace examples
