/*
 * Different trackers run in different threads at once, and functions that take a tracker as const in several.
 * Usage: threads [warm], where with `warm` the first thread alone makes what the library makes once: helgrind does not know
 * how Rust tells the other threads that it is made, and would take their reading of it for a race.
 */
#include <pthread.h>

#include "scene.h"

enum { FRAMES = 60, THREADS = 2 };

typedef struct job {
    gt2_tracker *tracker;
    const char *bad_key;
    int failures;
} job;

static void *track(void *argument) {
    job *j = (job *)argument;
    scene *s = (scene *)malloc(sizeof *s);
    gt2_config *config = NULL;
    j->failures += gt2_config_new("gentrack2", &config) != GT2_OK;
    for (int t = 0; t < FRAMES; t++) {
        scene_fill(s, t);
        j->failures += gt2_tracker_step(j->tracker, &s->frame) != GT2_OK;
        /* The last error is this thread's own. */
        j->failures += gt2_config_set(config, j->bad_key, "1") != GT2_ERR_UNKNOWN_PARAMETER;
        j->failures += strstr(gt2_last_error_message(), j->bad_key) == NULL;
    }
    gt2_config_free(config);
    free(s);
    return NULL;
}

static void *read_only(void *argument) {
    job *j = (job *)argument;
    for (int i = 0; i < 2000; i++) {
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        gt2_particle_list particles = GT2_PARTICLE_LIST_INIT;
        j->failures += gt2_tracker_tracks(j->tracker, GT2_TRACKS_REPORTED, &list) != GT2_OK;
        j->failures += list.count != SCENE_OBJECTS;
        j->failures += gt2_tracker_particles(j->tracker, gt2_track_at(&list, 0)->id, &particles) != GT2_OK;
        j->failures += gt2_tracker_particles(j->tracker, 999, &particles) != GT2_ERR_UNKNOWN_TRACK;
    }
    return NULL;
}

static void run(void *(*what)(void *), job jobs[THREADS]) {
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_create(&threads[i], NULL, what, &jobs[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_join(threads[i], NULL) == 0);
        CHECK(jobs[i].failures == 0);
    }
}

int main(int count, char **arguments) {
    if (count > 1 && CHECK(strcmp(arguments[1], "warm") == 0)) {
        gt2_config *config = new_config();
        CHECK_STATUS(gt2_config_set(config, "key_of_none", "1"), GT2_ERR_UNKNOWN_PARAMETER);
        gt2_config_free(config);
    }
    /* The trackers are made by this thread, used by others, and released by this one. */
    gt2_tracker *alone = new_tracker();
    job jobs[THREADS] = {{new_tracker(), "key_of_one", 0}, {new_tracker(), "key_of_two", 0}};
    job reference = {alone, "key_of_main", 0};
    run(track, jobs);
    track(&reference);
    CHECK(reference.failures == 0);
    CHECK(same_results(jobs[0].tracker, alone) && same_results(jobs[1].tracker, alone));
    CHECK(tracks_of(alone, GT2_TRACKS_REPORTED).count == SCENE_OBJECTS);

    if (count > 1) {
        /* The list is made by whoever asks first, which helgrind takes for a race as well. */
        gt2_particle_list particles = GT2_PARTICLE_LIST_INIT;
        gt2_track_list list = tracks_of(alone, GT2_TRACKS_REPORTED);
        CHECK_OK(gt2_tracker_particles(alone, gt2_track_at(&list, 0)->id, &particles));
    }
    job readers[THREADS] = {{alone, NULL, 0}, {alone, NULL, 0}};
    run(read_only, readers);
    gt2_tracker_free(jobs[0].tracker);
    gt2_tracker_free(jobs[1].tracker);
    gt2_tracker_free(alone);
    return check_result();
}
