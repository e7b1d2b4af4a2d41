/* Frames that a broken detector, camera or clock would hand in. */
#ifndef GARBAGE_H
#define GARBAGE_H

#include <math.h>

#include "../sequence.h"
#include "random.h"

/* One more than the default of max_detections, the most of an accepted frame, the same of strange ones. */
enum { BEYOND_LIMIT = 32769, CROWD = 1000, PILE = 400, SIDE = 96 };

typedef struct garbage {
    uint64_t random;
    gt2_detection detections[BEYOND_LIMIT];
    float embeddings[CROWD * DIMENSION], broken[DIMENSION];
    uint8_t pixels[SIDE * SIDE];
    double motion[6];
    gt2_image image;
} garbage;

enum { KINDS_REFUSED = 16, KINDS_ACCEPTED = 9 };

static inline void make_room_for_garbage(garbage *g, uint64_t seed) {
    memset(g, 0, sizeof *g);
    g->random = seed;
    g->broken[DIMENSION - 1] = (float)NAN;
    for (size_t i = 0; i < sizeof g->pixels; i++) {
        g->pixels[i] = (uint8_t)random_bits(&g->random);
    }
    for (size_t i = 0; i < sizeof g->embeddings / sizeof *g->embeddings; i++) {
        g->embeddings[i] = (float)random_between(&g->random, -1.0, 1.0);
    }
}

/* A crowd that stands still: the most that the tracker will be asked for. */
static inline gt2_frame crowd_frame(garbage *g) {
    gt2_frame frame = GT2_FRAME_INIT;
    for (int i = 0; i < CROWD; i++) {
        gt2_detection *d = &g->detections[i];
        memset(d, 0, sizeof *d);
        d->left = 45.0 * (i % 40);
        d->top = 110.0 * (i / 40);
        d->width = 40.0;
        d->height = 100.0;
        d->score = 0.9;
    }
    frame.detections = g->detections;
    frame.detection_count = CROWD;
    frame.embeddings = g->embeddings;
    frame.embedding_dimension = DIMENSION;
    return frame;
}

/* A copy of a frame's detections, at most PILE, that may be spoilt; there is at least one. */
static inline gt2_detection *own_detections(garbage *g, gt2_frame *frame) {
    const size_t count = frame->detection_count < PILE ? frame->detection_count : PILE;
    memcpy(g->detections, frame->detections, count * sizeof *g->detections);
    if (count == 0) {
        memset(g->detections, 0, sizeof *g->detections);
    }
    frame->detections = g->detections;
    frame->detection_count = count > 0 ? count : 1;
    frame->embeddings = NULL;
    frame->embedding_dimension = 0;
    return g->detections;
}

static inline void give_image(garbage *g, gt2_frame *frame, uint32_t width, uint32_t height) {
    const gt2_image image = GT2_IMAGE_INIT;
    g->image = image;
    g->image.data = g->pixels;
    g->image.width = width;
    g->image.height = height;
    frame->image = &g->image;
    frame->image_width = 0;
    frame->image_height = 0;
}

/* One of a frame's detections, to be spoilt. */
static inline gt2_detection *any_detection(garbage *g, gt2_frame *frame) {
    own_detections(g, frame);
    return &g->detections[random_below(&g->random, frame->detection_count)];
}

