#include "drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gentrack2.h"
#include "ground_truth.hpp"
#include "mot_io.hpp"
#include "text.hpp"

namespace mot_reader {
namespace {

using namespace examples;

constexpr char separator = '\x1e';
/// Frames that are handed to a tracker, and rows of which the text is written and read again: the rest is more of the
/// same.
constexpr std::size_t most_frames = 20, most_rows = 50;

void require(bool holds, const char *promise, const std::string &of) {
    if (holds) return;
    std::fprintf(stderr, "broken promise: %s: %s\n", promise, of.c_str());
    std::abort();
}

std::array<std::string_view, 4> split(std::string_view all) {
    std::array<std::string_view, 4> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto end = i + 1 < parts.size() ? all.find(separator) : std::string_view::npos;
        parts[i] = all.substr(0, end);
        if (end == std::string_view::npos) break;
        all.remove_prefix(end + 1);
    }
    return parts;
}

DetectionOptions options_of(std::string_view letters) {
    DetectionOptions options;
    options.dimension = 1;
    for (const char c : letters) {
        if (c == 'n') options.normalise_scores = true;
        if (c == 's') options.filter.min_score = 0.5;
        if (c == 'h') options.filter.max_height = 100;
        if (c == 'c') options.classes = true;
        if (c == 'e') options.embeddings = "seed.f32";
        if (c >= '1' && c <= '9') options.dimension = c - '0';
    }
    return options;
}

std::size_t count_lines(std::string_view text, bool blank_ones_too) {
    // A byte order mark at the beginning is no part of the first line.
    if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
    std::size_t lines = 0;
    for (std::size_t from = 0; from < text.size();) {
        const auto end = std::min(text.find('\n', from), text.size());
        lines += blank_ones_too || !trimmed(text.substr(from, end - from)).empty();
        from = end + 1;
    }
    return lines;
}

/// A refusal is one line that names the file, and the line if it is about one.
void check_refusal(const std::string &message, const NamedText &file, bool names_a_line) {
    require(message.size() < 300, "messages are short", message);
    require(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }),
            "messages are one printable line", message);
    require(message.rfind(file.name + ":", 0) == 0, "messages name the file", message);
    if (!names_a_line) return;
    const char *number = message.c_str() + file.name.size() + 1;
    char *end = nullptr;
    const long line = std::strtol(number, &end, 10);
    require(end != number && *end == ':' && line >= 1 &&
                static_cast<std::size_t>(line) <= count_lines(file.text, true),
            "messages name a line of the file", message);
}

std::array<double, 5> numbers_of(const DetectionRow &row) {
    return {row.left, row.top, row.width, row.height, row.score};
}

/// To the last bit.
bool same(const DetectionRow &a, const DetectionRow &b) {
    const auto x = numbers_of(a), y = numbers_of(b);
    return std::memcmp(x.data(), y.data(), sizeof x) == 0 && a.class_id == b.class_id;
}

/// What was read, written with all digits, reads as the same.
void check_round_trip(const DetectionFile &file) {
    std::string text;
    std::vector<DetectionRow> rows;
    for (const auto &[frame, of_frame] : file.frames) {
        for (const DetectionRow &row : of_frame.detections) {
            if (rows.size() == most_rows) break;
            rows.push_back(row);
            text += std::to_string(frame) + ",-1";
            for (const double number : numbers_of(row)) text += "," + text_of(number);
            text += "," + std::to_string(row.class_id) + "\n";
        }
    }
    DetectionOptions with_classes;
    with_classes.classes = true;
    const DetectionFile again = parse_detections({"again", text}, {}, with_classes);
    std::vector<DetectionRow> read;
    for (const auto &entry : again.frames) {
        read.insert(read.end(), entry.second.detections.begin(), entry.second.detections.end());
    }
    require(std::equal(rows.begin(), rows.end(), read.begin(), read.end(), same), "what is written is read", text);
}

void check_detections(const DetectionFile &file, const NamedText &source, const DetectionOptions &options) {
    std::size_t rows = 0;
    for (const auto &[frame, of_frame] : file.frames) {
        require(frame >= 1 && frame <= file.last_frame && file.last_frame <= max_frame, "frames are in range",
                source.name);
        const auto count = of_frame.detections.size();
        rows += count;
        require(of_frame.embeddings.size() ==
                    (options.embeddings.empty() ? 0 : count * static_cast<std::size_t>(options.dimension)),
                "each detection has its embedding", source.name);
        for (const DetectionRow &d : of_frame.detections) {
            require(options.filter.passes(d), "the filter is applied", source.name);
        }
    }
    const auto lines = count_lines(source.text, false);
    const bool filters = options.filter.min_score || options.filter.max_height;
    require(filters ? rows <= lines : rows == lines, "no row is lost or invented", source.name);
}

