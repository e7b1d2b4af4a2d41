#include "run.hpp"

#include <cstdio>
#include <optional>
#include <vector>

#include "annotator.hpp"
#include "canvas.hpp"
#include "drawn_tracks.hpp"
#include "inputs.hpp"
#include "mot_io.hpp"
#include "pictures.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "timing.hpp"

namespace gt2_mot {
namespace {

using namespace examples;

/// Drawing, if it was asked for.
class Drawing {
public:
    Drawing(const Options &o, double frame_rate, long frames, const cv::Size &plain_size)
        : options_(o),
          plain_size_(plain_size),
          what_(o.drawing),
          annotator_(o.drawing.layers(!o.input.has_images())) {
        what_.tentative = o.all_states;
        if (!o.annotate.empty()) video_.emplace(o.annotate, frame_rate);
        if (o.sheet.empty()) return;
        sheet_.emplace(o.sheet, o.sheet_frames.empty() ? ContactSheet::spread_over(frames) : o.sheet_frames);
    }

    bool wanted() const { return video_ || sheet_; }

    void add(const FrameInput &input, const Session &session) {
        if (!wanted()) return;
        cv::Mat canvas = canvas_for(input, plain_size_);
        const auto tracks = drawn_tracks(session, what_);
        const std::string caption = options_.tracker + "   frame " + std::to_string(input.frame) + "   tracks " +
                                    std::to_string(reported_count(tracks));
        annotator_.draw(canvas, caption, tracks, input.motion);
        if (video_) video_->add(canvas);
        if (sheet_) sheet_->add(input.frame, canvas);
    }

    void finish() const {
        if (sheet_) sheet_->write();
    }

private:
    const Options &options_;
    cv::Size plain_size_;
    DrawingOptions what_;
    Annotator annotator_;
    std::optional<VideoFile> video_;
    std::optional<ContactSheet> sheet_;
};

std::vector<TrackRow> rows_to_write(const Session &session, bool all_states) {
    std::vector<TrackRow> rows;
    for (const TrackedObject &t : session.tracks(all_states)) rows.push_back(t.row);
    return rows;
}

}  // namespace

void run(const Options &o) {
    Inputs inputs(o.input);
    Session session(tracker_settings(o), inputs.frame_rate(), o.input.video);
    RowWriter out(o.out);
    std::optional<RowWriter> detections;
    if (!o.save_det.empty()) detections.emplace(o.save_det);
    const long expected = inputs.expected_frames();
    Drawing drawing(o, session.frame_rate(), expected, inputs.plain_size());
    Progress progress(expected);
    StepTimes times;

    for (FrameInput input; inputs.next(input);) {
        progress.at(input.frame);
        session.step(input, times);
        out.write_tracks(input.frame, rows_to_write(session, o.all_states));
        if (detections) detections->write_detections(input.frame, input.rows.detections);
        drawing.add(input, session);
    }
    progress.clear();
    out.close();
    if (detections) detections->close();
    inputs.check_end();
    drawing.finish();
    if (o.input.estimate_camera_motion) std::fprintf(stderr, "%s\n", inputs.camera_summary().c_str());
    if (o.time) std::fprintf(stderr, "%s\n", times.summary().c_str());
}

}  // namespace gt2_mot
