/* The rules of the interface, for frames: what is refused, how it is said, and that a refusal leaves no trace: a
 * tracker that saw the bad call gives, to the last bit, what its twin gives that never saw it. */
#include "scene.h"

typedef struct bad_frame {
    const char *name;
    void (*spoil)(scene *);
    gt2_status status;
    const char *message;
} bad_frame;

#define SPOIL(name, statement) \
    static void name(scene *s) { statement; }

SPOIL(left_nan, s->detections[1].left = NAN)
SPOIL(top_infinite, s->detections[2].top = INFINITY)
SPOIL(width_negative, s->detections[0].width = -2.0)
SPOIL(height_infinite, s->detections[1].height = -INFINITY)
SPOIL(left_huge, s->detections[1].left = 1e13)
SPOIL(score_above, s->detections[2].score = 1.0000001)
SPOIL(score_below, s->detections[2].score = -1e-9)
SPOIL(score_nan, s->detections[2].score = NAN)
SPOIL(detection_reserved, s->detections[1].reserved = 1)
SPOIL(detections_null, s->frame.detections = NULL)
SPOIL(detections_too_many, s->frame.detection_count = 32769)
SPOIL(detections_absurd, s->frame.detection_count = SIZE_MAX)
SPOIL(detection_stride_short, s->frame.detection_stride = sizeof(gt2_detection) - 1)
SPOIL(detection_stride_absurd, s->frame.detection_stride = SIZE_MAX / 2)
SPOIL(image_data_null, s->image.data = NULL)
SPOIL(image_stride_short, s->image.stride = SCENE_WIDTH - 1)
SPOIL(image_stride_absurd, s->image.stride = SIZE_MAX / 2)
SPOIL(image_format_unknown, s->image.format = 99)
SPOIL(image_width_zero, s->image.width = 0)
SPOIL(image_height_zero, s->image.height = 0)
SPOIL(image_width_huge, s->image.width = 65536)
SPOIL(image_reserved, s->image.reserved = 1)
SPOIL(image_struct_size, s->image.struct_size = 5000)
SPOIL(embeddings_null, s->frame.embeddings = NULL)
SPOIL(embedding_dimension_zero, s->frame.embedding_dimension = 0)
SPOIL(embedding_dimension_changed, s->frame.embedding_dimension = 3)
SPOIL(embedding_dimension_absurd, s->frame.embedding_dimension = SIZE_MAX)
SPOIL(embedding_stride_short, s->frame.embedding_stride = 3)
SPOIL(embedding_stride_absurd, s->frame.embedding_stride = SIZE_MAX / 2)
SPOIL(embedding_nan, s->embeddings[9] = NAN)
SPOIL(embeddings_misaligned, s->frame.embeddings = (const float *)(const void *)((const char *)s->embeddings + 1))
SPOIL(motion_nan, s->camera_motion[2] = NAN)
SPOIL(motion_zero, memset(s->camera_motion, 0, sizeof s->camera_motion))
SPOIL(motion_singular, s->camera_motion[0] = s->camera_motion[1] = s->camera_motion[3] = 1.0)
SPOIL(time_backwards, s->frame.timestamp_ns = 1)
SPOIL(time_standing, s->frame.timestamp_ns -= 33333333)
SPOIL(time_flag, s->frame.has_timestamp = 2)
SPOIL(skipped_flag, s->frame.detector_skipped = -1)
SPOIL(skipped_with_detections, s->frame.detector_skipped = 1)
SPOIL(size_differs, s->frame.image_width = 100; s->frame.image_height = 100)
SPOIL(size_half_given, s->frame.image_width = SCENE_WIDTH)
SPOIL(struct_size_tiny, s->frame.struct_size = sizeof(size_t) - 1)
SPOIL(struct_size_huge, s->frame.struct_size = SIZE_MAX)

