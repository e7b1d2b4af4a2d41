// gentrack2_camera_motion.hpp: the estimated motion is the true one, and where there is none to be had it says so.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "gentrack2.hpp"
#include "gentrack2_opencv.hpp"

namespace {

using gentrack2::CameraMotion;
using gentrack2::CameraMotionEstimator;
using gentrack2::CameraMotionOptions;
using gentrack2::CameraMotionStatus;
using Affine = std::array<double, 6>;
using Boxes = std::vector<gentrack2::Detection>;

void check(bool holds, const char *what, int line) {
    if (holds) return;
    std::fprintf(stderr, "line %d: %s\n", line, what);
    std::exit(1);
}
#define CHECK(what) check((what), #what, __LINE__)

constexpr double degree = CV_PI / 180.0;
const Affine identity = {{1, 0, 0, 0, 1, 0}};

/// Noise of several wavelengths, all of them long enough for sub-pixel warps to be exact.
cv::Mat texture(cv::Size size, int type, std::uint64_t seed) {
    // The same ones are used again and again, and take their time.
    static std::map<std::tuple<int, int, int, std::uint64_t>, cv::Mat> made;
    cv::Mat &image = made[std::make_tuple(size.width, size.height, type, seed)];
    if (!image.empty()) return image;
    cv::RNG random(seed);
    cv::Mat sum = cv::Mat::zeros(size, CV_MAKETYPE(CV_32F, CV_MAT_CN(type)));
    for (const double wavelength : {2.0, 4.0, 8.0, 16.0, 32.0}) {
        cv::Mat noise(size, sum.type());
        random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
        cv::GaussianBlur(noise, noise, {}, wavelength);
        // Blurred noise fades with the area of the blur.
        sum += noise * wavelength;
    }
    cv::Scalar mean, deviation;
    cv::meanStdDev(sum, mean, deviation);
    sum.convertTo(image, CV_8U, 40.0 / deviation[0], 128.0);
    return image;
}

/// A camera over a large plane: the place of its centre on the plane, its rotation in degrees and its zoom.
struct Pose {
    double x, y, rotation, zoom;

    /// The map from the plane to the image.
    cv::Matx33d view(cv::Size size) const {
        const double c = zoom * std::cos(rotation * degree), s = zoom * std::sin(rotation * degree);
        const double u = (size.width - 1) / 2.0, v = (size.height - 1) / 2.0;
        return {c, -s, u - c * x + s * y, s, c, v - s * x - c * y, 0, 0, 1};
    }
};

struct Scene {
    cv::Size size;
    int type;
    std::function<Pose(int)> camera;
    /// The objects that move before the plane.
    std::function<Boxes(int)> objects;
    cv::Mat plane, skin;

    Scene(cv::Size size, int type, std::function<Pose(int)> camera, std::function<Boxes(int)> objects)
        : size(size), type(type), camera(std::move(camera)), objects(std::move(objects)) {
        plane = texture({2 * size.width, 2 * size.height}, type, 1);
        skin = texture(size, type, 2);
    }

    Pose pose(int frame) const {
        Pose p = camera(frame);
        p.x += plane.cols / 2.0;
        p.y += plane.rows / 2.0;
        return p;
    }

    cv::Mat image(int frame) const {
        cv::Mat image;
        const cv::Matx33d view = pose(frame).view(size);
        cv::warpAffine(plane, image, cv::Mat(view).rowRange(0, 2), size, cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
        for (const gentrack2::Detection &box : objects(frame)) {
            // The skin goes with the object.
            cv::Mat moved;
            const cv::Matx23d shift(1, 0, box.left, 0, 1, box.top);
            cv::warpAffine(skin, moved, shift, size, cv::INTER_CUBIC);
            const cv::Rect inside = cv::Rect(gentrack2::rect(box)) & cv::Rect({}, size);
            moved(inside).copyTo(image(inside));
        }
        return image;
    }

    Affine truth(int frame) const {
        const cv::Matx33d m = pose(frame).view(size) * pose(frame - 1).view(size).inv();
        return {{m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2)}};
    }
};

struct Errors {
    /// The farthest that a point of a grid over the whole image, corners included, comes to lie from its true place.
    double pixels = 0.0;
    double degrees = 0.0;

