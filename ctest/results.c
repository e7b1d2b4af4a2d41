/* The rules of the interface, for trackers and what comes out of them. */
#include "scene.h"

static void handles(void) {
    static const uint64_t zeros[64];
    gt2_config *config = new_config();
    gt2_tracker *tracker = NULL, *const none = (gt2_tracker *)(void *)config;
    const gt2_tracker *zero = (const gt2_tracker *)(const void *)zeros;
    const gt2_frame frame = GT2_FRAME_INIT;
    gt2_track_list list = GT2_TRACK_LIST_INIT;
    gt2_particle_list particles = GT2_PARTICLE_LIST_INIT;
    gt2_neighbourhood near = GT2_NEIGHBOURHOOD_INIT;
    const uint64_t *ids = zeros;
    size_t count = 77;
    CHECK_STATUS(gt2_tracker_new(NULL, &tracker), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_new(config, NULL), GT2_ERR_NULL_POINTER);
    CHECK(tracker == NULL);
    CHECK_STATUS(gt2_tracker_step(NULL, &frame), GT2_ERR_NULL_POINTER);
    CHECK_MESSAGE("tracker is NULL");
    CHECK_STATUS(gt2_tracker_step(none, &frame), GT2_ERR_INVALID_HANDLE);
    CHECK_MESSAGE("tracker is not a live gt2_tracker");
    CHECK_STATUS(gt2_tracker_reset(none), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_tracker_reset(NULL), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_tracks(zero, GT2_TRACKS_REPORTED, &list), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_tracker_copy_tracks(zero, 0, NULL, 0, 0, &count), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_tracker_ended(NULL, &ids, &count), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_track_of_detection(zero, &ids, &count), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_tracker_particles(none, 1, &particles), GT2_ERR_INVALID_HANDLE);
    CHECK_STATUS(gt2_tracker_neighbourhood(none, 1, &near), GT2_ERR_INVALID_HANDLE);
    CHECK(gt2_tracker_algorithm(none) == NULL && gt2_tracker_algorithm(NULL) == NULL);
    CHECK(ids == zeros && count == 77); /* outputs are written on success only */
    gt2_tracker_free(NULL);
    gt2_tracker_free(none); /* not a tracker: nothing happens */
    CHECK(strcmp(gt2_config_algorithm(config), "gentrack2") == 0);
    gt2_config_free(config);

    tracker = new_tracker();
    CHECK_STATUS(gt2_tracker_tracks(tracker, -1, &list), GT2_ERR_INVALID_ARGUMENT);
    CHECK_MESSAGE("kind: is -1");
    CHECK_STATUS(gt2_tracker_tracks(tracker, 3, &list), GT2_ERR_INVALID_ARGUMENT);
    CHECK_STATUS(gt2_tracker_tracks(tracker, 0, NULL), GT2_ERR_NULL_POINTER);
    list.struct_size = 1;
    CHECK_STATUS(gt2_tracker_tracks(tracker, 0, &list), GT2_ERR_STRUCT_SIZE);
    CHECK_STATUS(gt2_tracker_ended(tracker, NULL, &count), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_ended(tracker, &ids, NULL), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_particles(tracker, 1, &particles), GT2_ERR_UNKNOWN_TRACK);
    CHECK_MESSAGE("no live track has id 1");
    CHECK_STATUS(gt2_tracker_particles(tracker, 0, &particles), GT2_ERR_UNKNOWN_TRACK);
    CHECK_STATUS(gt2_tracker_neighbourhood(tracker, 1, &near), GT2_ERR_UNKNOWN_TRACK);
    CHECK_MESSAGE("no live track has id 1");
    CHECK_STATUS(gt2_tracker_neighbourhood(NULL, 1, &near), GT2_ERR_NULL_POINTER);
    /* Before the first step everything is empty. */
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        list = tracks_of(tracker, kind);
        CHECK(list.count == 0 && list.tracks == NULL);
    }
    CHECK_OK(gt2_tracker_ended(tracker, &ids, &count));
    CHECK(ids == NULL && count == 0);
    gt2_tracker_free(tracker);
}

/* A newer header's larger track. */
typedef struct newer_track {
    gt2_track track;
    uint64_t unknown;
} newer_track;

