#include "shared_options.hpp"

#include <filesystem>
#include <system_error>

#include "gentrack2.h"
#include "mot_rows.hpp"
#include "text.hpp"

namespace examples {

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
        {"--detect-every", [&] { o.detect_every = r.integer(1, max_frame); }},
        {"--timestamp-rate", [&] { o.timestamp_rate = r.number(1e-3, 1e6, "a number of frames per second"); }},
        {"--gmc", [&] { o.gmc = r.value(); }},
        {"--embeddings", [&] { o.embeddings = r.value(); }},
        {"--dim", [&] { o.dimension = static_cast<int>(r.integer(1, 16384)); }},
        {"--size", [&] { o.size = r.size(); }},
    };
}

OptionTable drawing_options(ArgumentReader &r, DrawingOptions &o, InputOptions &input) {
    return {
        {"--particles", [&] { o.particles = true; }},
        {"--neighbours", [&] { o.neighbours = true; }},
        {"--focus", [&] { o.focus = r.identities(); }},
        {"--class-names",
         [&] {
             o.class_names = read_class_names(r.value());
             input.classes = true;
         }},
    };
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
    if (o.classes && o.det.empty()) throw UserError("--class-names needs --det");
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
