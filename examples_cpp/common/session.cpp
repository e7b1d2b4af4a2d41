#include "session.hpp"

#include <algorithm>
#include <string>

#include "gentrack2.h"
#include "gentrack2_opencv.hpp"
#include "text.hpp"

namespace examples {
namespace {

struct Release {
    void operator()(gt2_config *config) const { gt2_config_free(config); }
    void operator()(gt2_tracker *tracker) const { gt2_tracker_free(tracker); }
};

void check(gt2_status status, const std::string &place = "") {
    if (status != GT2_OK) throw UserError(place + gt2_last_error_message());
}

void set(gt2_config *config, const Setting &s) {
    check(gt2_config_set(config, s.key.c_str(), s.value.c_str()), s.place + ": ");
}

void load(gt2_config *config, const std::string &path, const TrackerSettings &s) {
    const std::string text = read_file(path);
    check(gt2_config_load_toml(config, text.data(), text.size()), path + ": ");
    const std::string algorithm = gt2_config_algorithm(config);
    if (algorithm != s.name) throw UserError(path + ": is for " + algorithm + ", but " + s.option + " is " + s.name);
}

/// How a weak track moves, in a word or two; empty for others.
std::string rule_name(std::int32_t rule) {
    switch (rule) {
        case GT2_MOVE_STILL: return "stays";
        case GT2_MOVE_OWN: return "own way";
        case GT2_MOVE_WITH_NEIGHBOURS: return "with them";
        case GT2_MOVE_AROUND: return "around them";
    }
    return "";
}

}  // namespace

struct Session::Parts {
    std::unique_ptr<gt2_config, Release> config;
    std::unique_ptr<gt2_tracker, Release> tracker;
    std::vector<gt2_detection> detections;
};

Session::Session(const TrackerSettings &s, double video_rate, const std::string &video)
    : parts_(std::make_unique<Parts>()) {
    gt2_config *config = nullptr;
    check(gt2_config_new(s.name.c_str(), &config), s.option + ": ");
    parts_->config.reset(config);
    if (video_rate > 0) set(config, {"frame_rate", text_of(video_rate), video});
    if (!s.config.empty()) load(config, s.config, s);
    for (const Setting &setting : s.settings) set(config, setting);
    gt2_tracker *tracker = nullptr;
    check(gt2_tracker_new(config, &tracker));
    parts_->tracker.reset(tracker);
}

Session::~Session() = default;

void Session::step(const FrameInput &input, StepTimes &times) {
    auto &detections = parts_->detections;
    detections.clear();
    for (const DetectionRow &r : input.rows.detections) {
        detections.push_back(gentrack2::detection(cv::Rect2d(r.left, r.top, r.width, r.height), r.score, r.class_id));
    }
    gt2_frame frame = GT2_FRAME_INIT;
    frame.detections = detections.data();
    frame.detection_count = detections.size();
    if (!input.rows.embeddings.empty()) {
        frame.embeddings = input.rows.embeddings.data();
        frame.embedding_dimension = static_cast<std::size_t>(input.dimension);
    }
    frame.detector_skipped = !input.detected;
    frame.has_timestamp = input.timestamp_ns.has_value();
    frame.timestamp_ns = input.timestamp_ns.value_or(0);
    gt2_image image = GT2_IMAGE_INIT;
    if (!input.image.empty()) {
        image = gentrack2::image(input.image);
        frame.image = &image;
    } else if (input.size) {
        frame.image_width = static_cast<std::uint32_t>(input.size->width);
        frame.image_height = static_cast<std::uint32_t>(input.size->height);
    }
    if (input.motion) frame.camera_motion = input.motion->data();

    const auto start = StepTimes::Clock::now();
    const gt2_status status = gt2_tracker_step(parts_->tracker.get(), &frame);
    times.add(StepTimes::Clock::now() - start);
    check(status, "frame " + std::to_string(input.frame) + ": ");
}

std::vector<TrackedObject> Session::tracks(bool all) const {
    std::vector<TrackedObject> objects;
    for (const std::int32_t kind : {GT2_TRACKS_REPORTED, GT2_TRACKS_TENTATIVE, GT2_TRACKS_LOST}) {
        if (kind != GT2_TRACKS_REPORTED && !all) break;
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        check(gt2_tracker_tracks(parts_->tracker.get(), kind, &list));
        for (std::size_t i = 0; i < list.count; ++i) {
            const gt2_track &t = *gt2_track_at(&list, i);
            const TrackState state = t.state == GT2_TRACK_CONFIRMED ? TrackState::confirmed
                                     : t.state == GT2_TRACK_LOST    ? TrackState::lost
                                                                    : TrackState::tentative;
            objects.push_back({{t.id, t.left, t.top, t.width, t.height, t.score}, state, kind == GT2_TRACKS_REPORTED,
                               t.detection_index >= 0, t.class_id});
        }
    }
    return objects;
}

std::vector<DrawnParticle> Session::particles(std::uint64_t id) const {
    gt2_particle_list list = GT2_PARTICLE_LIST_INIT;
    check(gt2_tracker_particles(parts_->tracker.get(), id, &list));
    std::vector<DrawnParticle> particles;
    for (std::size_t i = 0; i < list.count; ++i) {
        const gt2_particle &p = *gt2_particle_at(&list, i);
        particles.push_back({gentrack2::rect(p), p.fitness});
    }
    return particles;
}

DrawnNeighbours Session::neighbours(std::uint64_t id) const {
    gt2_neighbourhood near = GT2_NEIGHBOURHOOD_INIT;
    check(gt2_tracker_neighbourhood(parts_->tracker.get(), id, &near));
    return {{near.neighbours, near.neighbours + near.count},
            near.trusted_count,
            {near.velocity_u, near.velocity_v},
            rule_name(near.rule),
            near.rule == GT2_MOVE_WITH_NEIGHBOURS};
}

double Session::frame_rate() const {
    double rate = 0.0;
    check(gt2_config_get_number(parts_->config.get(), "frame_rate", &rate));
    return rate;
}

}  // namespace examples