static const bad_frame bad_frames[] = {
    {"left_nan", left_nan, GT2_ERR_DETECTION, "detections[1].left: is NaN"},
    {"top_infinite", top_infinite, GT2_ERR_DETECTION, "detections[2].top: is inf"},
    {"width_negative", width_negative, GT2_ERR_DETECTION, "detections[0].width: is -2, must not be negative"},
    {"height_infinite", height_infinite, GT2_ERR_DETECTION, "detections[1].height: "},
    {"left_huge", left_huge, GT2_ERR_DETECTION, "detections[1].left: "},
    {"score_above", score_above, GT2_ERR_DETECTION, "detections[2].score: is 1.0000001, must be in 0..=1"},
    {"score_below", score_below, GT2_ERR_DETECTION, "detections[2].score: "},
    {"score_nan", score_nan, GT2_ERR_DETECTION, "detections[2].score: "},
    {"detection_reserved", detection_reserved, GT2_ERR_DETECTION, "detections[1].reserved: "},
    {"detections_null", detections_null, GT2_ERR_NULL_POINTER, "frame.detections is NULL"},
    {"detections_too_many", detections_too_many, GT2_ERR_LIMIT, "detections: 32769 exceeds the limit of 32768"},
    {"detections_absurd", detections_absurd, GT2_ERR_LIMIT, "max_detections"},
    {"detection_stride_short", detection_stride_short, GT2_ERR_INVALID_ARGUMENT, "frame.detection_stride: "},
    {"detection_stride_absurd", detection_stride_absurd, GT2_ERR_INVALID_ARGUMENT, "frame.detection_stride: "},
    {"image_data_null", image_data_null, GT2_ERR_NULL_POINTER, "image.data is NULL"},
    {"image_stride_short", image_stride_short, GT2_ERR_IMAGE, "image.stride: is 639 bytes"},
    {"image_stride_absurd", image_stride_absurd, GT2_ERR_IMAGE, "image.stride: "},
    {"image_format_unknown", image_format_unknown, GT2_ERR_IMAGE, "image.format: is 99"},
    {"image_width_zero", image_width_zero, GT2_ERR_IMAGE, "image.width: is 0"},
    {"image_height_zero", image_height_zero, GT2_ERR_IMAGE, "image.height: is 0"},
    {"image_width_huge", image_width_huge, GT2_ERR_IMAGE, "image.width: is 65536"},
    {"image_reserved", image_reserved, GT2_ERR_IMAGE, "image.reserved: "},
    {"image_struct_size", image_struct_size, GT2_ERR_STRUCT_SIZE, "image.struct_size: is 5000"},
    {"embeddings_null", embeddings_null, GT2_ERR_NULL_POINTER, "frame.embeddings is NULL"},
    {"embedding_dimension_zero", embedding_dimension_zero, GT2_ERR_EMBEDDINGS, "frame.embedding_dimension: is 0"},
    {"embedding_dimension_changed", embedding_dimension_changed, GT2_ERR_EMBEDDINGS,
     "frame.embedding_dimension: is 3, earlier frames had 4"},
    {"embedding_dimension_absurd", embedding_dimension_absurd, GT2_ERR_LIMIT, "frame.embedding_dimension: "},
    {"embedding_stride_short", embedding_stride_short, GT2_ERR_EMBEDDINGS, "frame.embedding_stride: is 3"},
    {"embedding_stride_absurd", embedding_stride_absurd, GT2_ERR_INVALID_ARGUMENT, "embedding"},
    {"embedding_nan", embedding_nan, GT2_ERR_EMBEDDINGS, "frame.embeddings: row 2: component 1 is "},
    {"embeddings_misaligned", embeddings_misaligned, GT2_ERR_INVALID_ARGUMENT, "frame.embeddings is not aligned"},
    {"motion_nan", motion_nan, GT2_ERR_CAMERA_MOTION, "camera_motion: element 2 is NaN"},
    {"motion_zero", motion_zero, GT2_ERR_CAMERA_MOTION, "camera_motion: "},
    {"motion_singular", motion_singular, GT2_ERR_CAMERA_MOTION, "camera_motion: "},
    {"time_backwards", time_backwards, GT2_ERR_TIMESTAMP, "timestamp_ns: is 1, must be greater"},
    {"time_standing", time_standing, GT2_ERR_TIMESTAMP, "timestamp_ns: "},
    {"time_flag", time_flag, GT2_ERR_INVALID_ARGUMENT, "frame.has_timestamp: is 2"},
    {"skipped_flag", skipped_flag, GT2_ERR_INVALID_ARGUMENT, "frame.detector_skipped: is -1"},
    {"skipped_with_detections", skipped_with_detections, GT2_ERR_FRAME, "detector_skipped"},
    {"size_differs", size_differs, GT2_ERR_FRAME, "frame.image_width and image_height: are 100x100, the image is 640x480"},
    {"size_half_given", size_half_given, GT2_ERR_FRAME, "frame.image_height: is 0"},
    {"struct_size_tiny", struct_size_tiny, GT2_ERR_STRUCT_SIZE, "frame.struct_size: is "},
    {"struct_size_huge", struct_size_huge, GT2_ERR_STRUCT_SIZE, "frame.struct_size: "},
};

