// gentrack2_opencv.hpp: views say what the matrix is, and the library accepts them.
#include "gentrack2_opencv.hpp"

#include <cstdio>
#include <cstdlib>
#include <opencv2/core.hpp>

unsigned format_of_grey();

static void check(bool holds, const char *what, int line) {
    if (holds) return;
    std::fprintf(stderr, "line %d: %s\n", line, what);
    std::exit(1);
}
#define CHECK(what) check((what), #what, __LINE__)

static std::string refusal(const cv::Mat &mat) {
    try {
        gentrack2::image(mat);
    } catch (const std::invalid_argument &error) {
        return error.what();
    }
    return "";
}

static void test_views() {
    const cv::Mat whole(40, 60, CV_8UC3);
    const gt2_image all = gentrack2::image(whole);
    CHECK(all.struct_size == sizeof(gt2_image) && all.data == whole.data && all.stride == 180);
    CHECK(all.width == 60 && all.height == 40 && all.format == GT2_PIXEL_BGR24);
    // A region of interest starts at row 5, column 7, and keeps the stride of the whole.
    const gt2_image part = gentrack2::image(whole(cv::Rect(7, 5, 20, 10)));
    CHECK(part.data == whole.data + 5 * 180 + 7 * 3 && part.stride == 180 && part.width == 20 && part.height == 10);
    CHECK(gentrack2::image(cv::Mat(2, 3, CV_8UC4)).format == GT2_PIXEL_BGRA32);
    CHECK(format_of_grey() == GT2_PIXEL_GRAY8);
}

static void test_refusals() {
    CHECK(refusal(cv::Mat()).find("empty") != std::string::npos);
    for (const int type : {CV_8UC2, CV_8SC1, CV_16UC1, CV_32FC3, CV_64FC1}) {
        CHECK(refusal(cv::Mat::zeros(4, 4, type)).find("must be CV_8UC1") != std::string::npos);
    }
    const int sizes[] = {4, 4, 4};
    CHECK(refusal(cv::Mat(3, sizes, CV_8UC1)).find("3 dimensions") != std::string::npos);
}

static void test_boxes() {
    const gt2_detection d = gentrack2::detection(cv::Rect2f(1.5f, -2.0f, 3.25f, 4.0f), 0.75, 3, 99);
    CHECK(d.left == 1.5 && d.top == -2.0 && d.width == 3.25 && d.height == 4.0 && d.score == 0.75);
    CHECK(d.class_id == 3 && d.tag == 99 && d.reserved == 0);
    CHECK(gentrack2::detection(cv::Rect(1, 2, 3, 4), 1.0).height == 4.0);
    CHECK(gentrack2::rect(d) == cv::Rect2d(1.5, -2.0, 3.25, 4.0));
    CHECK(gentrack2::rect<float>(d) == cv::Rect2f(1.5f, -2.0f, 3.25f, 4.0f));
}

/// Steps a tracker with a region of interest and checks that the box comes back.
static void test_step() {
    gt2_config *config = nullptr;
    gt2_tracker *tracker = nullptr;
    CHECK(gt2_config_new("gentrack2", &config) == GT2_OK && gt2_tracker_new(config, &tracker) == GT2_OK);
    gt2_config_free(config);
    cv::Mat whole(240, 320, CV_8UC3);
    cv::randu(whole, 0, 256);
    const gt2_image image = gentrack2::image(whole(cv::Rect(10, 10, 300, 220)));
    const cv::Rect2d box(100, 60, 40, 80);
    const gt2_detection detection = gentrack2::detection(box, 0.95);
    gt2_frame frame = GT2_FRAME_INIT;
    frame.detections = &detection;
    frame.detection_count = 1;
    frame.image = &image;
    for (int i = 0; i < 5; ++i) CHECK(gt2_tracker_step(tracker, &frame) == GT2_OK);
    gt2_track_list list = GT2_TRACK_LIST_INIT;
    CHECK(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list) == GT2_OK && list.count == 1);
    const cv::Rect2d found = gentrack2::rect(*gt2_track_at(&list, 0));
    CHECK((found & box).area() > 0.9 * (found | box).area());
    gt2_tracker_free(tracker);
}

int main() {
    test_views();
    test_refusals();
    test_boxes();
    test_step();
    std::puts("ok");
}
