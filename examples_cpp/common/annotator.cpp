#include "annotator.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace examples {
namespace {

const cv::Scalar green(60, 200, 40), red(50, 50, 235), grey(170, 170, 170), white(255, 255, 255), black(0, 0, 0);
constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr std::size_t trail_length = 40;
/// Fractional bits of the coordinates given to OpenCV: boxes move smoothly only with subpixel drawing.
constexpr int shift = 4;

/// Sizes of text and lines suit frames of this height and grow with it.
double scale_of(const cv::Mat &image) { return std::max(1.0, image.rows / 576.0); }

/// A coordinate in drawing units; far outside the image it does not matter where, but it must fit an int.
int fixed_point(double x) { return static_cast<int>(std::lround(std::clamp(x, -3e4, 1e5) * (1 << shift))); }

cv::Point fixed_point(const cv::Point2d &p) { return {fixed_point(p.x), fixed_point(p.y)}; }

void line(cv::Mat &image, const cv::Point2d &a, const cv::Point2d &b, const cv::Scalar &colour, int thickness) {
    cv::line(image, fixed_point(a), fixed_point(b), colour, thickness, cv::LINE_AA, shift);
}

void solid_box(cv::Mat &image, const cv::Rect2d &box, const cv::Scalar &colour, int thickness) {
    cv::rectangle(image, fixed_point(box.tl()), fixed_point(box.br()), colour, thickness, cv::LINE_AA, shift);
}

void dashed_line(cv::Mat &image, cv::Point2d a, cv::Point2d b, const cv::Scalar &colour, int thickness, double dash) {
    cv::Point2d whole = b - a;
    const double length = std::hypot(whole.x, whole.y);
    // A box outside the image, or as large as a bad model makes it, is not worth a million dashes.
    if (length < 1 || length > 1e4) return;
    whole /= length;
    for (double at = 0; at < length; at += 2 * dash) {
        line(image, a + whole * at, a + whole * std::min(at + dash, length), colour, thickness);
    }
}

void dashed_box(cv::Mat &image, const cv::Rect2d &box, const cv::Scalar &colour, int thickness, double dash) {
    const cv::Point2d a = box.tl(), c = box.br(), b(c.x, a.y), d(a.x, c.y);
    dashed_line(image, a, b, colour, thickness, dash);
    dashed_line(image, b, c, colour, thickness, dash);
    dashed_line(image, d, c, colour, thickness, dash);
    dashed_line(image, a, d, colour, thickness, dash);
}

/// Text on a filled plate whose lower left corner is `corner`, pushed back into the image.
void label(cv::Mat &image, const std::string &text, cv::Point corner, const cv::Scalar &plate, double size) {
    const int thickness = size >= 0.9 ? 2 : 1;
    int baseline = 0;
    const cv::Size extent = cv::getTextSize(text, font, size, thickness, &baseline);
    const int margin = static_cast<int>(std::lround(4 * size)) + 1;
    cv::Rect area(corner.x, corner.y - extent.height - 2 * margin, extent.width + 2 * margin,
                  extent.height + 2 * margin);
    area.x = std::clamp(area.x, 0, std::max(0, image.cols - area.width));
    area.y = std::clamp(area.y, 0, std::max(0, image.rows - area.height));
    cv::rectangle(image, area, plate, cv::FILLED);
    const double luminance = 0.114 * plate[0] + 0.587 * plate[1] + 0.299 * plate[2];
    cv::putText(image, text, {area.x + margin, area.br().y - margin}, font, size, luminance > 120 ? black : white,
                thickness, cv::LINE_AA);
}

void draw_particles(cv::Mat &image, const DrawnTrack &track) {
    const cv::Scalar colour = identity_colour(track.id);
    for (const cv::Rect2d &box : track.particles) {
        solid_box(image, box, colour, 1);
        cv::circle(image, fixed_point((box.tl() + box.br()) / 2), 2 << shift, colour, cv::FILLED, cv::LINE_AA, shift);
    }
}

void draw_trail(cv::Mat &image, const std::deque<cv::Point2d> &trail, const cv::Scalar &colour, double scale) {
    const int thickness = static_cast<int>(std::lround(2 * scale));
    for (std::size_t i = 1; i < trail.size(); ++i) line(image, trail[i - 1], trail[i], colour, thickness);
}

void draw_box(cv::Mat &image, const DrawnTrack &track, double scale) {
    const int thin = static_cast<int>(std::lround(scale)), bold = 2 * thin;
    const int thickness = track.matched ? bold : thin;
    switch (track.look) {
        case Look::strong: return solid_box(image, track.box, green, thickness);
        case Look::weak: return solid_box(image, track.box, red, thickness);
        case Look::lost: return dashed_box(image, track.box, red, bold, 7 * scale);
        case Look::tentative: return solid_box(image, track.box, grey, thin);
    }
}

void draw_caption(cv::Mat &image, const std::string &caption, double scale) {
    label(image, caption, {0, 0}, black, 0.5 * scale);
    int x = 0;
    const std::pair<const char *, cv::Scalar> entries[] = {
        {"strong: detected", green}, {"weak: predicted", red}, {"dashed: lost", red}};
    for (const auto &[text, colour] : entries) {
        label(image, text, {x, image.rows}, colour, 0.4 * scale);
        int baseline = 0;
        x += cv::getTextSize(text, font, 0.4 * scale, 1, &baseline).width + static_cast<int>(12 * scale);
    }
}

}  // namespace

