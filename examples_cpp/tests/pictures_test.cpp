// Each layer of a picture draws what it should, where it should, on a plain grey ground.
#include <algorithm>
#include <opencv2/core.hpp>

#include "annotator.hpp"
#include "checks.hpp"
#include "drawing.hpp"
#include "labels.hpp"
#include "palette.hpp"

using namespace examples;

static const cv::Vec3b ground(100, 100, 100);

static cv::Vec3b bgr(const cv::Scalar &colour) {
    return cv::Mat3b(1, 1, cv::Vec3b()).setTo(colour).at<cv::Vec3b>(0);
}

static long count(const cv::Mat &image, const cv::Scalar &colour, cv::Rect area = {}) {
    if (area.empty()) area = cv::Rect(0, 0, image.cols, image.rows);
    cv::Mat found;
    cv::inRange(image(area), cv::Scalar(bgr(colour)), cv::Scalar(bgr(colour)), found);
    return cv::countNonZero(found);
}

/// Whether a pixel has nearly that colour: thin lines are smoothed.
static bool shows(const cv::Vec3b &pixel, const cv::Scalar &colour) {
    return cv::norm(pixel, bgr(colour), cv::NORM_INF) <= 40;
}

static cv::Vec3b at(const cv::Mat &image, double x, double y) { return image.at<cv::Vec3b>(cvRound(y), cvRound(x)); }

static DrawnTrack track(std::uint64_t id, cv::Rect2d box, Look look) {
    DrawnTrack t;
    t.id = id, t.box = box, t.look = look, t.label = std::to_string(id);
    return t;
}

static cv::Mat blank(cv::Size size = {768, 576}) { return cv::Mat(size, CV_8UC3, cv::Scalar(ground)); }

static cv::Mat drawn(const std::vector<DrawnTrack> &tracks, const Annotator::Layers &layers = {}) {
    cv::Mat image = blank();
    Annotator(layers).draw(image, "", tracks, std::nullopt);
    return image;
}

/// Where the box of `track` in these tests is, and nothing of the legend and the caption.
static const cv::Rect scene(0, 40, 768, 480);
static const cv::Rect2d place(300, 200, 60, 150);

static void each_look_has_its_line() {
    const cv::Mat strong = drawn({track(7, place, Look::strong)}), weak = drawn({track(7, place, Look::weak)});
    const cv::Mat lost = drawn({track(7, place, Look::lost)}), young = drawn({track(7, place, Look::tentative)});
    for (const double y : {260.0, 300.0, 340.0}) {
        CHECK(at(strong, 300, y) == bgr(palette::strong) && at(strong, 360, y) == bgr(palette::strong));
        CHECK(shows(at(young, 300, y), palette::tentative));
    }
    CHECK(at(strong, 330, 200) == bgr(palette::strong) && at(strong, 330, 350) == bgr(palette::strong));
    CHECK(at(strong, 330, 270) == ground);
    CHECK(count(strong, palette::weak, scene) == 0 && count(weak, palette::strong, scene) == 0);
    CHECK(count(lost, palette::strong, scene) == 0 && count(young, palette::strong, scene) == 0);
    // The left side of a weak box has dashes and gaps, that of a lost one more of either.
    const auto changes = [](const cv::Mat &image) {
        int n = 0;
        bool on = false;
        for (int y = 205; y < 345; ++y) {
            const bool now = at(image, 300, y) == bgr(palette::weak);
            n += now != on, on = now;
        }
        return n;
    };
    CHECK(changes(weak) >= 12 && changes(lost) > changes(weak));
    const long dashes = count(weak, palette::weak, scene), dots = count(lost, palette::weak, scene);
    CHECK(dots > 50 && dashes > dots && count(strong, palette::strong, scene) > dashes);
    // An edge makes it seen on any ground.
    int darkest = 255;
    for (int x = 296; x <= 304; ++x) darkest = std::min<int>(darkest, at(strong, x, 300)[1]);
    CHECK(darkest < ground[1] / 2);
    // Labels: on the identity's colour, above the box; tentative tracks have none.
    const cv::Rect above(300, 180, 60, 18);
    CHECK(count(strong, identity_colour(7), above) > 50 && count(weak, identity_colour(7), above) > 50);
    CHECK(count(young, identity_colour(7)) == 0);
}

