#include "mot_io.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

#include "text.hpp"

namespace examples {
namespace {

/// The library's limits, asked for here to be able to name the line.
constexpr double max_coordinate = 1e12;
constexpr double min_zoom = 1e-3, max_zoom = 1e3, min_determinant = 1e-6;
/// Scores of any range are going to be squared.
constexpr double max_score = 1e12;

struct ParsedRow {
    long frame;
    DetectionRow detection;
    /// In the file, from 1.
    long line;
};

/// The class id in a row's eighth field.
int class_of(const MotRow &row) {
    const auto id = row.fields.size() > 7 ? parse_integer(row.fields[7]) : std::nullopt;
    if (!id || *id < 0 || *id > std::numeric_limits<int>::max()) {
        row.refuse("--class-names needs a class id from 0 in the eighth field");
    }
    return static_cast<int>(*id);
}

std::vector<ParsedRow> parse_rows(const NamedText &file, const DetectionOptions &options) {
    std::vector<ParsedRow> rows;
    for_each_row(file, {"frame", "id", "left", "top", "width", "height", "score"}, [&](const MotRow &row) {
        const double score = row.number(6, "score");
        if (!options.normalise_scores && (score < 0 || score > 1)) {
            row.refuse("score " + quoted(row.fields[6]) + " is outside 0..1 (--normalise-scores squashes any range)");
        }
        if (std::abs(score) > max_score) row.refuse("score " + quoted(row.fields[6]) + " is beyond 1e12");
        const int class_id = options.classes ? class_of(row) : 0;
        rows.push_back({row.frame, {row.left, row.top, row.width, row.height, score, class_id}, row.line});
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

/// Why no tracker takes a camera motion, if it does not.
std::optional<std::string> fault_of(const Affine &m) {
    for (const double x : m) {
        if (std::abs(x) > max_coordinate) return "a number of the matrix is beyond 1e12";
    }
    const auto is_zoom = [](double k) { return k >= min_zoom && k <= max_zoom; };
    if (!is_zoom(std::sqrt(m[0] * m[0] + m[3] * m[3])) || !is_zoom(std::sqrt(m[1] * m[1] + m[4] * m[4]))) {
        return "the matrix scales by less than 0.001 or more than 1000";
    }
    if (std::abs(m[0] * m[4] - m[1] * m[3]) < min_determinant) return "the matrix cannot be inverted";
    return std::nullopt;
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
    const std::string rows = read_file(path);
    const std::string embeddings = options.embeddings.empty() ? std::string() : read_file(options.embeddings);
    return parse_detections({path, rows}, {options.embeddings, embeddings}, options);
}

DetectionFile parse_detections(const NamedText &detections, const NamedText &embeddings,
                               const DetectionOptions &options) {
    std::vector<ParsedRow> rows = parse_rows(detections, options);
    if (options.normalise_scores) normalise_scores(rows);
    const bool with_embeddings = !options.embeddings.empty();
    const std::string_view raw = embeddings.text;
    const std::size_t row_bytes = static_cast<std::size_t>(options.dimension) * 4;
    if (with_embeddings && raw.size() != rows.size() * row_bytes) {
        throw UserError(embeddings.name + ": holds " + std::to_string(raw.size()) + " bytes, but " +
                        std::to_string(rows.size()) + " rows of " + detections.name + " times --dim " +
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
            const float number = little_endian_float(raw.data() + i * row_bytes + k * 4);
            if (!std::isfinite(number)) {
                throw UserError(embeddings.name + ": number " + std::to_string(k + 1) + " of row " +
                                std::to_string(i + 1) + ", of " + detections.name + ":" +
                                std::to_string(rows[i].line) + ", is not finite");
            }
            frame.embeddings.push_back(number);
        }
    }
    return file;
}

std::vector<Affine> read_camera_motion(const std::string &path) {
    const std::string text = read_file(path);
    return parse_camera_motion({path, text});
}

std::vector<Affine> parse_camera_motion(const NamedText &file) {
    std::vector<Affine> motions;
    long first = 0;
    for_each_line(file.text, [&](long number, std::string_view line) {
        const auto fields = split_blanks(line);
        if (fields.size() != 7) {
            refuse_line(file.name, number,
                        "expected a frame number and 6 numbers of a 2x3 matrix, found " +
                            std::to_string(fields.size()) + " fields");
        }
        double values[7];
        for (std::size_t i = 0; i < 7; ++i) {
            const auto value = parse_number(fields[i]);
            if (!value) refuse_line(file.name, number, quoted(fields[i]) + " is not a finite number");
            values[i] = *value;
        }
        // A line per frame, counted from 0 or 1: a gap would shift all that follow.
        if (motions.empty() && values[0] == 1) first = 1;
        const long expected = first + static_cast<long>(motions.size());
        if (values[0] != static_cast<double>(expected)) {
            refuse_line(file.name, number,
                        "frame " + quoted(fields[0]) + " where " + std::to_string(expected) + " is expected");
        }
        Affine motion{};
        std::copy(values + 1, values + 7, motion.begin());
        if (const auto reason = fault_of(motion)) refuse_line(file.name, number, *reason);
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
