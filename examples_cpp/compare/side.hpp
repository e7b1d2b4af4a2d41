// One tracker of the two, and its half of the picture.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "annotator.hpp"
#include "drawn_tracks.hpp"
#include "session.hpp"
#include "switch_marks.hpp"
#include "timing.hpp"

namespace compare {

class Side {
public:
    /// `video_rate` is the frame rate of the video of that name, 0 if unknown; `fps`, if given, replaces it. Throws
    /// `examples::UserError`.
    Side(const examples::TrackerSettings &settings, double video_rate, const std::string &video,
         std::optional<double> fps, const examples::DrawingOptions &drawing, bool plain);

    /// Marks identity switches from now on.
    void mark_switches();

    /// Tracks a frame and returns it annotated on `canvas`, under a band with the tracker's name and counts. `truth`
    /// are the frame's true boxes, if switches are to be marked.
    cv::Mat step(const examples::FrameInput &input, cv::Mat canvas, const std::vector<examples::TrueBox> &truth);

    /// The frame rate the tracker was set to.
    double frame_rate() const { return session_.frame_rate(); }

    /// One line about the run: name, identities, boxes, mean time of a step.
    std::string summary() const;

private:
    std::string option_, title_;
    examples::Session session_;
    examples::DrawingOptions drawing_;
    examples::Annotator annotator_;
    std::optional<examples::SwitchMarks> marks_;
    examples::StepTimes times_;
    std::set<std::uint64_t> identities_;
    std::size_t boxes_ = 0;
};

}  // namespace compare