static void what_is_in_focus_is_bold() {
    DrawnTrack bold = track(7, place, Look::strong);
    bold.in_focus = true;
    const long usual = count(drawn({track(7, place, Look::strong)}), palette::strong, scene);
    CHECK(count(drawn({bold}), palette::strong, scene) > 3 * usual / 2);
}

static void particles_are_drawn_the_fitter_the_brighter() {
    DrawnTrack t = track(3, place, Look::strong);
    const cv::Mat without = drawn({t});
    t.particles = {{{270, 220, 60, 100}, 1.0}, {{330, 240, 60, 100}, 0.0}};
    const cv::Mat with = drawn({t}, {true, false, false});
    CHECK(at(without, 300, 270) == bgr(palette::strong) && at(without, 300, 310) == bgr(palette::strong));
    CHECK(at(with, 300, 270) == bgr(identity_colour(3)));
    CHECK(at(with, 360, 290) == bgr(identity_colour(3) * 0.4));
    // Their boxes.
    CHECK(at(without, 270, 300) == ground && shows(at(with, 270, 300), identity_colour(3)));
    CHECK(at(without, 390, 300) == ground && shows(at(with, 390, 300), identity_colour(3) * 0.4));
}

static std::vector<DrawnTrack> weak_among_three(bool followed) {
    std::vector<DrawnTrack> tracks = {track(1, place, Look::weak), track(2, {100, 225, 60, 100}, Look::strong),
                                      track(3, {300, 400, 60, 100}, Look::lost)};
    tracks[0].neighbours = {{2, 3, 99}, 1, {120, 0}, followed ? "with them" : "own way", followed};
    return tracks;
}

static void neighbours_and_their_motion() {
    auto tracks = weak_among_three(true);
    const cv::Mat with = drawn(tracks, {false, true, false});
    // From (330, 275) to (130, 275), who is trustworthy, and to (330, 450), who is not; id 99 has gone.
    CHECK(shows(at(with, 200, 275), palette::neighbours) && shows(at(with, 250, 275), palette::neighbours));
    CHECK(shows(at(with, 130, 275), palette::neighbours) && shows(at(with, 330, 450), palette::tentative));
    // What they move by in a second.
    CHECK(shows(at(with, 400, 275), palette::motion) && shows(at(with, 430, 275), palette::motion));
    CHECK(at(with, 470, 275) == ground);
    const cv::Rect shaft(380, 260, 40, 30), below(300, 352, 100, 20);
    const long bold = count(with, palette::motion, shaft);
    const long thin = count(drawn(weak_among_three(false), {false, true, false}), palette::motion, shaft);
    CHECK(thin > 20 && bold > 4 * thin / 3);
    // The rule stands below the box.
    CHECK(count(with, palette::motion, below) > 200);
    for (DrawnTrack &t : tracks) t.neighbours = {};
    const cv::Mat without = drawn(tracks);
    CHECK(count(without, palette::neighbours, scene) == 0 && count(without, palette::motion, scene) == 0);
    // Nobody trustworthy: no arrow.
    tracks[0].neighbours = {{3}, 0, {0, 0}, "own way", false};
    CHECK(count(drawn(tracks, {false, true, false}), palette::motion, cv::Rect(340, 200, 300, 140)) == 0);
}

