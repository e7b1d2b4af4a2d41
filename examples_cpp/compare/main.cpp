// compare: two trackers side by side on one video; `compare --help` is its manual.

#include <array>
#include <cstdio>
#include <opencv2/core.hpp>
#include <optional>

#include "canvas.hpp"
#include "ground_truth.hpp"
#include "inputs.hpp"
#include "options.hpp"
#include "pictures.hpp"
#include "program.hpp"
#include "progress.hpp"
#include "side.hpp"

namespace {

using compare::Options;
using compare::Side;

/// The two pictures with a line between.
cv::Mat beside(const cv::Mat &left, const cv::Mat &right) {
    constexpr int gap = 4;
    cv::Mat both(left.rows, left.cols + gap + right.cols, CV_8UC3, cv::Scalar::all(255));
    left.copyTo(both.colRange(0, left.cols));
    right.copyTo(both.colRange(left.cols + gap, both.cols));
    return both;
}

void run(const Options &o) {
    examples::Inputs inputs(o.input);
    const auto side = [&](int k) {
        return Side(o.trackers[k], inputs.frame_rate(), o.input.video, o.fps, o.drawing, !o.input.has_images());
    };
    std::array<Side, 2> sides = {side(0), side(1)};
    examples::GroundTruth truth;
    if (!o.truth.empty()) {
        truth = examples::read_ground_truth(o.truth);
        for (Side &tracker : sides) tracker.mark_switches();
    }
    const cv::Size plain_size = inputs.plain_size();
    const long expected = inputs.expected_frames();
    examples::VideoFile video(o.out, sides[0].frame_rate());
    std::optional<examples::ContactSheet> sheet;
    if (!o.sheet.empty()) {
        const auto frames = o.sheet_frames.empty() ? examples::ContactSheet::spread_over(expected) : o.sheet_frames;
        sheet.emplace(o.sheet, frames, 2, 1280);
    }

    examples::Progress progress(expected);
    for (examples::FrameInput input; inputs.next(input);) {
        progress.at(input.frame);
        const auto half = [&](Side &tracker) {
            return tracker.step(input, examples::canvas_for(input, plain_size), truth[input.frame]);
        };
        const cv::Mat left = half(sides[0]);
        const cv::Mat both = beside(left, half(sides[1]));
        video.add(both);
        if (sheet) sheet->add(input.frame, both);
    }
    progress.clear();
    inputs.check_end();
    if (sheet) sheet->write();
    if (o.input.estimate_camera_motion) std::fprintf(stderr, "%s\n", inputs.camera_summary().c_str());
    for (const Side &tracker : sides) std::printf("%s\n", tracker.summary().c_str());
}

}  // namespace

int main(int argc, char **argv) {
    return examples::run_program("compare", argc, argv, [](const std::vector<std::string> &arguments) {
        const Options options = compare::parse_options(arguments);
        if (options.help) {
            std::fputs(compare::usage().c_str(), stdout);
        } else {
            run(options);
        }
    });
}
