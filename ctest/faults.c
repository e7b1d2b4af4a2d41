/*
 * One fault on purpose, which the program survives: whoever relies on a checker runs it on these first, so that one
 * that sees nothing is noticed. Those "in the library" are a caller's mistake that only shows there.
 * Usage: faults NAME
 */
#define _POSIX_C_SOURCE 199309L
#include <limits.h>
#include <pthread.h>
#include <time.h>

#include "scene.h"

/* Whatever passes through here is out of the compiler's sight. */
static void *volatile hidden = NULL;

static void *out_of_sight(void *pointer) {
    hidden = pointer;
    return hidden;
}

static volatile int sink = 0;

static void read_after_free(void) {
    char *text = (char *)out_of_sight(calloc(1, 16));
    free(text);
    text = (char *)hidden;
    sink = text[3];
}

static void read_beyond_end(void) {
    const char *text = (const char *)out_of_sight(calloc(1, 16));
    sink = text[16];
    free(hidden);
}

static void overflow(void) {
    volatile int most = INT_MAX;
    sink = most + 1;
}

static void misaligned(void) {
    char *bytes = (char *)out_of_sight(calloc(1, 16));
    const int *number = (const int *)out_of_sight(bytes + 1);
    sink = *number;
    free(bytes);
}

static void leak(void) {
    (void)out_of_sight(new_tracker());
    hidden = NULL;
}

/* No leak to those who ask only whether anybody still knows the memory. */
static void kept(void) { (void)out_of_sight(new_tracker()); }

static void step(gt2_tracker *tracker, gt2_detection *detections, size_t count) {
    gt2_frame frame = GT2_FRAME_INIT;
    frame.detections = detections;
    frame.detection_count = count;
    gt2_tracker_step(tracker, &frame);
}

static void read_beyond_end_in_library(void) {
    gt2_tracker *tracker = new_tracker();
    gt2_detection *one = (gt2_detection *)malloc(sizeof *one);
    *one = scene_detection(10.0, 10.0, 20.0, 40.0);
    step(tracker, one, 2);
    free(one);
    gt2_tracker_free(tracker);
}

static void uninitialised_in_library(void) {
    gt2_tracker *tracker = new_tracker();
    gt2_detection *one = (gt2_detection *)malloc(sizeof *one);
    one->left = 10.0; /* and nothing else */
    step(tracker, one, 1);
    free(one);
    gt2_tracker_free(tracker);
}

static void use_after_free_in_library(void) {
    gt2_tracker *tracker = (gt2_tracker *)out_of_sight(new_tracker());
    gt2_tracker_free(tracker);
    gt2_tracker_reset((gt2_tracker *)hidden);
}

static int shared = 0;

static void *count(void *argument) {
    (void)argument;
    shared++;
    return NULL;
}

static void *step_shared(void *argument) {
    /* Nothing but time keeps the two threads apart, and so the program alive. */
    static int64_t moments[2] = {0, 300000000};
    const int64_t *moment = (const int64_t *)argument;
    const struct timespec pause = {0, (long)moments[*moment]};
    gt2_detection one = scene_detection(10.0, 10.0, 20.0, 40.0);
    nanosleep(&pause, NULL);
    step((gt2_tracker *)hidden, &one, 1);
    return NULL;
}

static void run_two(void *(*what)(void *)) {
    static int64_t numbers[2] = {0, 1};
    pthread_t threads[2];
    for (int i = 0; i < 2; i++) {
        CHECK(pthread_create(&threads[i], NULL, what, &numbers[i]) == 0);
    }
    for (int i = 0; i < 2; i++) {
        CHECK(pthread_join(threads[i], NULL) == 0);
    }
}

static void race(void) { run_two(count); }

static void race_in_library(void) {
    gt2_tracker *tracker = (gt2_tracker *)out_of_sight(new_tracker());
    run_two(step_shared);
    gt2_tracker_free(tracker);
}

static const struct {
    const char *name;
    void (*commit)(void);
} faults[] = {
    {"read_after_free", read_after_free},
    {"read_beyond_end", read_beyond_end},
    {"overflow", overflow},
    {"misaligned", misaligned},
    {"leak", leak},
    {"kept", kept},
    {"read_beyond_end_in_library", read_beyond_end_in_library},
    {"uninitialised_in_library", uninitialised_in_library},
    {"use_after_free_in_library", use_after_free_in_library},
    {"race", race},
    {"race_in_library", race_in_library},
};

int main(int arguments, char **argument) {
    for (size_t i = 0; arguments == 2 && i < sizeof faults / sizeof faults[0]; i++) {
        if (strcmp(argument[1], faults[i].name) == 0) {
            faults[i].commit();
            return check_result();
        }
    }
    fprintf(stderr, "usage: faults NAME\n");
    return 2;
}
