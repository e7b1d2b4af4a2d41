#include "options.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <string_view>
#include <system_error>

#include <gentrack2.h>

#include "mot_io.hpp"
#include "text.hpp"

namespace gt2_mot {

namespace {

const char *const manual =
    R"(usage: gt2_mot --tracker NAME (--det FILE | --detector hog | --detector onnx:FILE) --out FILE [options]

Tracks the objects of a video or of a file of detections and writes MOTChallenge rows.

  --tracker NAME       @NAMES@
  --det FILE           detections: frame,id,left,top,width,height,score,... with frames from 1 and scores in 0..1
  --detector hog       find people with OpenCV's HOG detector
  --detector onnx:FILE find people with a YOLOX-style model
  --out FILE           tracks: frame,id,left,top,width,height,score,-1,-1,-1; "-" is stdout

  --video FILE         frames for detector, appearance and drawing
  --images DIR         the same from the image files of a directory, in the order of their names
  --gmc FILE           camera motion, a line per frame: frame, then 2x3 affine row-major, previous -> current
  --embeddings FILE    raw little-endian f32, one row per row of --det; needs --dim
  --dim N              numbers per embedding
  --min-score S        drop detections below S before the tracker sees them
  --max-height H       drop detections taller than H pixels, where nobody can be so near
  --normalise-scores   first squash the scores of --det, of any range, by 1 / (1 + exp(-score / s)), s being their
                       root mean square
  --size WxH           size of the frames in pixels, where there are none to look at
  --fps F              frames per second; by default that of --video, else the tracker's default
  --frames N           number of frames to step; by default all of --video or --images, else up to the last
                       frame of --det or --gmc
  --seed N             seed of the tracker's random numbers
  --config FILE        TOML file of parameters
  --set KEY=VALUE      a parameter; may be given again

  --annotate FILE      write an annotated video (.mp4, .avi)
  --sheet FILE         write a picture of six annotated frames
  --sheet-frames A,B,..  which six; by default they are spread over the run
  --particles          draw the trackers' particles
  --all-states         also write tentative and lost tracks
  --save-det FILE      write the detections that the tracker was given
  --time               print the time of the tracker alone to stderr
  --help               print this

Settings are applied in this order, later ones win: frame rate of the video, --config, --set, --seed, --fps.
)";

}  // namespace

std::string usage() {
    static constexpr std::string_view placeholder = "@NAMES@";
    std::string names, text = manual;
    for (std::size_t i = 0; i < gt2_algorithm_count(); ++i) names += (i ? " " : "") + std::string(gt2_algorithm_name(i));
    return text.replace(text.find(placeholder), placeholder.size(), names);
}


namespace {

/// The arguments, and which option is being read.
class Reader {
public:
    explicit Reader(const std::vector<std::string> &arguments) : arguments_(arguments) {}

    bool next() {
        if (at_ >= arguments_.size()) return false;
        option_ = arguments_[at_++];
        return true;
    }

    const std::string &option() const { return option_; }

    const std::string &value() {
        if (at_ >= arguments_.size()) throw UserError(option_ + " needs a value");
        return arguments_[at_++];
    }

    [[noreturn]] void refuse(const std::string &value, const std::string &expected) const {
        throw UserError(option_ + " " + value + ": expected " + expected);
    }

    double number(double low, double high, const std::string &expected) {
        const std::string text = value();
        const auto number = parse_number(text);
        if (!number || *number < low || *number > high) refuse(text, expected);
        return *number;
    }

    long integer(long low, long high) {
        const std::string text = value();
        const auto number = parse_integer(text);
        if (!number || *number < low || *number > high) {
            refuse(text, "an integer in " + std::to_string(low) + ".." + std::to_string(high));
        }
        return static_cast<long>(*number);
    }

    cv::Size size() {
        const std::string text = value();
        const auto cross = text.find('x');
        const auto width = parse_integer(std::string_view(text).substr(0, cross));
        const auto height = cross == std::string::npos ? std::nullopt : parse_integer(text.substr(cross + 1));
        if (!width || !height || *width < 1 || *height < 1 || *width > 65535 || *height > 65535) {
            refuse(text, "WIDTHxHEIGHT in pixels, such as 1920x1080");
        }
        return {static_cast<int>(*width), static_cast<int>(*height)};
    }

    std::vector<long> frame_list() {
        const std::string text = value();
        std::vector<long> frames;
        for (const auto field : split_commas(text)) {
            const auto frame = parse_integer(field);
            if (!frame || *frame < 1 || *frame > max_frame) refuse(text, "frame numbers with commas between");
            frames.push_back(static_cast<long>(*frame));
        }
        return frames;
    }