static void copies(void) {
    gt2_tracker *tracker = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    for (int t = 0; t < 3; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    }
    const gt2_track_list list = tracks_of(tracker, GT2_TRACKS_REPORTED);
    CHECK(list.count == SCENE_OBJECTS && list.stride >= sizeof(gt2_track) && list.struct_size == sizeof list);

    gt2_track buffer[4], untouched[4];
    size_t needed = 0;
    memset(buffer, 0x5a, sizeof buffer);
    memcpy(untouched, buffer, sizeof buffer);
    CHECK_OK(gt2_tracker_copy_tracks(tracker, 0, NULL, 0, 0, &needed));
    CHECK(needed == SCENE_OBJECTS);
    needed = 0;
    CHECK_STATUS(gt2_tracker_copy_tracks(tracker, 0, buffer, sizeof buffer[0], 2, &needed), GT2_ERR_BUFFER_TOO_SMALL);
    CHECK_MESSAGE("capacity: is 2, there are 3 tracks");
    CHECK(needed == SCENE_OBJECTS && memcmp(buffer, untouched, sizeof buffer) == 0);
    CHECK_STATUS(gt2_tracker_copy_tracks(tracker, 0, NULL, sizeof buffer[0], 3, &needed), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_copy_tracks(tracker, 0, NULL, 0, 0, NULL), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_copy_tracks(tracker, 0, buffer, 0, 4, NULL), GT2_ERR_INVALID_ARGUMENT);
    CHECK_STATUS(gt2_tracker_copy_tracks(tracker, 0, buffer, 100000, 4, NULL), GT2_ERR_INVALID_ARGUMENT);
    CHECK_STATUS(gt2_tracker_copy_tracks(tracker, 9, buffer, sizeof buffer[0], 4, NULL), GT2_ERR_INVALID_ARGUMENT);
    CHECK(memcmp(buffer, untouched, sizeof buffer) == 0);
    CHECK_OK(gt2_tracker_copy_tracks(tracker, 0, buffer, sizeof buffer[0], 3, NULL));
    CHECK(memcmp(&buffer[3], &untouched[3], sizeof buffer[3]) == 0);
    newer_track newer[3];
    memset(newer, 0x5a, sizeof newer);
    CHECK_OK(gt2_tracker_copy_tracks(tracker, 0, &newer[0].track, sizeof newer[0], 3, NULL));
    for (size_t i = 0; i < 3; i++) {
        CHECK(memcmp(&buffer[i], gt2_track_at(&list, i), sizeof buffer[i]) == 0);
        CHECK(memcmp(&newer[i].track, &buffer[i], sizeof buffer[i]) == 0 && newer[i].unknown == 0);
    }
    /* A list whose rows are longer than this header knows. */
    const gt2_track_list longer = {sizeof longer, &newer[0].track, 3, sizeof newer[0]};
    CHECK(gt2_track_at(&longer, 2) == &newer[2].track);
    free(s);
    gt2_tracker_free(tracker);
}

/* Objects that are gone: their tracks are lost for a while, then each ends once. */
static void endings(void) {
    gt2_tracker *tracker = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    int ended[SCENE_OBJECTS + 1] = {0, 0, 0, 0};
    size_t most_lost = 0;
    for (int t = 0; t < 20; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    }
    for (int t = 20; t < 400; t++) {
        const uint64_t *ids = NULL;
        size_t count = 0;
        scene_fill(s, t);
        s->frame.detection_count = 0;
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        const gt2_track_list lost = tracks_of(tracker, GT2_TRACKS_LOST);
        most_lost = lost.count > most_lost ? lost.count : most_lost;
        for (size_t i = 0; i < lost.count; i++) {
            const gt2_track *track = gt2_track_at(&lost, i);
            CHECK(track->state == GT2_TRACK_LOST && track->detection_index == -1);
            CHECK(track->frames_since_match == (uint32_t)(t - 19));
            /* The tag and the class of the last detection stay. */
            CHECK(track->tag / 1000 == 19 && track->class_id == 10 + (int32_t)(track->tag % 1000));
        }
        CHECK_OK(gt2_tracker_ended(tracker, &ids, &count));
        for (size_t i = 0; i < count; i++) {
            if (CHECK(ids[i] >= 1 && ids[i] <= SCENE_OBJECTS)) {
                gt2_particle_list particles = GT2_PARTICLE_LIST_INIT;
                ended[ids[i]]++;
                CHECK_STATUS(gt2_tracker_particles(tracker, ids[i], &particles), GT2_ERR_UNKNOWN_TRACK);
            }
        }
    }
    CHECK(most_lost == SCENE_OBJECTS);
    for (int id = 1; id <= SCENE_OBJECTS; id++) {
        CHECK(ended[id] == 1);
    }
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        CHECK(tracks_of(tracker, kind).count == 0);
    }
    free(s);
    gt2_tracker_free(tracker);
}

/* After a reset a tracker is as new: the same frames give the same results, earlier times and all. */
static void reset(void) {
    gt2_tracker *tracker = new_tracker(), *fresh = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    for (int t = 0; t < 30; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    }
    CHECK_OK(gt2_tracker_reset(tracker));
    CHECK(same_results(tracker, fresh)); /* nothing */
    for (int t = 0; t < 30; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        CHECK_OK(gt2_tracker_step(fresh, &s->frame));
        CHECK(same_results(tracker, fresh));
    }
    CHECK(tracks_of(tracker, GT2_TRACKS_REPORTED).count == SCENE_OBJECTS);
    free(s);
    gt2_tracker_free(tracker);
    gt2_tracker_free(fresh);
}

/* A tracker has its config for itself; identities start where it says. */
static void config_is_copied(void) {
    gt2_config *config = new_config();
    gt2_tracker *tracker = NULL;
    scene *s = (scene *)malloc(sizeof *s);
    const uint64_t *ids = NULL;
    size_t count = 0;
    CHECK_OK(gt2_config_set(config, "first_id", "1000"));
    CHECK_OK(gt2_config_set(config, "max_detections", "3"));
    CHECK_OK(gt2_tracker_new(config, &tracker));
    CHECK_OK(gt2_config_set(config, "max_detections", "1"));
    gt2_config_free(config);
    for (int round = 0; round < 2; round++) {
        scene_fill(s, 0);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        CHECK_OK(gt2_tracker_track_of_detection(tracker, &ids, &count));
        CHECK(count == 3 && ids[0] == 1000 && ids[1] == 1001 && ids[2] == 1002);
        CHECK_OK(gt2_tracker_reset(tracker));
    }
    free(s);
    gt2_tracker_free(tracker);
}

int main(void) {
    handles();
    copies();
    endings();
    reset();
    config_is_copied();
    return check_result();
}
