// Identity switches in scenes where they are known, and how they are marked.
#include "identity_switches.hpp"

#include <cstdio>
#include <fstream>
#include <numeric>
#include <opencv2/core.hpp>
#include <random>
#include <string>

#include "best_pairs.hpp"
#include "checks.hpp"
#include "palette.hpp"
#include "switch_marks.hpp"
#include "text.hpp"

using namespace examples;

static cv::Rect2d box_at(double x) { return {x, 100, 40, 100}; }

static TrueBox person(std::uint64_t object, double x) { return {object, box_at(x), true, false}; }

static TrackedBox tracked(std::uint64_t id, double x) { return {id, box_at(x)}; }

static double best_sum(const cv::Mat1d &scores) {
    // All orders of the longer side.
    const cv::Mat1d s = scores.rows <= scores.cols ? scores : cv::Mat1d(scores.t());
    std::vector<int> order(s.cols);
    std::iota(order.begin(), order.end(), 0);
    double best = 0;
    do {
        double sum = 0;
        for (int row = 0; row < s.rows; ++row) sum += s(row, order[row]);
        best = std::max(best, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

static void pairs_are_the_best() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> score(0.0, 1.0);
    for (int round = 0; round < 300; ++round) {
        cv::Mat1d scores(1 + round % 5, 1 + round / 5 % 6);
        for (double &s : scores) s = score(random) < 0.4 ? 0.0 : score(random) + (score(random) < 0.2 ? 1000 : 0);
        const auto columns = best_pairs(scores);
        std::vector<int> used(scores.cols, 0);
        double sum = 0;
        for (int row = 0; row < scores.rows; ++row) {
            if (columns[row] < 0) continue;
            CHECK(scores(row, columns[row]) > 0 && ++used[columns[row]] == 1);
            sum += scores(row, columns[row]);
        }
        CHECK(std::abs(sum - best_sum(scores)) < 1e-9);
    }
    CHECK(best_pairs(cv::Mat1d(0, 3)).empty());
    CHECK(best_pairs(cv::Mat1d(2, 0)) == std::vector<int>({-1, -1}));
}

static void two_who_swap_are_two_switches() {
    IdentitySwitches switches;
    CHECK(switches.add({person(1, 0), person(2, 200)}, {tracked(7, 0), tracked(8, 200)}).empty());
    const auto swapped = switches.add({person(1, 0), person(2, 200)}, {tracked(8, 0), tracked(7, 200)});
    CHECK(swapped.size() == 2 && switches.count() == 2);
    CHECK(swapped[0].object == 1 && swapped[0].before == 7 && swapped[0].now == 8);
    CHECK(swapped[1].object == 2 && swapped[1].before == 8 && swapped[1].now == 7);
    CHECK(switches.add({person(1, 0), person(2, 200)}, {tracked(8, 0), tracked(7, 200)}).empty());
}

static void a_gap_is_no_switch_but_another_track_after_it_is() {
    IdentitySwitches switches;
    switches.add({person(1, 0)}, {tracked(7, 0)});
    CHECK(switches.add({person(1, 0)}, {}).empty());
    CHECK(switches.add({person(1, 0)}, {tracked(7, 2)}).empty());
    CHECK(switches.add({}, {tracked(7, 2)}).empty());
    CHECK(switches.add({person(1, 0)}, {tracked(9, 300)}).empty());
    CHECK(switches.add({person(1, 0)}, {tracked(9, 0)}).size() == 1);
}

static void pairs_need_half_of_the_union() {
    // 40 wide and moved by d: the IoU is (40 - d) / (40 + d), which is .5 at 40 / 3.
    IdentitySwitches switches;
    switches.add({person(1, 0)}, {tracked(7, 0)});
    CHECK(switches.add({person(1, 0)}, {tracked(8, 13.4)}).empty());
    CHECK(switches.add({person(1, 0)}, {tracked(8, 13.3)}).size() == 1);
}

static void the_pair_of_the_frame_before_has_precedence() {
    // Track 8 is nearer, but 7 still reaches.
    IdentitySwitches switches;
    switches.add({person(1, 0)}, {tracked(7, 0)});
    CHECK(switches.add({person(1, 0)}, {tracked(8, 0), tracked(7, 10)}).empty());
    // After a frame in which somebody else was matched alone, the nearest counts.
    switches.add({person(1, 0), person(2, 500)}, {tracked(9, 500)});
    CHECK(switches.add({person(1, 0)}, {tracked(8, 0), tracked(7, 10)}).size() == 1);
}

static void distractors_and_what_does_not_count() {
    const TrueBox statue{5, box_at(0), false, true}, ignored{6, box_at(400), false, false};
    IdentitySwitches switches;
    switches.add({statue, ignored, person(1, 8)}, {tracked(7, 0), tracked(8, 400), tracked(9, 8)});
    // Track 7 is on the statue, so that nobody is left for the person.
    CHECK(switches.add({statue, ignored, person(1, 8)}, {tracked(7, 0), tracked(3, 400)}).empty());
    CHECK(switches.add({ignored, person(1, 8)}, {tracked(7, 0), tracked(3, 400)}).size() == 1);
}

static long marked(const SwitchMarks &marks) {
    cv::Mat image(576, 768, CV_8UC3, cv::Scalar::all(100)), found;
    marks.draw(image);
    cv::inRange(image, palette::identity_switch, palette::identity_switch, found);
    return cv::countNonZero(found);
}

static void a_switch_is_marked_for_a_second() {
    SwitchMarks marks(10);
    marks.add({person(1, 300)}, {tracked(7, 300)});
    CHECK(!marks.active() && marked(marks) == 0);
    for (int frame = 0; frame < 10; ++frame) {
        marks.add({person(1, 300.0 + frame)}, {tracked(8, 300.0 + frame)});
        CHECK(marks.active() && marks.count() == 1 && marked(marks) > 500);
        // At the end it is close around the box, and moves with it: 5 px to the left of it.
        cv::Mat image(576, 768, CV_8UC3, cv::Scalar::all(100));
        marks.draw(image);
        const bool close = image.at<cv::Vec3b>(150, 295 + frame) == cv::Vec3b(255, 60, 255);
        CHECK(close == (frame >= 4));
    }
    marks.add({person(1, 310)}, {tracked(8, 310)});
    CHECK(!marks.active() && marks.count() == 1 && marked(marks) == 0);
}

static GroundTruth truth_of(const std::string &rows) {
    const std::string path = "identity_switches_test.txt";
    std::ofstream(path) << rows;
    return read_ground_truth(path);
}

static std::string refusal(const std::string &rows) {
    try {
        truth_of(rows);
    } catch (const UserError &error) {
        return error.what();
    }
    return "";
}

static void ground_truth_of_each_format() {
    auto truth = truth_of(
        "1,3,10,20,30,40\n1,4,10,20,30,40,0,1,1\n\n2,3,10,20,30,40,1,7,0.5\n2,5,10,20,30,40,1,3,0.5\n"
        "3,9,10.5,20,30,40,1,7,-7.3,0\n");
    CHECK(truth.size() == 3 && truth[1].size() == 2);
    CHECK(truth[1][0].object == 3 && truth[1][0].box == cv::Rect2d(10, 20, 30, 40) && truth[1][0].counts);
    CHECK(!truth[1][1].counts && !truth[1][1].distractor);
    CHECK(!truth[2][0].counts && truth[2][0].distractor && !truth[2][1].counts && !truth[2][1].distractor);
    // MOT15 has places in the world where others have classes.
    CHECK(truth[3][0].counts && !truth[3][0].distractor);
    const auto refused = [](const std::string &rows, const char *why) {
        return refusal(rows).find(why) != std::string::npos;
    };
    CHECK(refused("1,3,10,20,30,40\n1,x,10,20,30,40\n", ":2: id \"x\" is not a finite number"));
    CHECK(refused("1,1.5,10,20,30,40\n", ":1: id \"1.5\" is not an integer"));
    CHECK(refused("0,1,10,20,30,40\n", ":1: frame \"0\""));
    CHECK(refused("1,1,10,20,30\n", ":1: expected at least 6 fields"));
    CHECK(refused("1,1,10,20,30,40,1,z,1\n", ":1: class \"z\""));
    CHECK(refused("1,1,10,20,30,40,1,1.5,1\n", ":1: class \"1.5\" is not an integer"));
    CHECK(refused("1,1,10,20,30,40,1,1e300,1\n", ":1: class \"1e300\" is not an integer"));
}

int main() {
    pairs_are_the_best();
    two_who_swap_are_two_switches();
    a_gap_is_no_switch_but_another_track_after_it_is();
    pairs_need_half_of_the_union();
    the_pair_of_the_frame_before_has_precedence();
    distractors_and_what_does_not_count();
    a_switch_is_marked_for_a_second();
    ground_truth_of_each_format();
    std::remove("identity_switches_test.txt");
}
