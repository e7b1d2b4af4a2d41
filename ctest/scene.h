/* A small scene for the tests, and what several of them do with trackers. */
#ifndef SCENE_H
#define SCENE_H

#include <math.h>
#include <stdlib.h>

#include "check.h"

enum { SCENE_OBJECTS = 3, SCENE_WIDTH = 640, SCENE_HEIGHT = 480, SCENE_DIMENSION = 4 };

/* One frame with everything a caller can give, in memory of its own. */
typedef struct scene {
    gt2_detection detections[SCENE_OBJECTS];
    float embeddings[SCENE_OBJECTS * SCENE_DIMENSION];
    uint8_t pixels[SCENE_WIDTH * SCENE_HEIGHT];
    double camera_motion[6];
    gt2_image image;
    gt2_frame frame;
} scene;

static inline gt2_detection scene_detection(double left, double top, double width, double height) {
    gt2_detection d;
    memset(&d, 0, sizeof d);
    d.left = left;
    d.top = top;
    d.width = width;
    d.height = height;
    d.score = 0.9;
    return d;
}

/* Fills in frame `t` (from 0) of three objects that move to the right on rows of their own, 3 pixels a frame. */
static inline void scene_fill(scene *s, int t) {
    const gt2_frame frame = GT2_FRAME_INIT;
    const gt2_image image = GT2_IMAGE_INIT;
    const double still[6] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    for (int i = 0; i < SCENE_OBJECTS; i++) {
        s->detections[i] = scene_detection(50.0 + 3.0 * t, 40.0 + 140.0 * i, 40.0, 90.0);
        s->detections[i].class_id = 10 + i;
        s->detections[i].tag = (uint64_t)(1000 * t + i);
        for (int k = 0; k < SCENE_DIMENSION; k++) {
            s->embeddings[i * SCENE_DIMENSION + k] = k == i ? 1.0f : 0.0f;
        }
    }
    for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
        s->pixels[i] = (uint8_t)((i * 31) % 251);
    }
    memcpy(s->camera_motion, still, sizeof still);
    s->image = image;
    s->image.data = s->pixels;
    s->image.width = SCENE_WIDTH;
    s->image.height = SCENE_HEIGHT;
    s->frame = frame;
    s->frame.detections = s->detections;
    s->frame.detection_count = SCENE_OBJECTS;
    s->frame.embeddings = s->embeddings;
    s->frame.embedding_dimension = SCENE_DIMENSION;
    s->frame.image = &s->image;
    s->frame.camera_motion = s->camera_motion;
    s->frame.timestamp_ns = (int64_t)(t + 1) * 33333333;
    s->frame.has_timestamp = 1;
}

static inline gt2_config *new_config(void) {
    gt2_config *config = NULL;
    CHECK_OK(gt2_config_new("gentrack2", &config));
    return config;
}

static inline gt2_tracker *new_tracker(void) {
    gt2_config *config = new_config();
    gt2_tracker *tracker = NULL;
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    return tracker;
}

static inline gt2_track_list tracks_of(const gt2_tracker *tracker, int32_t kind) {
    gt2_track_list list = GT2_TRACK_LIST_INIT;
    CHECK_OK(gt2_tracker_tracks(tracker, kind, &list));
    return list;
}

/* A copy of all tracks of a kind, to be freed. */
static inline gt2_track *copy_of(const gt2_tracker *tracker, int32_t kind, size_t *count) {
    CHECK_OK(gt2_tracker_copy_tracks(tracker, kind, NULL, 0, 0, count));
    gt2_track *tracks = (gt2_track *)calloc(*count + 1, sizeof *tracks);
    CHECK_OK(gt2_tracker_copy_tracks(tracker, kind, tracks, sizeof *tracks, *count + 1, count));
    return tracks;
}

static inline int same_ids(gt2_status (*list)(const gt2_tracker *, const uint64_t **, size_t *), const gt2_tracker *a,
                           const gt2_tracker *b) {
    const uint64_t *ids_a = NULL, *ids_b = NULL;
    size_t count_a = 0, count_b = 0;
    CHECK_OK(list(a, &ids_a, &count_a));
    CHECK_OK(list(b, &ids_b, &count_b));
    return count_a == count_b && (count_a == 0 || memcmp(ids_a, ids_b, count_a * sizeof *ids_a) == 0);
}

/* Whether two trackers give the same results, to the last bit. */
static inline int same_results(const gt2_tracker *a, const gt2_tracker *b) {
    int same = same_ids(gt2_tracker_ended, a, b) && same_ids(gt2_tracker_track_of_detection, a, b);
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        size_t count_a = 0, count_b = 0;
        gt2_track *tracks_a = copy_of(a, kind, &count_a), *tracks_b = copy_of(b, kind, &count_b);
        /* The struct has no padding, so its bytes can be compared. */
        same = same && count_a == count_b && memcmp(tracks_a, tracks_b, count_a * sizeof *tracks_a) == 0;
        free(tracks_a);
        free(tracks_b);
    }
    return same;
}

static inline int all_finite(const gt2_tracker *tracker) {
    int finite = 1;
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        const gt2_track_list list = tracks_of(tracker, kind);
        for (size_t i = 0; i < list.count; i++) {
            const gt2_track *t = gt2_track_at(&list, i);
            finite = finite && isfinite(t->left) && isfinite(t->top) && isfinite(t->width) && isfinite(t->height) &&
                     isfinite(t->velocity_u) && isfinite(t->velocity_v) && isfinite(t->velocity_w) &&
                     isfinite(t->velocity_h) && t->width >= 0.0 && t->height >= 0.0;
        }
    }
    return finite;
}

#endif