cv::Scalar identity_colour(std::uint64_t id) {
    // Golden-angle steps around the colour circle keep neighbouring ids far apart.
    const double hue = std::fmod(static_cast<double>(id % 997) * 0.61803398875, 1.0) * 6.0;
    const double value = id % 2 ? 255.0 : 215.0, low = 60.0;
    const auto channel = [&](double offset) {
        const double k = std::fmod(hue + offset, 6.0);
        return value - (value - low) * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    };
    return {channel(1.0), channel(3.0), channel(5.0)};
}

void Annotator::draw(cv::Mat &image, const std::string &caption, const std::vector<DrawnTrack> &tracks,
                     const std::optional<Affine> &motion) {
    remember(tracks, motion);
    const double scale = scale_of(image);
    for (const DrawnTrack &track : tracks) {
        if (track.look != Look::tentative) draw_trail(image, trails_[track.id], identity_colour(track.id), scale);
    }
    for (const DrawnTrack &track : tracks) draw_particles(image, track);
    for (const DrawnTrack &track : tracks) draw_box(image, track, scale);
    // Labels last, so that no box crosses them out.
    for (const DrawnTrack &track : tracks) {
        if (track.look == Look::tentative) continue;
        const cv::Rect2d inside = track.box & cv::Rect2d(0, 0, image.cols, image.rows);
        if (inside.area() <= 0) continue;
        const cv::Point corner(static_cast<int>(std::lround(track.box.x)), static_cast<int>(std::lround(track.box.y)));
        label(image, std::to_string(track.id), corner, identity_colour(track.id), 0.5 * scale);
    }
    draw_caption(image, caption, scale);
}

void Annotator::remember(const std::vector<DrawnTrack> &tracks, const std::optional<Affine> &motion) {
    std::map<std::uint64_t, std::deque<cv::Point2d>> next;
    for (const DrawnTrack &track : tracks) {
        auto &trail = next[track.id] = std::move(trails_[track.id]);
        if (motion) {
            const Affine &m = *motion;
            for (cv::Point2d &p : trail) p = {m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]};
        }
        // Where the feet are: trails then lie on the ground and tell crossing people apart.
        trail.emplace_back(track.box.x + track.box.width / 2, track.box.y + track.box.height);
        if (trail.size() > trail_length) trail.pop_front();
    }
    trails_ = std::move(next);
}

}  // namespace examples