static void trails_lie_where_the_feet_were_and_move_with_the_camera() {
    const auto run = [](const std::optional<Affine> &motion) {
        Annotator annotator({});
        cv::Mat image;
        for (int i = 0; i < 20; ++i) {
            image = blank();
            annotator.draw(image, "", {track(5, {300.0 + 10 * i, 200, 20, 100}, Look::strong)}, motion);
        }
        return image;
    };
    const cv::Mat still = run(std::nullopt);
    for (const double x : {330.0, 400.0, 470.0}) CHECK(shows(at(still, x, 300), identity_colour(5)));
    CHECK(at(still, 295, 300) == ground);
    // The camera goes down by 2 pixels per frame: older places are higher up by twice their age.
    const cv::Mat panned = run(Affine{1, 0, 0, 0, 1, -2});
    CHECK(count(panned, identity_colour(5), cv::Rect(398, 276, 5, 10)) > 0);
    CHECK(count(panned, identity_colour(5), cv::Rect(398, 290, 5, 20)) == 0);
}

static void boxes_without_an_image_are_tinted() {
    const cv::Vec3b inside = at(drawn({track(7, place, Look::strong)}, {false, false, true}), 330, 270);
    for (int i = 0; i < 3; ++i) {
        CHECK(std::abs(inside[i] - (0.7 * ground[i] + 0.3 * identity_colour(7)[i])) <= 1.5);
    }
}

static void labels_avoid_each_other_and_grow_with_the_picture() {
    cv::Mat image = blank();
    Labels labels(image);
    const cv::Scalar first(1, 2, 3), second(3, 2, 1);
    labels.add(place, "123", first, 0.5);
    const long alone = count(image, first);
    labels.add(place + cv::Point2d(3, 3), "456", second, 0.5);
    CHECK(count(image, first) == alone && std::abs(count(image, second) - alone) < alone / 4);
    // A box at the very top has its label inside the picture; one outside has none.
    cv::Mat top = blank();
    Labels(top).add({300, 0, 60, 150}, "123", first, 0.5);
    CHECK(count(top, first) == alone);
    cv::Mat outside = blank();
    Labels(outside).add({-300, 0, 60, 150}, "123", first, 0.5);
    CHECK(count(outside, first) == 0);
    CHECK(scale_of(blank()) == 1.0 && scale_of(blank({320, 240})) == 1.0);
    CHECK(scale_of(blank({1536, 1152})) == 2.0);
    CHECK(plate_size("123", 1.0).height > 3 * plate_size("123", 0.5).height / 2);
}

static void the_legend_names_the_layers_that_are_drawn() {
    const cv::Rect foot(0, 556, 768, 20);
    const cv::Mat plain = drawn({}), all = drawn({}, {true, true, false});
    CHECK(count(plain, palette::strong, foot) > 20 && count(plain, palette::weak, foot) > 20);
    CHECK(count(plain, palette::motion, foot) == 0 && count(all, palette::motion, foot) > 20);
    CHECK(count(all, palette::neighbours, foot) > 20 && count(plain, palette::neighbours, foot) == 0);
    // In small pictures it has more rows.
    cv::Mat small = blank({200, 150});
    Annotator({true, true, false}).draw(small, "", {}, std::nullopt);
    CHECK(count(small, palette::motion) > 5);
}

static void hostile_boxes_do_no_harm() {
    std::vector<DrawnTrack> tracks;
    for (const Look look : {Look::strong, Look::weak, Look::lost, Look::tentative}) {
        for (const cv::Rect2d &box : {cv::Rect2d(-1e11, -1e11, 2e11, 2e11), cv::Rect2d(1e12, 0, 0, 0),
                                      cv::Rect2d(5, 5, 0, 0), cv::Rect2d(-20, 570, 40, 40)}) {
            tracks.push_back(track(tracks.size() + 1, box, look));
            tracks.back().particles = {{box, 0.5}};
            tracks.back().neighbours = {{1}, 1, {1e9, -1e9}, "with them", true};
        }
    }
    CHECK(!drawn(tracks, {true, true, true}).empty());
}

int main() {
    each_look_has_its_line();
    what_is_in_focus_is_bold();
    particles_are_drawn_the_fitter_the_brighter();
    neighbours_and_their_motion();
    trails_lie_where_the_feet_were_and_move_with_the_camera();
    boxes_without_an_image_are_tinted();
    labels_avoid_each_other_and_grow_with_the_picture();
    the_legend_names_the_layers_that_are_drawn();
    hostile_boxes_do_no_harm();
}