    void include(const Affine &m, const Affine &truth, cv::Size size) {
        for (int i = 0; i <= 8; ++i) {
            for (int k = 0; k <= 8; ++k) {
                const double x = (size.width - 1) * i / 8.0, y = (size.height - 1) * k / 8.0;
                const auto gap = [&](int row) {
                    return (m[row] - truth[row]) * x + (m[row + 1] - truth[row + 1]) * y + m[row + 2] - truth[row + 2];
                };
                pixels = std::max(pixels, std::hypot(gap(0), gap(3)));
            }
        }
        const auto angle = [](const Affine &a) { return std::atan2(a[3], a[0]) / degree; };
        degrees = std::max(degrees, std::fabs(angle(m) - angle(truth)));
    }
};

Boxes nobody(int) { return {}; }

/// A crowd of `count` that covers a tenth of the picture each and walks over it one way.
std::function<Boxes(int)> crowd(int count, cv::Size size) {
    return [=](int frame) {
        Boxes all;
        for (int k = 0; k < count; ++k) {
            const double left = size.width * (0.04 + 0.15 * k) + 5.3 * frame, top = size.height * 0.12 + 1.7 * frame;
            all.push_back(gentrack2::detection(left, top, size.width * 0.13, size.height * 0.75, 0.9));
        }
        return all;
    };
}

/// The largest errors over some frames; with the boxes masked, all of them must be estimated.
Errors errors_of(const Scene &scene, const CameraMotionOptions &options, bool masked = true) {
    CameraMotionEstimator estimator(options);
    Errors errors;
    for (int frame = 0; frame < 6; ++frame) {
        const CameraMotion motion = estimator.estimate(scene.image(frame), masked ? scene.objects(frame) : Boxes());
        if (frame == 0) continue;
        CHECK(!masked || (motion.reliable && motion.status == CameraMotionStatus::estimated));
        errors.include(motion.affine, scene.truth(frame), scene.size);
    }
    return errors;
}

struct Movement {
    const char *name;
    std::function<Pose(int)> camera;
};

const std::vector<Movement> movements = {
    {"still", [](int) { return Pose{0, 0, 0, 1}; }},
    {"pan", [](int t) { return Pose{9.3 * t, -3.7 * t, 0, 1}; }},
    {"fast pan", [](int t) { return Pose{41.6 * t, 0.2 * t, 0, 1}; }},
    {"zoom in", [](int t) { return Pose{0, 0, 0, std::pow(1.04, t)}; }},
    {"zoom out", [](int t) { return Pose{0, 0, 0, std::pow(0.97, t)}; }},
    {"rotation", [](int t) { return Pose{0, 0, 2.5 * t, 1}; }},
    {"mix", [](int t) { return Pose{-7.1 * t, 4.4 * t, -1.3 * t, std::pow(1.02, t)}; }},
};

const cv::Size usual(768, 576);

void print(const std::string &what, const Errors &errors) {
    std::printf("%-40s %7.3f px %8.4f degrees\n", what.c_str(), errors.pixels, errors.degrees);
}

/// Four of a crowd, two fifths of the picture, walk through it.
void test_estimates_are_true() {
    for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
        for (const Movement &movement : movements) {
            const Scene scene(usual, type, movement.camera, crowd(4, usual));
            for (const bool full : {false, true}) {
                // Colour is only a matter of how grey is made of it.
                if (full && type != CV_8UC1) continue;
                CameraMotionOptions options;
                options.full_affine = full;
                const Errors errors = errors_of(scene, options);
                print(std::to_string(CV_MAT_CN(type)) + " channels, " + movement.name +
                          (full ? ", full affine" : ", similarity"), errors);
                CHECK(errors.pixels < 0.5 && errors.degrees < 0.1);
            }
        }
    }
}

void test_scaled_images_serve() {
    const cv::Size size(1920, 1080);
    const Scene scene(size, CV_8UC1, movements.back().camera, crowd(4, size));
    for (const int side : {0, 960, 640}) {
        CameraMotionOptions options;
        options.max_side = side;
        const Errors errors = errors_of(scene, options);
        print("1920x1080, scaled to " + std::to_string(side), errors);
        CHECK(errors.pixels < 0.5 && errors.degrees < 0.1);
    }
}

