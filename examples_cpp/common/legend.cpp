#include "legend.hpp"

#include <algorithm>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "palette.hpp"

namespace examples {
namespace {

/// A text and the sample beside it, drawn between two points.
struct Entry {
    std::string text;
    std::function<void(cv::Mat &, const cv::Point2d &, const cv::Point2d &, double)> sample;
};

Entry box_entry(const std::string &text, Look look) {
    return {text, [look](cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, double scale) {
                DrawnTrack track;
                track.look = look;
                draw_line(image, from, to, pen_of(track, scale));
            }};
}

std::vector<Entry> entries(bool particles, bool neighbours) {
    std::vector<Entry> all = {box_entry("strong: detected", Look::strong), box_entry("weak: predicted", Look::weak),
                              box_entry("lost: kept", Look::lost)};
    if (particles) {
        all.push_back({"particles", [](cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, double scale) {
                           draw_dot(image, (from + to) / 2, 2 * scale, palette::white);
                       }});
    }
    if (!neighbours) return all;
    all.push_back({"neighbours", [](cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, double scale) {
                       draw_line(image, from, to, {palette::neighbours, scale});
                       draw_dot(image, to, 3 * scale, palette::neighbours);
                   }});
    all.push_back({"their motion in 1 s",
                   [](cv::Mat &image, const cv::Point2d &from, const cv::Point2d &to, double scale) {
                       draw_arrow(image, from, to, {palette::motion, 3 * scale});
                   }});
    return all;
}

constexpr double text_size = 0.4, sample_width = 26, gap = 8;

double width_of(const Entry &entry, double scale) {
    return plate_size(entry.text, text_size * scale).width + (sample_width + gap) * scale;
}

/// As many entries in each row as have room there.
std::vector<std::vector<Entry>> rows_of(const std::vector<Entry> &all, double scale, int room) {
    std::vector<std::vector<Entry>> rows(1);
    double width = gap * scale;
    for (const Entry &entry : all) {
        if (!rows.back().empty() && width + width_of(entry, scale) > room) {
            rows.emplace_back();
            width = gap * scale;
        }
        rows.back().push_back(entry);
        width += width_of(entry, scale);
    }
    return rows;
}

void draw_row(cv::Mat &image, const std::vector<Entry> &row, double bottom, double scale) {
    const int height = plate_size("l", text_size * scale).height;
    double width = gap * scale;
    for (const Entry &entry : row) width += width_of(entry, scale);
    tint_box(image, {0, bottom - height, width, static_cast<double>(height)}, palette::black, 0.75);
    double x = gap * scale;
    for (const Entry &entry : row) {
        const double middle = bottom - height / 2.0, text_at = x + sample_width * scale;
        entry.sample(image, {x, middle}, {text_at, middle}, scale);
        const cv::Point start(cvRound(text_at + gap / 2 * scale), cvRound(bottom - height * 0.3));
        cv::putText(image, entry.text, start, cv::FONT_HERSHEY_SIMPLEX, text_size * scale, palette::white,
                    text_size * scale >= 0.9 ? 2 : 1, cv::LINE_AA);
        x += width_of(entry, scale);
    }
}

}  // namespace

Pen pen_of(const DrawnTrack &track, double scale) {
    const double bold = track.in_focus ? 2.0 : 1.0;
    switch (track.look) {
        case Look::strong: return {palette::strong, 2 * scale * bold};
        case Look::weak: return {palette::weak, 2 * scale * bold, Stroke::dashed};
        case Look::lost: return {palette::weak, 1.5 * scale * bold, Stroke::dotted};
        case Look::tentative: break;
    }
    return {palette::tentative, scale, Stroke::solid, false};
}

void draw_legend(cv::Mat &image, bool particles, bool neighbours) {
    const auto all = entries(particles, neighbours);
    double scale = scale_of(image);
    for (const Entry &e : all) scale *= std::min(1.0, image.cols / (width_of(e, scale) + gap * scale));
    const auto rows = rows_of(all, scale, image.cols);
    const int height = plate_size("l", text_size * scale).height;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        draw_row(image, rows[i], image.rows - height * static_cast<double>(rows.size() - 1 - i), scale);
    }
}

}  // namespace examples