void check_truth(const GroundTruth &truth, const NamedText &source) {
    std::size_t rows = 0;
    for (const auto &[frame, boxes] : truth) {
        require(frame >= 1 && frame <= max_frame, "frames are in range", source.name);
        rows += boxes.size();
        for (const TrueBox &b : boxes) {
            require(b.box.width >= 0 && b.box.height >= 0 && std::isfinite(b.box.x + b.box.y), "boxes are boxes",
                    source.name);
            require(!(b.counts && b.distractor), "who counts is no distractor", source.name);
        }
    }
    require(rows == count_lines(source.text, false), "no row is lost or invented", source.name);
}

/// What the reader lets pass a tracker takes: a run does not end in the middle for what could have been said at its
/// start.
void check_library_takes(const DetectionFile &file, const std::vector<Affine> &motions,
                         const DetectionOptions &options) {
    gt2_config *config = nullptr;
    gt2_tracker *tracker = nullptr;
    require(gt2_config_new("sort", &config) == GT2_OK && gt2_tracker_new(config, &tracker) == GT2_OK, "a tracker",
            gt2_last_error_message());
    gt2_config_free(config);
    const auto step = [&](const FrameRows &rows, const Affine *motion) {
        std::vector<gt2_detection> detections;
        for (const DetectionRow &row : rows.detections) {
            gt2_detection d = {};
            d.left = row.left, d.top = row.top, d.width = row.width, d.height = row.height, d.score = row.score;
            detections.push_back(d);
        }
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = detections.data();
        frame.detection_count = detections.size();
        if (!rows.embeddings.empty()) {
            frame.embeddings = rows.embeddings.data();
            frame.embedding_dimension = static_cast<std::size_t>(options.dimension);
        }
        if (motion) frame.camera_motion = motion->data();
        require(gt2_tracker_step(tracker, &frame) == GT2_OK, "a tracker takes it", gt2_last_error_message());
    };
    std::size_t count = 0;
    for (const auto &entry : file.frames) {
        if (count == most_frames) break;
        step(entry.second, count < motions.size() ? &motions[count] : nullptr);
        ++count;
    }
    for (std::size_t i = 0; i < std::min(motions.size(), most_frames); ++i) step({}, &motions[i]);
    gt2_tracker_free(tracker);
}

/// Runs a reader; nothing if it refuses, which it must do in order.
template <typename Read>
auto read(Read reader, const NamedText &file, const NamedText *other = nullptr) -> std::optional<decltype(reader())> {
    try {
        return reader();
    } catch (const UserError &error) {
        const std::string message = error.what();
        const bool about_other = other && message.rfind(other->name, 0) == 0;
        check_refusal(message, about_other ? *other : file, !about_other);
        return std::nullopt;
    }
}

}  // namespace

bool run(const std::uint8_t *data, std::size_t size) {
    const auto parts = split({reinterpret_cast<const char *>(data), size});
    const DetectionOptions options = options_of(parts[0]);
    const NamedText detections{"seed.txt", parts[1]}, camera{"seed.gmc", parts[2]};
    std::string numbers(parts[3]);
    if (parts[0].find('r') != std::string_view::npos && !numbers.empty()) {
        const auto needed = count_lines(parts[1], false) * static_cast<std::size_t>(options.dimension) * 4;
        while (numbers.size() < needed) numbers += numbers;
        numbers.resize(needed);
    }
    const NamedText embeddings{"seed.f32", numbers};
    const auto file = read([&] { return parse_detections(detections, embeddings, options); }, detections, &embeddings);
    const auto motions = read([&] { return parse_camera_motion(camera); }, camera);
    if (motions) require(motions->size() == count_lines(camera.text, false), "a motion per line", camera.name);
    if (const auto truth = read([&] { return parse_ground_truth(detections); }, detections)) {
        check_truth(*truth, detections);
    }
    if (!file) return false;
    check_detections(*file, detections, options);
    check_round_trip(*file);
    check_library_takes(*file, motions.value_or(std::vector<Affine>{}), options);
    return motions.has_value();
}

}  // namespace mot_reader
