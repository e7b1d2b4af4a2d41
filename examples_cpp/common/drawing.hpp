// Lines, boxes and texts on pictures, at fractions of a pixel: boxes move smoothly only so.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace examples {

/// Sizes of lines and texts suit pictures of 768x576 pixels; larger ones have them larger by this.
double scale_of(const cv::Mat &image);

/// How a box or line is drawn.
enum class Stroke { solid, dashed, dotted };

struct Pen {
    cv::Scalar colour;
    double thickness;
    Stroke stroke = Stroke::solid;
    /// A dark edge along it, by which it is seen on any ground.
    bool edged = true;
};

void draw_line(cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, const Pen &pen);
void draw_arrow(cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, const Pen &pen);
void draw_box(cv::Mat &image, const cv::Rect2d &box, const Pen &pen);
void draw_dot(cv::Mat &image, const cv::Point2d &centre, double radius, const cv::Scalar &colour);

/// Colours the inside of a box, so that `share` of it is that colour and the rest is what was there.
void tint_box(cv::Mat &image, const cv::Rect2d &box, const cv::Scalar &colour, double share);

/// The size of a text on its plate.
cv::Size plate_size(const std::string &text, double size);

/// Text on a filled plate whose lower left corner is `corner`, pushed back into the image. Returns the plate.
cv::Rect draw_plate(cv::Mat &image, const std::string &text, const cv::Point2d &corner, const cv::Scalar &plate,
                    double size);

/// The middle of a box, and of its lower edge.
cv::Point2d centre_of(const cv::Rect2d &box);
cv::Point2d foot_of(const cv::Rect2d &box);

}  // namespace examples