static void a_refused_frame_leaves_no_trace(void) {
    gt2_tracker *tracker = new_tracker(), *twin = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    const int count = (int)(sizeof bad_frames / sizeof bad_frames[0]);
    int t = 0;
    for (int i = 0; i < count; i++) {
        for (int good = 0; good < 2; good++, t++) {
            scene_fill(s, t);
            CHECK_OK(gt2_tracker_step(tracker, &s->frame));
            CHECK_OK(gt2_tracker_step(twin, &s->frame));
        }
        const int failures = check_failures;
        const gt2_track_list before = tracks_of(tracker, GT2_TRACKS_REPORTED);
        scene_fill(s, t);
        bad_frames[i].spoil(s);
        CHECK_STATUS(gt2_tracker_step(tracker, &s->frame), bad_frames[i].status);
        CHECK_MESSAGE(bad_frames[i].message);
        CHECK_STATUS(gt2_tracker_step(tracker, NULL), GT2_ERR_NULL_POINTER);
        CHECK(same_results(tracker, twin));
        /* Lists borrowed before are still good. */
        const gt2_track_list after = tracks_of(tracker, GT2_TRACKS_REPORTED);
        CHECK(after.tracks == before.tracks && after.count == before.count);
        scene_fill(s, t++);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        CHECK_OK(gt2_tracker_step(twin, &s->frame));
        CHECK(same_results(tracker, twin));
        CHECK(tracks_of(tracker, GT2_TRACKS_REPORTED).count == SCENE_OBJECTS);
        if (check_failures > failures) {
            fprintf(stderr, "... with the frame %s\n", bad_frames[i].name);
        }
    }
    free(s);
    gt2_tracker_free(tracker);
    gt2_tracker_free(twin);
}

/* A struct of a newer header: the frame and a field that this library does not know. */
typedef struct newer_frame {
    gt2_frame frame;
    uint64_t unknown;
} newer_frame;

static void structs_of_other_headers(void) {
    gt2_tracker *tracker = new_tracker(), *twin = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    newer_frame newer;
    for (int t = 0; t < 4; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(twin, &s->frame));
        newer.frame = s->frame;
        newer.frame.struct_size = sizeof newer;
        newer.unknown = 1;
        CHECK_STATUS(gt2_tracker_step(tracker, &newer.frame), GT2_ERR_STRUCT_SIZE);
        CHECK_MESSAGE("frame: byte ");
        newer.unknown = 0;
        CHECK_OK(gt2_tracker_step(tracker, &newer.frame));
        CHECK(same_results(tracker, twin));
    }
    CHECK_OK(gt2_tracker_reset(tracker));
    CHECK_OK(gt2_tracker_reset(twin));
    for (int t = 0; t < 4; t++) {
        /* An older header that ended before the embeddings: what comes after is not looked at. */
        scene_fill(s, t);
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = s->detections;
        frame.detection_count = SCENE_OBJECTS;
        CHECK_OK(gt2_tracker_step(twin, &frame));
        frame = s->frame;
        frame.struct_size = offsetof(gt2_frame, embeddings);
        frame.embeddings = (const float *)(const void *)"garbage";
        frame.has_timestamp = 77;
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        CHECK(same_results(tracker, twin));
    }
    /* All zero means the default: a frame without anything. A size of 0 means the first layout. */
    gt2_frame zero;
    memset(&zero, 0, sizeof zero);
    CHECK_OK(gt2_tracker_step(tracker, &zero));
    const gt2_frame empty = GT2_FRAME_INIT;
    CHECK_OK(gt2_tracker_step(twin, &empty));
    CHECK(same_results(tracker, twin));
    scene_fill(s, 5);
    CHECK_OK(gt2_tracker_step(twin, &s->frame));
    s->frame.struct_size = 0;
    s->image.struct_size = 0;
    s->frame.detection_stride = 0;
    CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    CHECK(same_results(tracker, twin));
    free(s);
    gt2_tracker_free(tracker);
    gt2_tracker_free(twin);
}

