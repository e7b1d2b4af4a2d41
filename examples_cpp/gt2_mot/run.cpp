#include "run.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "annotator.hpp"
#include "detector.hpp"
#include "frame_source.hpp"
#include "mot_io.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "text.hpp"
#include "timing.hpp"

namespace gt2_mot {
namespace {

/// Everything a run reads.
struct Inputs {
    FrameSource source;
    DetectionFilter filter;
    DetectionFile file;
    std::vector<Affine> motions;
    std::unique_ptr<Detector> detector;

    explicit Inputs(const Options &o) : source(o), filter{o.min_score, o.max_height} {
        if (!o.det.empty()) file = read_detections(o.det, {filter, o.normalise_scores, o.embeddings, o.dimension});
        if (!o.gmc.empty()) motions = read_camera_motion(o.gmc);
        if (!o.detector.empty()) detector = make_detector(o.detector);
    }

    long last_row() const { return std::max(file.last_frame, static_cast<long>(motions.size())); }

    /// The number of frames to step; none for "until the images end".
    std::optional<long> length(const Options &o) const {
        if (o.frames) return *o.frames;
        return source.has_images() ? std::nullopt : std::optional<long>(last_row());
    }
};

/// Drawing, if it was asked for.
class Drawing {
public:
    Drawing(const Options &o, double frame_rate, long frames) : options_(o) {
        if (!o.annotate.empty()) video_.emplace(o.annotate, frame_rate);
        if (o.sheet.empty()) return;
        sheet_.emplace(o.sheet, o.sheet_frames.empty() ? ContactSheet::spread_over(frames) : o.sheet_frames);
    }

    bool wanted() const { return video_ || sheet_; }

    void add(long frame, const FrameInput &input, const Session &session) {
        if (!wanted()) return;
        cv::Mat canvas = input.image.empty() ? cv::Mat(input.size.value(), CV_8UC3, cv::Scalar::all(40))
                                             : input.image.clone();
        annotator_.draw(canvas, frame, drawn(session), input.motion);
        if (video_) video_->add(canvas);
        if (sheet_) sheet_->add(frame, canvas);
    }

    void finish() const {
        if (sheet_) sheet_->write();
    }

private:
    std::vector<DrawnTrack> drawn(const Session &session) const {
        std::vector<DrawnTrack> tracks;
        for (const TrackedObject &t : session.tracks(true)) {
            if (t.state == TrackState::tentative && !t.reported && !options_.all_states) continue;
            DrawnTrack d{t.row.id, {t.row.left, t.row.top, t.row.width, t.row.height}, look(t), t.matched, {}};
            if (options_.particles) d.particles = session.particles(t.row.id);
            tracks.push_back(std::move(d));
        }
        return tracks;
    }

    static Look look(const TrackedObject &t) {
        if (t.reported) return t.matched ? Look::strong : Look::weak;
        return t.state == TrackState::tentative ? Look::tentative : Look::lost;
    }

    const Options &options_;
    Annotator annotator_;
    std::optional<VideoFile> video_;
    std::optional<ContactSheet> sheet_;
};

/// The detections of a frame: found in the image or looked up.
FrameRows rows_of(long frame, const cv::Mat &image, Inputs &inputs) {
    if (!inputs.detector) {
        const auto found = inputs.file.frames.find(frame);
        return found == inputs.file.frames.end() ? FrameRows{} : std::move(found->second);
    }
    FrameRows rows{inputs.detector->detect(image), {}};
    auto &all = rows.detections;
    const auto dropped = [&](const DetectionRow &row) { return !inputs.filter.passes(row); };
    all.erase(std::remove_if(all.begin(), all.end(), dropped), all.end());
    return rows;
}

std::vector<TrackRow> rows_to_write(const Session &session, bool all_states) {
    std::vector<TrackRow> rows;
    for (const TrackedObject &t : session.tracks(all_states)) rows.push_back(t.row);
    return rows;
}

void check_end(long frames, const Inputs &inputs, const Options &o) {
    if (!inputs.source.has_images()) return;
    const std::string ends = inputs.source.name() + ": ends after " + std::to_string(frames) + " frames, but ";
    if (o.frames && frames < *o.frames) throw UserError(ends + "--frames asks for " + std::to_string(*o.frames));
    if (!o.frames && inputs.file.last_frame > frames) {
        throw UserError(ends + o.det + " has detections up to frame " + std::to_string(inputs.file.last_frame));
    }
}

}  // namespace

void run(const Options &o) {
    Inputs inputs(o);
    Session session(o, inputs.source.frame_rate());
    RowWriter out(o.out);
    std::optional<RowWriter> detections;
    if (!o.save_det.empty()) detections.emplace(o.save_det);
    const std::optional<long> length = inputs.length(o);
    const long expected = length ? *length : inputs.source.expected_frames();
    Drawing drawing(o, session.frame_rate(), expected);
    Progress progress(expected);
    StepTimes times;

    long frame = 1;
    for (cv::Mat image; !length || frame <= *length; ++frame) {
        if (inputs.source.has_images() && !inputs.source.read(image)) break;
        progress.at(frame);
        const FrameRows rows = rows_of(frame, image, inputs);
        FrameInput input{&rows, o.dimension, image, o.size, std::nullopt};
        if (static_cast<std::size_t>(frame) <= inputs.motions.size()) input.motion = inputs.motions[frame - 1];
        try {
            session.step(input, times);
        } catch (const UserError &error) {
            throw UserError("frame " + std::to_string(frame) + ": " + error.what());
        }
        out.write_tracks(frame, rows_to_write(session, o.all_states));
        if (detections) detections->write_detections(frame, rows.detections);
        drawing.add(frame, input, session);
    }
    progress.clear();
    out.close();
    if (detections) detections->close();
    check_end(frame - 1, inputs, o);
    drawing.finish();
    if (o.time) std::fprintf(stderr, "%s\n", times.summary().c_str());
}

}  // namespace gt2_mot