/* Spoils a good frame so that it must be refused; `now` is the time of the frame before it. Gives the status due. */
static inline gt2_status spoil(garbage *g, gt2_frame *frame, int64_t now) {
    static const double wrong_numbers[] = {NAN, INFINITY, -INFINITY, 1e13, -1e13, 1.7976931348623157e308};
    static const double singular[][6] = {
        {0, 0, 0, 0, 0, 0}, {1, 2, 0, 2, 4, 0}, {NAN, 0, 0, 0, 1, 0}, {1e4, 0, 0, 0, 1e4, 0}};
    uint64_t *random = &g->random;
    const double wrong = wrong_numbers[random_below(random, 6)];
    switch (random_below(random, KINDS_REFUSED)) {
    case 0: any_detection(g, frame)->left = wrong; return GT2_ERR_DETECTION;
    case 1: any_detection(g, frame)->top = wrong; return GT2_ERR_DETECTION;
    case 2: any_detection(g, frame)->width = wrong; return GT2_ERR_DETECTION;
    case 3: any_detection(g, frame)->height = -1e-9; return GT2_ERR_DETECTION;
    case 4: any_detection(g, frame)->score = wrong; return GT2_ERR_DETECTION;
    case 5:
        frame->has_timestamp = 1;
        frame->timestamp_ns = random_below(random, 2) ? now : now - (int64_t)random_below(random, 1000000000);
        return GT2_ERR_TIMESTAMP;
    case 6:
        frame->detections = g->detections;
        frame->detection_count = BEYOND_LIMIT;
        frame->embeddings = NULL;
        frame->embedding_dimension = 0;
        return GT2_ERR_LIMIT;
    case 7: frame->embedding_dimension = DIMENSION + 1 + random_below(random, 1000); return GT2_ERR_EMBEDDINGS;
    case 8:
        own_detections(g, frame);
        frame->detection_count = 1;
        frame->embeddings = g->broken;
        frame->embedding_dimension = DIMENSION;
        return GT2_ERR_EMBEDDINGS;
    case 9: frame->camera_motion = singular[random_below(random, 4)]; return GT2_ERR_CAMERA_MOTION;
    case 10: own_detections(g, frame); frame->detector_skipped = 1; return GT2_ERR_FRAME;
    case 11: frame->image_width = 70000; frame->image_height = 1; return GT2_ERR_FRAME;
    case 12: give_image(g, frame, 0, SIDE); return GT2_ERR_IMAGE;
    case 13: give_image(g, frame, SIDE, SIDE); g->image.stride = SIDE - 1; return GT2_ERR_IMAGE;
    case 14: give_image(g, frame, SIDE, SIDE); g->image.format = 99; return GT2_ERR_IMAGE;
    default: give_image(g, frame, SIDE, SIDE); frame->image_width = 1; frame->image_height = 1; return GT2_ERR_FRAME;
    }
}

static inline void random_boxes(garbage *g, gt2_frame *frame, size_t count, int same_place) {
    uint64_t *random = &g->random;
    own_detections(g, frame);
    for (size_t i = 0; i < count; i++) {
        gt2_detection *d = &g->detections[i];
        memset(d, 0, sizeof *d);
        d->left = same_place ? 900.0 : random_between(random, -100.0, 1900.0);
        d->top = same_place ? 400.0 : random_between(random, -100.0, 1000.0);
        d->width = same_place ? 80.0 : random_between(random, 0.0, 200.0);
        d->height = same_place ? 200.0 : random_between(random, 0.0, 400.0);
        d->score = random_between(random, 0.0, 1.0);
        d->class_id = (int32_t)random_below(random, 5);
    }
    frame->detection_count = count;
    frame->embeddings = g->embeddings;
    frame->embedding_dimension = DIMENSION;
}

/* Makes of a frame one that is strange and legal; may move the clock on. */
static inline void distort(garbage *g, gt2_frame *frame, int64_t *now) {
    static const double wild[][6] = {{1, 0, 400, 0, 1, -300}, {0.9, -0.2, 30, 0.2, 0.9, 4}, {1.5, 0, 0, 0, 1.5, 0}};
    static const double sizes[] = {1e12, -1e12, 1e-300, 0.0, 1e9, 5e-324};
    uint64_t *random = &g->random;
    switch (random_below(random, KINDS_ACCEPTED)) {
    case 0:
        frame->detections = NULL;
        frame->detection_count = 0;
        frame->embeddings = NULL;
        frame->embedding_dimension = 0;
        break;
    case 1:
        frame->detector_skipped = 1;
        frame->detection_count = 0;
        frame->embeddings = NULL;
        frame->embedding_dimension = 0;
        break;
    case 2: random_boxes(g, frame, PILE, 1); break;
    case 3: random_boxes(g, frame, 100, 0); break;
    case 4:
        random_boxes(g, frame, 20, 0);
        for (size_t i = 0; i < 20; i++) {
            g->detections[i].left = sizes[random_below(random, 6)];
            g->detections[i].top = sizes[random_below(random, 6)];
            g->detections[i].width = fabs(sizes[random_below(random, 6)]);
            g->detections[i].height = fabs(sizes[random_below(random, 6)]);
        }
        break;
    case 5: frame->camera_motion = wild[random_below(random, 3)]; break;
    case 6: give_image(g, frame, 1, 1); break;
    case 7: {
        const uint32_t less = (uint32_t)random_below(random, 40);
        give_image(g, frame, SIDE - less, SIDE - less / 2);
        break;
    }
    default: *now += random_below(random, 2) ? INT64_C(10000000000) : INT64_C(3600000000000); break;
    }
}

#endif