/// Five of the crowd: without their boxes the estimate is theirs, not the camera's.
void test_the_boxes_are_needed() {
    for (const Movement &movement : movements) {
        const Scene scene(usual, CV_8UC1, movement.camera, crowd(5, usual));
        const Errors masked = errors_of(scene, {}), unmasked = errors_of(scene, {}, false);
        print(std::string("crowd, ") + movement.name + ", with boxes", masked);
        print(std::string("crowd, ") + movement.name + ", without", unmasked);
        CHECK(masked.pixels < 0.5 && masked.degrees < 0.1);
        CHECK(unmasked.pixels > 5.0);
    }
}

bool is(const CameraMotion &motion, CameraMotionStatus status) {
    const bool told = status == CameraMotionStatus::estimated;
    return motion.status == status && motion.reliable == told && (told || motion.affine == identity) &&
           *motion.reason() != '\0';
}

void test_it_says_when_it_cannot_tell() {
    const Scene scene(usual, CV_8UC1, movements[1].camera, nobody);
    const cv::Mat first = scene.image(0), second = scene.image(1);
    const Boxes everything = {gentrack2::detection(-1e9, -1e9, 2e9, 2e9, 0.9)};
    const cv::Mat flat(usual, CV_8UC1, cv::Scalar(90));
    CameraMotionEstimator estimator;

    CHECK(is(estimator.estimate(first), CameraMotionStatus::first_frame));
    CHECK(is(estimator.estimate(second), CameraMotionStatus::estimated));
    estimator.reset();
    CHECK(is(estimator.estimate(second), CameraMotionStatus::first_frame));

    // The boxes of this frame hide what was found in the last one, then there is nothing to find again.
    CHECK(is(estimator.estimate(second, everything), CameraMotionStatus::too_few_matches));
    CHECK(is(estimator.estimate(second), CameraMotionStatus::too_few_features));
    CHECK(is(estimator.estimate(second), CameraMotionStatus::estimated));

    CHECK(is(estimator.estimate(flat), CameraMotionStatus::too_few_matches));
    CHECK(is(estimator.estimate(flat), CameraMotionStatus::too_few_features));
    CHECK(is(estimator.estimate(first), CameraMotionStatus::too_few_features));

    // A cut to another place.
    const CameraMotion cut = estimator.estimate(texture(usual, CV_8UC1, 3));
    CHECK(!cut.reliable && cut.affine == identity);

    // Tiny images have no room for corners, but do no harm.
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 40), cv::Size(9, 9)}) {
        estimator.reset();
        const cv::Mat tiny = first(cv::Rect({}, size));
        estimator.estimate(tiny);
        CHECK(is(estimator.estimate(tiny), CameraMotionStatus::too_few_features));
    }
}

void test_limits_are_the_callers() {
    const Scene scene(usual, CV_8UC1, movements.back().camera, nobody);
    const auto status = [&](CameraMotionOptions options) {
        CameraMotionEstimator estimator(options);
        estimator.estimate(scene.image(0));
        const CameraMotion motion = estimator.estimate(scene.image(1));
        CHECK(motion.reliable || motion.affine == identity);
        return motion.status;
    };
    // From frame to frame: 8.4 pixels of 768, 1.3 degrees, 2 per cent.
    CameraMotionOptions options;
    CHECK(status(options) == CameraMotionStatus::estimated);
    options.max_shift = 0.01;
    CHECK(status(options) == CameraMotionStatus::implausible);
    options = {};
    options.max_rotation = 1.2;
    CHECK(status(options) == CameraMotionStatus::implausible);
    options = {};
    options.max_zoom = 1.019;
    CHECK(status(options) == CameraMotionStatus::implausible);
    options = {};
    options.max_error = 1e-9;
    CHECK(status(options) == CameraMotionStatus::inexact);
    options = {};
    options.min_inliers = 399;
    options.max_features = 400;
    CHECK(status(options) != CameraMotionStatus::estimated);
}