/* A caller's own struct that begins with a detection. */
typedef struct own_detection {
    gt2_detection detection;
    char name[11];
    double depth;
} own_detection;

static void strides(void) {
    gt2_tracker *tracker = new_tracker(), *twin = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    own_detection own[SCENE_OBJECTS];
    float spaced[SCENE_OBJECTS * 6];
    uint8_t *padded = (uint8_t *)malloc((SCENE_WIDTH + 24) * SCENE_HEIGHT);
    memset(own, 0xff, sizeof own);
    memset(spaced, 0xff, sizeof spaced);
    memset(padded, 0xaa, (SCENE_WIDTH + 24) * SCENE_HEIGHT);
    for (int t = 0; t < 5; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(twin, &s->frame));
        for (int i = 0; i < SCENE_OBJECTS; i++) {
            own[i].detection = s->detections[i];
            memcpy(&spaced[6 * i], &s->embeddings[SCENE_DIMENSION * i], SCENE_DIMENSION * sizeof spaced[0]);
        }
        for (int y = 0; y < SCENE_HEIGHT; y++) {
            memcpy(padded + (SCENE_WIDTH + 24) * y, s->pixels + SCENE_WIDTH * y, SCENE_WIDTH);
        }
        s->frame.detections = &own[0].detection;
        s->frame.detection_stride = sizeof own[0];
        s->frame.embeddings = spaced;
        s->frame.embedding_stride = 6;
        s->image.data = padded;
        s->image.stride = SCENE_WIDTH + 24;
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        CHECK(same_results(tracker, twin));
    }
    free(padded);
    free(s);
    gt2_tracker_free(tracker);
    gt2_tracker_free(twin);
}

/* Strange, but legal. */
static void extremes(void) {
    enum { MANY = 20000 };
    gt2_tracker *tracker = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    gt2_detection *many = (gt2_detection *)calloc(MANY, sizeof *many);
    const uint64_t *ids = NULL;
    size_t count = 0;
    for (int t = 0; t < 12; t++) {
        scene_fill(s, t);
        s->detections[0].left = t % 2 == 0 ? 1e9 : -1e9; /* far outside, and jumping */
        s->detections[1].width = 0.0;
        s->detections[2].height = 1e9;
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        CHECK(all_finite(tracker));
    }
    /* No detections at all, with and without arrays. */
    scene_fill(s, 20);
    s->frame.detection_count = 0;
    CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    CHECK_OK(gt2_tracker_track_of_detection(tracker, &ids, &count));
    CHECK(ids == NULL && count == 0);
    scene_fill(s, 21);
    s->frame.detection_count = 0;
    s->frame.detections = NULL;
    s->frame.embeddings = NULL;
    CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    /* An image of one pixel, and none of the optional things. */
    gt2_frame frame = GT2_FRAME_INIT;
    gt2_image image = GT2_IMAGE_INIT;
    image.data = s->pixels;
    image.width = image.height = 1;
    frame.image = &image;
    frame.detections = s->detections;
    frame.detection_count = SCENE_OBJECTS;
    CHECK_OK(gt2_tracker_step(tracker, &frame));
    CHECK(all_finite(tracker));
    /* A field of 20 000 boxes. */
    CHECK_OK(gt2_tracker_reset(tracker));
    frame.image = NULL;
    for (int t = 0; t < 3; t++) {
        for (int i = 0; i < MANY; i++) {
            many[i] = scene_detection(30.0 * (i % 200) + t, 60.0 * (double)(i / 200), 20.0, 50.0);
        }
        frame.detections = many;
        frame.detection_count = MANY;
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        CHECK_OK(gt2_tracker_track_of_detection(tracker, &ids, &count));
        CHECK(count == MANY);
        CHECK(all_finite(tracker));
    }
    free(many);
    free(s);
    gt2_tracker_free(tracker);
}

int main(void) {
    a_refused_frame_leaves_no_trace();
    structs_of_other_headers();
    strides();
    extremes();
    return check_result();
}
