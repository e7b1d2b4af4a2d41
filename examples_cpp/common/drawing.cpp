#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "palette.hpp"

namespace examples {
namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
/// Fractional bits of the coordinates given to OpenCV.
constexpr int shift = 4;

/// A coordinate in drawing units; far outside the image it does not matter where, but it must fit an int.
int fixed_point(double x) { return static_cast<int>(std::lround(std::clamp(x, -3e4, 1e5) * (1 << shift))); }

cv::Point fixed_point(const cv::Point2d &p) { return {fixed_point(p.x), fixed_point(p.y)}; }

int whole(double thickness) { return std::max(1, static_cast<int>(std::lround(thickness))); }

void solid_line(cv::Mat &image, const cv::Point2d &a, const cv::Point2d &b, const cv::Scalar &colour, int thickness) {
    cv::line(image, fixed_point(a), fixed_point(b), colour, thickness, cv::LINE_AA, shift);
}

/// Calls `visit` with both ends of each piece of a line that is on.
template <typename Visit>
void for_each_dash(const cv::Point2d &a, const cv::Point2d &b, const Pen &pen, Visit visit) {
    const cv::Point2d whole = b - a;
    const double length = std::hypot(whole.x, whole.y);
    // A box outside the image, or as large as a bad model makes it, is not worth a million dashes.
    if (length < 1 || length > 1e4) return;
    const bool dotted = pen.stroke == Stroke::dotted;
    const double on = pen.thickness * (dotted ? 1.0 : 4.0), off = pen.thickness * (dotted ? 3.0 : 2.5);
    // A whole number of periods and a dash at the end: the corners of a box are there.
    const double periods = std::max(1.0, std::round((length - on) / (on + off)));
    const double period = std::max(0.0, length - on) / periods;
    for (int i = 0; i <= static_cast<int>(periods); ++i) {
        visit(a + whole * (i * period / length), a + whole * (std::min(i * period + on, length) / length));
    }
}

void stroke(cv::Mat &image, const cv::Point2d &a, const cv::Point2d &b, const Pen &pen, const cv::Scalar &colour,
            int thickness) {
    if (pen.stroke == Stroke::solid) return solid_line(image, a, b, colour, thickness);
    for_each_dash(a, b, pen, [&](const cv::Point2d &from, const cv::Point2d &to) {
        solid_line(image, from, to, colour, thickness);
    });
}

/// Draws a shape twice where it has an edge: wider and dark, then itself.
template <typename Shape>
void with_edge(const Pen &pen, Shape shape) {
    if (pen.edged) shape(palette::black, whole(pen.thickness) + 2);
    shape(pen.colour, whole(pen.thickness));
}

int text_thickness(double size) { return size >= 0.9 ? 2 : 1; }
int plate_margin(double size) { return static_cast<int>(std::lround(4 * size)) + 1; }

}  // namespace

double scale_of(const cv::Mat &image) { return std::max(1.0, std::sqrt(image.rows * image.cols / (768.0 * 576.0))); }

void draw_line(cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, const Pen &pen) {
    with_edge(pen, [&](const cv::Scalar &colour, int thickness) { stroke(image, from, to, pen, colour, thickness); });
}

void draw_arrow(cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, const Pen &pen) {
    const cv::Point2d along = to - from;
    const double length = std::hypot(along.x, along.y);
    if (length < 1) return;
    // The head keeps its size, but for arrows that are shorter.
    const double head = std::min(5.0 * pen.thickness, length) / length;
    const cv::Point2d back = to - along * head, across = cv::Point2d(-along.y, along.x) * (head * 0.6);
    with_edge(pen, [&](const cv::Scalar &colour, int thickness) {
        solid_line(image, from, to, colour, thickness);
        solid_line(image, to, back + across, colour, thickness);
        solid_line(image, to, back - across, colour, thickness);
    });
}

void draw_box(cv::Mat &image, const cv::Rect2d &box, const Pen &pen) {
    const cv::Point2d a = box.tl(), c = box.br(), b(c.x, a.y), d(a.x, c.y);
    with_edge(pen, [&](const cv::Scalar &colour, int thickness) {
        for (const auto &[from, to] : {std::pair(a, b), std::pair(b, c), std::pair(d, c), std::pair(a, d)}) {
            stroke(image, from, to, pen, colour, thickness);
        }
    });
}

void draw_dot(cv::Mat &image, const cv::Point2d &centre, double radius, const cv::Scalar &colour) {
    const auto disc = [&](double r, const cv::Scalar &c) {
        cv::circle(image, fixed_point(centre), fixed_point(r), c, cv::FILLED, cv::LINE_AA, shift);
    };
    disc(radius + 1, palette::black);
    disc(radius, colour);
}

void tint_box(cv::Mat &image, const cv::Rect2d &box, const cv::Scalar &colour, double share) {
    const cv::Rect2d seen = box & cv::Rect2d(0, 0, image.cols, image.rows);
    const cv::Rect area(cv::Point(seen.tl()), cv::Point(seen.br()));
    if (area.empty()) return;
    cv::Mat part = image(area);
    cv::addWeighted(part, 1 - share, cv::Mat(part.size(), part.type(), colour), share, 0, part);
}

cv::Size plate_size(const std::string &text, double size) {
    int baseline = 0;
    const cv::Size extent = cv::getTextSize(text, font, size, text_thickness(size), &baseline);
    return {extent.width + 2 * plate_margin(size), extent.height + 2 * plate_margin(size)};
}

cv::Rect draw_plate(cv::Mat &image, const std::string &text, const cv::Point2d &corner, const cv::Scalar &plate,
                    double size) {
    const cv::Size extent = plate_size(text, size);
    const auto inside = [](double x, int most) {
        return static_cast<int>(std::lround(std::clamp(x, 0.0, std::max(0.0, static_cast<double>(most)))));
    };
    const cv::Rect area(inside(corner.x, image.cols - extent.width),
                        inside(corner.y - extent.height, image.rows - extent.height), extent.width, extent.height);
    cv::rectangle(image, area, plate, cv::FILLED);
    const int margin = plate_margin(size);
    cv::putText(image, text, {area.x + margin, area.br().y - margin}, font, size, readable_on(plate),
                text_thickness(size), cv::LINE_AA);
    return area;
}

cv::Point2d centre_of(const cv::Rect2d &box) { return {box.x + box.width / 2, box.y + box.height / 2}; }

cv::Point2d foot_of(const cv::Rect2d &box) { return {box.x + box.width / 2, box.y + box.height}; }

}  // namespace examples