void test_another_size_starts_over() {
    const Scene scene(usual, CV_8UC1, movements[1].camera, nobody);
    CameraMotionEstimator estimator;
    estimator.estimate(scene.image(0));
    const cv::Rect part(0, 0, 640, 480);
    CHECK(is(estimator.estimate(scene.image(1)(part)), CameraMotionStatus::size_changed));
    const CameraMotion motion = estimator.estimate(scene.image(2)(part));
    CHECK(is(motion, CameraMotionStatus::estimated));
    Errors errors;
    errors.include(motion.affine, scene.truth(2), part.size());
    CHECK(errors.pixels < 0.5);
}

template <class Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const std::invalid_argument &error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string &text, const char *part) { return text.find(part) != std::string::npos; }

void test_refusals() {
    const Scene scene(usual, CV_8UC1, movements[1].camera, nobody);
    CameraMotionEstimator estimator;
    estimator.estimate(scene.image(0));
    CHECK(contains(refusal([&] { estimator.estimate(cv::Mat()); }), "empty"));
    for (const int type : {CV_8UC2, CV_8SC1, CV_16UC1, CV_32FC3, CV_64FC1}) {
        CHECK(contains(refusal([&] { estimator.estimate(cv::Mat::zeros(40, 40, type)); }), "must be CV_8UC1"));
    }
    const int sizes[] = {4, 4, 4};
    CHECK(contains(refusal([&] { estimator.estimate(cv::Mat(3, sizes, CV_8UC1)); }), "3 dimensions"));
    for (const double bad : {std::nan(""), HUGE_VAL, -1.0}) {
        const Boxes boxes = {gentrack2::detection(0, 0, bad, 5, 0.9)};
        CHECK(contains(refusal([&] { estimator.estimate(scene.image(1), boxes); }), "a box is not finite"));
    }
    // As if none of that had been.
    CHECK(is(estimator.estimate(scene.image(1)), CameraMotionStatus::estimated));

    const std::vector<std::function<void(CameraMotionOptions &)>> mistakes = {
        [](auto &o) { o.max_side = -1; },          [](auto &o) { o.max_features = 9; },
        [](auto &o) { o.min_inliers = 2; },        [](auto &o) { o.min_inlier_share = 1.1; },
        [](auto &o) { o.tolerance = std::nan(""); }, [](auto &o) { o.box_margin = -0.1; },
        [](auto &o) { o.max_shift = 0; },          [](auto &o) { o.max_zoom = 1; },
        [](auto &o) { o.max_rotation = -5; },      [](auto &o) { o.max_error = 0; },
    };
    for (const auto &mistake : mistakes) {
        CameraMotionOptions options;
        mistake(options);
        CHECK(contains(refusal([&] { CameraMotionEstimator made(options); }), "out of range"));
    }
}

/// Neither the number of threads, nor what lies around a region of interest, nor what becomes of the image counts.
void test_same_images_same_map() {
    const Scene scene(usual, CV_8UC1, movements.back().camera, crowd(2, usual));
    std::vector<Affine> maps;
    const int usual_threads = cv::getNumThreads();
    for (const int threads : {usual_threads, 1}) {
        cv::setNumThreads(threads);
        for (const bool region : {false, true}) {
            CameraMotionEstimator estimator;
            cv::Mat whole(usual.height + 200, usual.width + 200, CV_8UC1);
            for (int frame = 0; frame < 2; ++frame) {
                cv::randu(whole, 0, 256);
                cv::Mat image = region ? whole(cv::Rect({100, 100}, usual)) : cv::Mat(usual, CV_8UC1);
                scene.image(frame).copyTo(image);
                const Boxes boxes = scene.objects(frame);
                const CameraMotion motion = estimator.estimate(image, boxes.data(), boxes.size());
                if (frame == 1) maps.push_back(motion.affine);
                image.setTo(0);
            }
        }
    }
    cv::setNumThreads(usual_threads);
    CHECK(maps[0] != identity);
    for (const Affine &map : maps) CHECK(map == maps[0]);
}

/// A handheld camera swings by more than the width of the people it films.
struct Swing {
    Scene scene{usual, CV_8UC3, &Swing::camera, &Swing::people};

    static Pose camera(int t) { return {120 * std::sin(0.7 * t), 25 * std::sin(1.9 * t), 0, 1}; }

