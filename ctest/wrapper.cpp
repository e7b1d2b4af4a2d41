// The C++ wrapper, seen from one of the two translation units of this program.
#include <gentrack2.hpp>

#include <iostream>
#include <type_traits>

// In wrapper_other.cpp.
std::vector<gentrack2::Track> track_elsewhere(gentrack2::Tracker &tracker, int from, int to);
std::vector<gentrack2::Detection> objects(int t);

namespace {

int failures = 0;

void check(bool holds, const char *what, int line) {
    if (!holds) {
        failures++;
        std::cerr << "wrapper.cpp:" << line << ": does not hold: " << what << '\n';
    }
}
#define CHECK(condition) check((condition), #condition, __LINE__)

template <class Call> gt2_status status_of(Call call) {
    try {
        call();
    } catch (const gentrack2::Error &error) {
        CHECK(std::string(error.what()) == gt2_last_error_message());
        return error.status();
    }
    return GT2_OK;
}

static_assert(std::is_base_of<std::runtime_error, gentrack2::Error>::value, "errors are std::runtime_error");
static_assert(!std::is_copy_constructible<gentrack2::Config>::value, "handles are not copied");
static_assert(!std::is_copy_constructible<gentrack2::Tracker>::value, "handles are not copied");
static_assert(std::is_nothrow_move_constructible<gentrack2::Config>::value, "handles are moved");
static_assert(std::is_nothrow_move_assignable<gentrack2::Tracker>::value, "handles are moved");
static_assert(std::is_constructible<gentrack2::Frame, std::vector<gentrack2::Detection> &>::value, "");
static_assert(std::is_constructible<gentrack2::Frame, const std::array<gentrack2::Detection, 2> &>::value, "");
static_assert(!std::is_constructible<gentrack2::Frame, std::vector<gentrack2::Detection>>::value,
              "a temporary would be gone before the step");

void configs() {
    gentrack2::Config config;
    CHECK(config.algorithm() == "gentrack2");
    config.set("particles", 12).set("lambda_p", 0.5).set("antithetic", false).set("seed", 7u).set("resampling", "none");
    CHECK(config.integer("particles") == 12 && config.number("particles") == 12.0);
    CHECK(config.number("lambda_p") == 0.5 && config.integer("antithetic") == 0 && config.text("seed") == "7");
    CHECK(config.text("resampling") == "none" && config.text("antithetic") == "false");
    gentrack2::Config read;
    read.load_toml(config.to_toml());
    CHECK(read.to_toml() == config.to_toml());
    gentrack2::Config copy = config.clone();
    copy.set("particles", 3);
    CHECK(config.integer("particles") == 12);
    gentrack2::Config moved = std::move(copy);
    CHECK(moved.integer("particles") == 3 && copy.get() == nullptr);
    CHECK(config.presets().front() == "default");
    CHECK(std::string(config.parameters().front().key).size() > 0);
    CHECK(!gentrack2::algorithms().empty() && gentrack2::version() == GT2_VERSION);

    CHECK(status_of([&] { config.set("particles", 0); }) == GT2_ERR_PARAMETER_VALUE);
    CHECK(status_of([&] { config.set("nothing", true); }) == GT2_ERR_UNKNOWN_PARAMETER);
    CHECK(status_of([&] { config.text("nothing"); }) == GT2_ERR_UNKNOWN_PARAMETER);
    CHECK(status_of([&] { config.load_toml("= ="); }) == GT2_ERR_CONFIG_SYNTAX);
    CHECK(status_of([] { gentrack2::Config("magic"); }) == GT2_ERR_UNKNOWN_ALGORITHM);
    CHECK(status_of([&] { moved = gentrack2::Config(); }) == GT2_OK);
}

void tracking() {
    gentrack2::Tracker tracker(gentrack2::Config("gentrack2").set("frame_rate", 25).set("seed", 1));
    CHECK(tracker.algorithm() == "gentrack2" && tracker.reported().empty());
    const std::vector<gentrack2::Track> tracks = track_elsewhere(tracker, 0, 10);
    CHECK(tracks.size() == 2 && tracks[0].id + tracks[1].id == 3);
    CHECK(tracker.track_of_detection().to_vector() == (std::vector<std::uint64_t>{1, 2}));

    // The frame is copied whole: its copies do not point into it.
    std::vector<std::uint8_t> pixels(640 * 480, 100);
    std::vector<gentrack2::Detection> detections = objects(10);
    gentrack2::Frame copy;
    {
        gentrack2::Frame frame(detections);
        frame.image(gentrack2::image(pixels.data(), 640, 480, GT2_PIXEL_GRAY8)).size(640, 480);
        frame.camera_motion({{1, 0, 0, 0, 1, 0}}).timestamp(std::chrono::milliseconds(400));
        copy = frame;
        CHECK(copy.raw().image != frame.raw().image && copy.raw().camera_motion != frame.raw().camera_motion);
        CHECK(frame.raw().timestamp_ns == 400000000 && frame.raw().detection_count == 2);
    }
    std::size_t count = 0;
    for (const gentrack2::Track &track : tracker.step(copy)) {
        CHECK(track.id == 1 || track.id == 2);
        CHECK(track.tag == 100 + track.id);
        count++;
    }
    CHECK(count == 2 && tracker.reported().size() == 2 && tracker.reported()[0].id == tracker.reported().begin()->id);
    CHECK(tracker.particles(1).size() == 8);
    CHECK(status_of([&] { tracker.particles(99); }) == GT2_ERR_UNKNOWN_TRACK);
    const gentrack2::Neighbourhood near = tracker.neighbourhood(1);
    CHECK(near.count == 0 && near.neighbours == nullptr && near.rule == GT2_MOVE_NONE);
    CHECK(status_of([&] { tracker.neighbourhood(99); }) == GT2_ERR_UNKNOWN_TRACK);
    CHECK(status_of([&] { tracker.step(copy); }) == GT2_ERR_TIMESTAMP);
    detections[1].score = 2.0;
    CHECK(status_of([&] { tracker.step(gentrack2::Frame(detections)); }) == GT2_ERR_DETECTION);
    CHECK(tracker.reported().size() == 2); // as before the calls that failed

    CHECK(tracker.step(gentrack2::Frame::skipped().timestamp(std::chrono::seconds(1))).size() <= 2);
    std::size_t ended = 0, lost = 0;
    for (int t = 0; t < 200; t++) {
        tracker.step(gentrack2::Frame());
        ended += tracker.ended().size();
        lost += tracker.lost().size();
    }
    CHECK(ended == 2 && lost > 0 && tracker.tentative().empty());

    gentrack2::Tracker moved = std::move(tracker);
    moved.reset();
    CHECK(track_elsewhere(moved, 0, 5).size() == 2);
    CHECK(moved.track_of_detection()[0] == 1);
    CHECK(status_of([&] { tracker.reset(); }) == GT2_ERR_NULL_POINTER); // moved from
}

void saving() {
    gentrack2::Tracker tracker(gentrack2::Config("gentrack2"));
    track_elsewhere(tracker, 0, 10);
    const std::vector<std::uint8_t> bytes = tracker.save();
    gentrack2::Tracker loaded = gentrack2::Tracker::load(bytes);
    CHECK(loaded.algorithm() == "gentrack2" && loaded.reported().size() == 2);
    CHECK(loaded.save() == bytes);
    CHECK(track_elsewhere(loaded, 10, 12).size() == 2 && loaded.track_of_detection()[0] == 1);
    CHECK(status_of([&] { gentrack2::Tracker::load(bytes.data(), bytes.size() / 2); }) == GT2_ERR_SNAPSHOT);
}

} // namespace

int main() {
    configs();
    tracking();
    saving();
    return failures > 0;
}
