#include "mot_io.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

#include "mot_rows.hpp"
#include "text.hpp"

namespace examples {
namespace {

struct ParsedRow {
    long frame;
    DetectionRow detection;
};

/// The class id in a row's eighth field.
int class_of(const MotRow &row) {
    const auto id = row.fields.size() > 7 ? parse_integer(row.fields[7]) : std::nullopt;
    if (!id || *id < 0 || *id > std::numeric_limits<int>::max()) {
        row.refuse("--class-names needs a class id from 0 in the eighth field");
    }
    return static_cast<int>(*id);
}

std::vector<ParsedRow> parse_detections(const std::string &path, const DetectionOptions &options) {
    std::vector<ParsedRow> rows;
    for_each_row(path, {"frame", "id", "left", "top", "width", "height", "score"}, [&](const MotRow &row) {
        const double score = row.number(6, "score");
        if (!options.normalise_scores && (score < 0 || score > 1)) {
            row.refuse("score " + quoted(row.fields[6]) + " is outside 0..1 (--normalise-scores squashes any range)");
        }
        const int class_id = options.classes ? class_of(row) : 0;
        rows.push_back({row.frame, {row.left, row.top, row.width, row.height, score, class_id}});
    });
    return rows;
}

/// Squashes scores of any range into (0, 1): 1 / (1 + exp(-score / their root mean square)).
void normalise_scores(std::vector<ParsedRow> &rows) {
    double squares = 0.0;
    for (const ParsedRow &row : rows) squares += row.detection.score * row.detection.score;
    const double scale = squares > 0 ? std::sqrt(squares / static_cast<double>(rows.size())) : 1.0;
    for (ParsedRow &row : rows) row.detection.score = 1.0 / (1.0 + std::exp(-row.detection.score / scale));
}

float little_endian_float(const char *bytes) {
    std::uint32_t bits = 0;
    for (int i = 3; i >= 0; --i) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

}  // namespace

DetectionFile read_detections(const std::string &path, const DetectionOptions &options) {
    std::vector<ParsedRow> rows = parse_detections(path, options);
    if (options.normalise_scores) normalise_scores(rows);
    const bool with_embeddings = !options.embeddings.empty();
    const std::string raw = with_embeddings ? read_file(options.embeddings) : std::string();
    const std::size_t row_bytes = static_cast<std::size_t>(options.dimension) * 4;
    if (with_embeddings && raw.size() != rows.size() * row_bytes) {
        throw UserError(options.embeddings + ": holds " + std::to_string(raw.size()) + " bytes, but " +
                        std::to_string(rows.size()) + " rows of " + path + " times --dim " +
                        std::to_string(options.dimension) + " times 4 bytes are " +
                        std::to_string(rows.size() * row_bytes));
    }
    DetectionFile file;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        file.last_frame = std::max(file.last_frame, rows[i].frame);
        if (!options.filter.passes(rows[i].detection)) continue;
        FrameRows &frame = file.frames[rows[i].frame];
        frame.detections.push_back(rows[i].detection);
        for (int k = 0; with_embeddings && k < options.dimension; ++k) {
            frame.embeddings.push_back(little_endian_float(raw.data() + i * row_bytes + k * 4));
        }
    }
    return file;
}

std::vector<Affine> read_camera_motion(const std::string &path) {
    const std::string text = read_file(path);
    std::vector<Affine> motions;
    long first = 0;
    for_each_line(text, [&](long number, std::string_view line) {
        const auto fields = split_blanks(line);
        if (fields.size() != 7) {
            refuse_line(path, number,
                        "expected a frame number and 6 numbers of a 2x3 matrix, found " +
                            std::to_string(fields.size()) + " fields");
        }
        double values[7];
        for (std::size_t i = 0; i < 7; ++i) {
            const auto value = parse_number(fields[i]);
            if (!value) refuse_line(path, number, quoted(fields[i]) + " is not a finite number");
            values[i] = *value;
        }
        // A line per frame, counted from 0 or 1: a gap would shift all that follow.
        if (motions.empty() && values[0] == 1) first = 1;
        const long expected = first + static_cast<long>(motions.size());
        if (values[0] != static_cast<double>(expected)) {
            refuse_line(path, number,
                        "frame " + quoted(fields[0]) + " where " + std::to_string(expected) + " is expected");
        }
        Affine motion{};
        std::copy(values + 1, values + 7, motion.begin());
        motions.push_back(motion);
    });
    return motions;
}

RowWriter::RowWriter(const std::string &path) : path_(path == "-" ? "stdout" : path), file_(stdout) {
    if (path == "-") return;
    file_ = std::fopen(path.c_str(), "w");
    if (!file_) throw UserError(path + ": cannot be written: " + std::strerror(errno));
}

RowWriter::~RowWriter() {
    if (file_ && file_ != stdout) std::fclose(file_);
}

void RowWriter::write_tracks(long frame, std::vector<TrackRow> rows) {
    std::sort(rows.begin(), rows.end(), [](const TrackRow &a, const TrackRow &b) { return a.id < b.id; });
    for (const TrackRow &r : rows) {
        std::fprintf(file_, "%ld,%llu,%.6f,%.6f,%.6f,%.6f,%.6f,-1,-1,-1\n", frame,
                     static_cast<unsigned long long>(r.id), r.left, r.top, r.width, r.height, r.score);
    }
}

void RowWriter::write_detections(long frame, const std::vector<DetectionRow> &rows) {
    for (const DetectionRow &r : rows) {
        std::fprintf(file_, "%ld,-1,%.6f,%.6f,%.6f,%.6f,%.6f,-1,-1,-1\n", frame, r.left, r.top, r.width, r.height,
                     r.score);
    }
}

void RowWriter::close() {
    if (!file_) return;
    bool failed = std::fflush(file_) != 0 || std::ferror(file_) != 0;
    if (file_ != stdout) failed = std::fclose(file_) != 0 || failed;
    file_ = nullptr;
    if (failed) throw UserError(path_ + ": cannot be written: " + std::strerror(errno));
}

}  // namespace examples