    static Boxes people(int t) {
        const Pose c = camera(t);
        Boxes all;
        for (int k = 0; k < 4; ++k) {
            const double pace = k % 2 ? -1.5 : 1.5;
            all.push_back(gentrack2::detection(110 + 160 * k + pace * t - c.x, 220 + 10 * k - c.y, 45, 130, 0.9, 0, k));
        }
        return all;
    }

    struct Result {
        std::size_t identities = 0;
        /// Reported boxes, and those of them that lie on a person with an IoU above one half.
        std::size_t boxes = 0, right = 0;
    };

    /// From frame 15 on, each of the four is missed by the detector for five frames of every twenty.
    Result run(bool estimate) const {
        gentrack2::Config config("gentrack2");
        gentrack2::Tracker tracker(config);
        CameraMotionEstimator estimator;
        std::vector<std::uint64_t> seen;
        Result result;
        for (int t = 0; t < 60; ++t) {
            const Boxes truth = people(t);
            Boxes detections;
            for (const gentrack2::Detection &box : truth) {
                if (t < 15 || (t + 5 * box.tag) % 20 >= 5) detections.push_back(box);
            }
            const cv::Mat image = scene.image(t);
            gentrack2::Frame frame(detections);
            frame.image(gentrack2::image(image));
            if (estimate) estimator.estimate(image, detections).give_to(frame);
            for (const gentrack2::Track &track : tracker.step(frame)) {
                const cv::Rect2d box = gentrack2::rect(track);
                ++result.boxes;
                result.right += std::any_of(truth.begin(), truth.end(), [&](const gentrack2::Detection &person) {
                    return (gentrack2::rect(person) & box).area() > 0.5 * (gentrack2::rect(person) | box).area();
                });
                if (std::find(seen.begin(), seen.end(), track.id) == seen.end()) seen.push_back(track.id);
            }
        }
        result.identities = seen.size();
        return result;
    }
};

void test_a_tracker_is_helped() {
    const Swing swing;
    const Swing::Result with = swing.run(true), without = swing.run(false);
    std::printf("with camera motion %zu identities and %zu of %zu boxes right, without %zu and %zu of %zu\n",
                with.identities, with.right, with.boxes, without.identities, without.right, without.boxes);
    // Four people in sixty frames; a new one may have to prove himself for a few.
    CHECK(with.identities == 4 && with.right == with.boxes && with.boxes >= 4 * 55);
    CHECK(without.identities > 4 && without.right < with.right);
}

template <class Motion, class Frame, class = void>
struct Gives : std::false_type {};
template <class Motion, class Frame>
struct Gives<Motion, Frame, std::void_t<decltype(std::declval<Motion>().give_to(std::declval<Frame &>()))>>
    : std::true_type {};

// A gt2_frame points to the motion, so a temporary one must not compile.
static_assert(Gives<const CameraMotion &, gt2_frame>::value && !Gives<CameraMotion, gt2_frame>::value);
static_assert(Gives<const CameraMotion &, gentrack2::Frame>::value && Gives<CameraMotion, gentrack2::Frame>::value);

/// What give_to gives to the two kinds of frame.
void test_frames_get_only_what_is_reliable() {
    CameraMotion motion;
    gt2_frame raw = GT2_FRAME_INIT;
    gentrack2::Frame frame;
    motion.give_to(raw);
    motion.give_to(frame);
    CHECK(raw.camera_motion == nullptr && frame.raw().camera_motion == nullptr);
    motion.reliable = true;
    motion.affine = {{1, 0, 5, 0, 1, 6}};
    motion.give_to(raw);
    motion.give_to(frame);
    CHECK(raw.camera_motion == motion.affine.data());
    CHECK(std::equal(motion.affine.begin(), motion.affine.end(), frame.raw().camera_motion));
}

}  // namespace

int main() {
    test_estimates_are_true();
    test_scaled_images_serve();
    test_the_boxes_are_needed();
    test_it_says_when_it_cannot_tell();
    test_limits_are_the_callers();
    test_another_size_starts_over();
    test_refusals();
    test_same_images_same_map();
    test_a_tracker_is_helped();
    test_frames_get_only_what_is_reliable();
    std::puts("ok");
}
