#include "arguments.hpp"

#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "gentrack2.h"
#include "text.hpp"

namespace examples {

bool ArgumentReader::next() {
    if (at_ >= arguments_.size()) return false;
    option_ = arguments_[at_++];
    return true;
}

const std::string &ArgumentReader::value() {
    if (at_ >= arguments_.size()) throw UserError(option_ + " needs a value");
    return arguments_[at_++];
}

void ArgumentReader::refuse(const std::string &value, const std::string &expected) const {
    throw UserError(option_ + " " + value + ": expected " + expected);
}

double ArgumentReader::number(double low, double high, const std::string &expected) {
    const std::string text = value();
    const auto number = parse_number(text);
    if (!number || *number < low || *number > high) refuse(text, expected);
    return *number;
}

long ArgumentReader::integer(long low, long high) {
    const std::string text = value();
    const auto number = parse_integer(text);
    if (!number || *number < low || *number > high) {
        refuse(text, "an integer in " + std::to_string(low) + ".." + std::to_string(high));
    }
    return static_cast<long>(*number);
}

cv::Size ArgumentReader::size() {
    const std::string text = value();
    const auto cross = text.find('x');
    const auto width = parse_integer(std::string_view(text).substr(0, cross));
    const auto height = cross == std::string::npos ? std::nullopt : parse_integer(text.substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > 65535 || *height > 65535) {
        refuse(text, "WIDTHxHEIGHT in pixels, such as 1920x1080");
    }
    return {static_cast<int>(*width), static_cast<int>(*height)};
}

std::vector<long> ArgumentReader::frame_list() {
    const std::string text = value();
    std::vector<long> frames;
    for (const auto field : split_commas(text)) {
        const auto frame = parse_integer(field);
        if (!frame || *frame < 1 || *frame > max_frame) refuse(text, "frame numbers with commas between");
        frames.push_back(static_cast<long>(*frame));
    }
    return frames;
}

std::pair<std::string, std::string> ArgumentReader::setting() {
    const std::string text = value();
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) refuse(text, "KEY=VALUE");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

OptionTable input_options(ArgumentReader &r, InputOptions &o) {
    return {
        {"--det", [&] { o.det = r.value(); }},
        {"--detector", [&] { o.detector = r.value(); }},
        {"--video", [&] { o.video = r.value(); }},
        {"--images", [&] { o.images = r.value(); }},
        {"--estimate-camera-motion", [&] { o.estimate_camera_motion = true; }},
        {"--min-score", [&] { o.filter.min_score = r.number(0, 1, "a number in 0..1"); }},
        {"--max-height", [&] { o.filter.max_height = r.number(0, 1e6, "a number of pixels"); }},
        {"--normalise-scores", [&] { o.normalise_scores = true; }},
        {"--frames", [&] { o.frames = r.integer(1, max_frame); }},
    };
}

bool read_arguments(ArgumentReader &r, const OptionTable &table) {
    while (r.next()) {
        if (r.option() == "--help" || r.option() == "-h") return true;
        const auto reader = table.find(r.option());
        if (reader == table.end()) throw UserError("unknown option " + r.option() + " (--help lists the options)");
        reader->second();
    }
    return false;
}

void check_inputs(const InputOptions &o) {
    if (o.det.empty() == o.detector.empty()) throw UserError("give either --det or --detector");
    if (!o.video.empty() && !o.images.empty()) throw UserError("--video and --images exclude each other");
    if (!o.detector.empty() && !o.has_images()) throw UserError("--detector needs --video or --images");
    if (o.estimate_camera_motion && !o.has_images()) {
        throw UserError("--estimate-camera-motion needs --video or --images");
    }
    if (o.estimate_camera_motion && !o.gmc.empty()) {
        throw UserError("--estimate-camera-motion and --gmc exclude each other");
    }
    if (!o.embeddings.empty() && o.det.empty()) throw UserError("--embeddings needs --det");
    if (o.embeddings.empty() != (o.dimension == 0)) throw UserError("--embeddings and --dim need each other");
    if (o.normalise_scores && o.det.empty()) throw UserError("--normalise-scores needs --det");
    if (o.has_images() && o.size) throw UserError("--size is for runs without --video and --images");
}

void check_not_overwritten(const InputOptions &o, const std::vector<std::string> &also_read,
                           const std::vector<std::string> &written) {
    std::vector<std::string> read = {o.det, o.video, o.gmc, o.embeddings};
    read.insert(read.end(), also_read.begin(), also_read.end());
    for (const std::string &in : read) {
        for (const std::string &out : written) {
            std::error_code absent;
            if (!in.empty() && std::filesystem::equivalent(in, out, absent)) {
                throw UserError(out + ": would overwrite what is read from it");
            }
        }
    }
}

std::string tracker_names() {
    std::string names;
    for (std::size_t i = 0; i < gt2_algorithm_count(); ++i) {
        names += (i ? " " : "") + std::string(gt2_algorithm_name(i));
    }
    return names;
}

}  // namespace examples