    std::pair<std::string, std::string> setting() {
        const std::string text = value();
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) refuse(text, "KEY=VALUE");
        return {text.substr(0, equals), text.substr(equals + 1)};
    }

private:
    const std::vector<std::string> &arguments_;
    std::size_t at_ = 0;
    std::string option_;
};

void check_together(const Options &o) {
    if (o.tracker.empty()) throw UserError("--tracker is missing (--help lists the options)");
    if (o.det.empty() == o.detector.empty()) throw UserError("give either --det or --detector");
    if (o.out.empty()) throw UserError("--out is missing");
    const bool has_images = !o.video.empty() || !o.images.empty();
    if (!o.video.empty() && !o.images.empty()) throw UserError("--video and --images exclude each other");
    if (!o.detector.empty() && !has_images) throw UserError("--detector needs --video or --images");
    if (!o.embeddings.empty() && o.det.empty()) throw UserError("--embeddings needs --det");
    if (o.embeddings.empty() != (o.dimension == 0)) throw UserError("--embeddings and --dim need each other");
    if (o.normalise_scores && o.det.empty()) throw UserError("--normalise-scores needs --det");
    if (has_images && o.size) throw UserError("--size is for runs without --video and --images");
    const bool draws = !o.annotate.empty() || !o.sheet.empty();
    if (draws && !has_images && !o.size) throw UserError("drawing needs --video, --images or --size");
    for (const std::string *in : {&o.det, &o.video, &o.gmc, &o.embeddings, &o.config}) {
        for (const std::string *out : {&o.out, &o.save_det, &o.annotate, &o.sheet}) {
            std::error_code absent;
            if (!in->empty() && std::filesystem::equivalent(*in, *out, absent)) {
                throw UserError(*out + ": would overwrite what is read from it");
            }
        }
    }
    if (o.particles && !draws) throw UserError("--particles needs --annotate or --sheet");
    if (!o.sheet_frames.empty() && o.sheet.empty()) throw UserError("--sheet-frames needs --sheet");
}

}  // namespace

Options parse_options(const std::vector<std::string> &arguments) {
    Options o;
    Reader r(arguments);
    const std::map<std::string, std::function<void()>> readers = {
        {"--help", [&] { o.help = true; }},
        {"-h", [&] { o.help = true; }},
        {"--tracker", [&] { o.tracker = r.value(); }},
        {"--det", [&] { o.det = r.value(); }},
        {"--detector", [&] { o.detector = r.value(); }},
        {"--out", [&] { o.out = r.value(); }},
        {"--video", [&] { o.video = r.value(); }},
        {"--images", [&] { o.images = r.value(); }},
        {"--gmc", [&] { o.gmc = r.value(); }},
        {"--embeddings", [&] { o.embeddings = r.value(); }},
        {"--dim", [&] { o.dimension = static_cast<int>(r.integer(1, 16384)); }},
        {"--min-score", [&] { o.min_score = r.number(0, 1, "a number in 0..1"); }},
        {"--max-height", [&] { o.max_height = r.number(0, 1e6, "a number of pixels"); }},
        {"--normalise-scores", [&] { o.normalise_scores = true; }},
        {"--size", [&] { o.size = r.size(); }},
        {"--fps", [&] { o.fps = r.number(0, 1e6, "a number of frames per second"); }},
        {"--frames", [&] { o.frames = r.integer(1, max_frame); }},
        {"--seed", [&] { o.seed = r.value(); }},
        {"--config", [&] { o.config = r.value(); }},
        {"--set", [&] { o.set.push_back(r.setting()); }},
        {"--annotate", [&] { o.annotate = r.value(); }},
        {"--sheet", [&] { o.sheet = r.value(); }},
        {"--sheet-frames", [&] { o.sheet_frames = r.frame_list(); }},
        {"--particles", [&] { o.particles = true; }},
        {"--all-states", [&] { o.all_states = true; }},
        {"--save-det", [&] { o.save_det = r.value(); }},
        {"--time", [&] { o.time = true; }},
    };
    while (r.next()) {
        const auto reader = readers.find(r.option());
        if (reader == readers.end()) throw UserError("unknown option " + r.option() + " (--help lists the options)");
        reader->second();
        if (o.help) return o;
    }
    check_together(o);
    return o;
}

}  // namespace gt2_mot
