// The text and binary files around a tracking run: detections, camera motion, embeddings, and the result.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mot_rows.hpp"

namespace examples {

/// A detection: box in pixels, score in [0, 1].
struct DetectionRow {
    double left, top, width, height, score;
    int class_id = 0;
};

/// Row-major 2x3 affine map from the previous frame to this one.
using Affine = std::array<double, 6>;

/// One frame's share of a detections file.
struct FrameRows {
    std::vector<DetectionRow> detections;
    /// `dimension` numbers per detection, in their order; empty without embeddings.
    std::vector<float> embeddings;
};

/// A detections file, by frame.
struct DetectionFile {
    std::map<long, FrameRows> frames;
    long last_frame = 0;
};

/// Which detections the tracker is to see.
struct DetectionFilter {
    std::optional<double> min_score, max_height;

    bool passes(const DetectionRow &row) const {
        return !(min_score && row.score < *min_score) && !(max_height && row.height > *max_height);
    }
};

/// How to read a detections file.
struct DetectionOptions {
    /// Other rows are dropped, together with their embeddings.
    DetectionFilter filter;
    /// Squash scores of any range into (0, 1) by 1 / (1 + exp(-score / s)), s being their root mean
    /// square, before the filter is applied.
    bool normalise_scores = false;
    /// Raw little-endian f32, one row of `dimension` numbers per row of the file; empty for none.
    std::string embeddings;
    int dimension = 0;
    /// The eighth field of each row is its class id.
    bool classes = false;
};

/// Reads MOTChallenge rows `frame,id,left,top,width,height,score,...`, in any order of frames; blank lines are
/// skipped. Throws `UserError` with the line number and the reason for a bad row.
DetectionFile read_detections(const std::string &path, const DetectionOptions &options);

/// The same of files that are in memory already; `embeddings` counts only if the options name a file of them.
DetectionFile parse_detections(const NamedText &detections, const NamedText &embeddings,
                               const DetectionOptions &options);

/// Reads camera motion: line k holds a frame number and the six numbers of frame k, separated by blanks, tabs or
/// commas. The order of the lines counts, not the number: files count from 0 or from 1. Throws `UserError` with the
/// line number for a bad line, and for a motion that no tracker takes.
std::vector<Affine> read_camera_motion(const std::string &path);

/// The same of a file that is in memory already.
std::vector<Affine> parse_camera_motion(const NamedText &file);

/// One row of a result.
struct TrackRow {
    std::uint64_t id;
    double left, top, width, height, score;
};

/// Writes MOTChallenge rows to a file, or to stdout for "-".
class RowWriter {
public:
    explicit RowWriter(const std::string &path);
    ~RowWriter();
    RowWriter(const RowWriter &) = delete;
    RowWriter &operator=(const RowWriter &) = delete;

    /// Writes one frame's tracks, sorted by id.
    void write_tracks(long frame, std::vector<TrackRow> rows);

    /// Writes one frame's detections, in their order; their id is -1.
    void write_detections(long frame, const std::vector<DetectionRow> &rows);

    /// Flushes and closes. Throws `UserError` if anything could not be written, as when the disk is full.
    void close();

private:
    std::string path_;
    std::FILE *file_;
};

}  // namespace examples
