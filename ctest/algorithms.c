/* Every algorithm does what the interface says: it is made, fed with all there is, read, reset and released. */
#include "scene.h"

enum { FRAMES = 30 };

static gt2_tracker *tracker_of(const char *algorithm) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    CHECK_OK(gt2_config_new(algorithm, &config));
    CHECK(strcmp(gt2_config_algorithm(config), algorithm) == 0);
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    CHECK(strcmp(gt2_tracker_algorithm(tracker), algorithm) == 0);
    return tracker;
}

static void read_text(const gt2_config *config, const char *key, char *text, size_t capacity) {
    size_t needed = 0;
    CHECK_OK(gt2_config_get(config, key, NULL, 0, &needed));
    CHECK(needed > 0 && needed <= capacity);
    CHECK_OK(gt2_config_get(config, key, text, capacity, &needed));
    CHECK(strlen(text) + 1 == needed);
}

/* Another value than the default. */
static const char *other_value(const gt2_parameter_info *info, char *buffer, size_t capacity) {
    switch (info->kind) {
    case GT2_PARAMETER_BOOLEAN:
        return strcmp(info->default_text, "true") == 0 ? "false" : "true";
    case GT2_PARAMETER_CHOICE:
        return strcmp(info->default_text, info->choices[0]) == 0 ? info->choices[1] : info->choices[0];
    case GT2_PARAMETER_AREAS:
        return "1,2,3,4";
    default:
        snprintf(buffer, capacity, "%.17g", info->minimum);
        if (fabs(strtod(info->default_text, NULL) - info->minimum) <= 0.0) {
            snprintf(buffer, capacity, "%.17g", fmin(info->minimum + 1.0, info->maximum));
        }
        return buffer;
    }
}

static void parameters(const char *algorithm) {
    gt2_config *config = NULL, *untouched = NULL;
    CHECK_OK(gt2_config_new(algorithm, &config));
    CHECK_OK(gt2_config_clone(config, &untouched));
    const size_t count = gt2_config_parameter_count(config);
    CHECK(count > 6);
    for (size_t i = 0; i < count; i++) {
        gt2_parameter_info info = GT2_PARAMETER_INFO_INIT;
        char text[256] = "", other[64] = "";
        CHECK_OK(gt2_config_parameter_info(config, i, &info));
        CHECK(info.key[0] != 0 && info.documentation[0] != 0);
        read_text(config, info.key, text, sizeof text);
        CHECK(strcmp(text, info.default_text) == 0);
        CHECK_OK(gt2_config_set(config, info.key, info.default_text));
        read_text(config, info.key, text, sizeof text);
        CHECK(strcmp(text, info.default_text) == 0);
        CHECK_OK(gt2_config_set(config, info.key, other_value(&info, other, sizeof other)));
        read_text(config, info.key, text, sizeof text);
        if (!CHECK(strcmp(text, info.default_text) != 0)) {
            fprintf(stderr, "%s of %s\n", info.key, algorithm);
        }
        /* Each alone: some exclude each other. */
        CHECK_OK(gt2_config_set(config, info.key, info.default_text));
        read_text(config, info.key, text, sizeof text);
        CHECK(strcmp(text, info.default_text) == 0);
    }
    char a[32768] = "", b[32768] = "";
    CHECK_OK(gt2_config_to_toml(config, a, sizeof a, NULL));
    CHECK_OK(gt2_config_to_toml(untouched, b, sizeof b, NULL));
    CHECK(a[0] != 0 && strcmp(a, b) == 0);
    gt2_config_free(config);
    gt2_config_free(untouched);
}

/* Frame `t` of a scene in which the detector rests at times and the middle object is hidden for some frames. */
static void fill(scene *s, int t) {
    scene_fill(s, t);
    if (t % 5 == 3) {
        s->frame.detections = NULL;
        s->frame.detection_count = 0;
        s->frame.embeddings = NULL;
        s->frame.embedding_dimension = 0;
        s->frame.detector_skipped = 1;
    } else if (t >= 15 && t < 20) {
        s->detections[1] = s->detections[2];
        memcpy(&s->embeddings[SCENE_DIMENSION], &s->embeddings[2 * SCENE_DIMENSION], SCENE_DIMENSION * sizeof(float));
        s->frame.detection_count = 2;
    }
}

static size_t count_of(const gt2_tracker *tracker, const scene *s) {
    const uint64_t *ids = NULL, *ended = NULL;
    size_t rows = 0, ends = 0, all = 0, taken = 0, matched = 0;
    CHECK_OK(gt2_tracker_track_of_detection(tracker, &ids, &rows));
    CHECK(rows == s->frame.detection_count);
    for (size_t i = 0; i < rows; i++) {
        taken += ids[i] != 0;
    }
    CHECK_OK(gt2_tracker_ended(tracker, &ended, &ends));
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        const gt2_track_list list = tracks_of(tracker, kind);
        all += list.count;
        for (size_t i = 0; i < list.count; i++) {
            const gt2_track *track = gt2_track_at(&list, i);
            gt2_particle_list particles = GT2_PARTICLE_LIST_INIT;
            CHECK_OK(gt2_tracker_particles(tracker, track->id, &particles));
            CHECK((particles.count > 0) == (strcmp(gt2_tracker_algorithm(tracker), "gentrack2") == 0));
            gt2_neighbourhood near = GT2_NEIGHBOURHOOD_INIT;
            CHECK_OK(gt2_tracker_neighbourhood(tracker, track->id, &near));
            CHECK(near.trusted_count <= near.count && (near.neighbours == NULL) == (near.count == 0));
            if (track->detection_index >= 0 || strcmp(gt2_tracker_algorithm(tracker), "gentrack2") != 0) {
                CHECK(near.count == 0 && near.rule == GT2_MOVE_NONE);
            }
            CHECK(track->state >= GT2_TRACK_TENTATIVE && track->state <= GT2_TRACK_LOST);
            if (track->detection_index >= 0 && CHECK((size_t)track->detection_index < rows)) {
                const gt2_detection *d = &s->detections[track->detection_index];
                matched++;
                CHECK(ids[track->detection_index] == track->id);
                CHECK(track->class_id == d->class_id && track->tag == d->tag);
            }
        }
    }
    CHECK(matched == taken);
    CHECK(all_finite(tracker));
    return all;
}

static void tracking(const char *algorithm) {
    gt2_tracker *tracker = tracker_of(algorithm), *other = tracker_of(algorithm);
    scene *s = (scene *)malloc(sizeof *s);
    for (int round = 0; round < 2; round++) {
        for (int t = 0; t < FRAMES; t++) {
            fill(s, t);
            CHECK_OK(gt2_tracker_step(tracker, &s->frame));
            const size_t live = count_of(tracker, s);
            if (!CHECK(live == SCENE_OBJECTS || (live == SCENE_OBJECTS - 1 && strcmp(algorithm, "sort") == 0))) {
                fprintf(stderr, "%s: %d tracks in frame %d\n", algorithm, (int)live, t);
            }
            /* A handle beside it, and one that has been reset, gives the same. */
            if (round == 0) {
                CHECK_OK(gt2_tracker_step(other, &s->frame));
                CHECK(same_results(tracker, other));
            }
        }
        if (round == 1) {
            CHECK(same_results(tracker, other));
        }
        CHECK(tracks_of(tracker, GT2_TRACKS_REPORTED).count == SCENE_OBJECTS);
        CHECK_OK(gt2_tracker_reset(tracker));
        for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
            CHECK(tracks_of(tracker, kind).count == 0);
        }
    }
    free(s);
    gt2_tracker_free(tracker);
    gt2_tracker_free(other);
}

static void bad_rows(const char *algorithm) {
    gt2_tracker *tracker = tracker_of(algorithm), *other = tracker_of(algorithm);
    scene *s = (scene *)malloc(sizeof *s);
    for (int t = 0; t < 4; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(other, &s->frame));
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
        scene_fill(s, t + 1);
        s->detections[1].score = 2.0;
        CHECK_STATUS(gt2_tracker_step(tracker, &s->frame), GT2_ERR_DETECTION);
        CHECK(same_results(tracker, other));
    }
    free(s);
    gt2_tracker_free(tracker);
    gt2_tracker_free(other);
}

int main(void) {
    CHECK(gt2_algorithm_count() == 8);
    for (size_t i = 0; i < gt2_algorithm_count(); i++) {
        const char *algorithm = gt2_algorithm_name(i);
        const int before = check_failures;
        CHECK(gt2_algorithm_description(i) != NULL && gt2_algorithm_description(i)[0] != 0);
        parameters(algorithm);
        tracking(algorithm);
        bad_rows(algorithm);
        if (check_failures > before) {
            fprintf(stderr, "with %s\n", algorithm);
        }
    }
    CHECK(gt2_algorithm_name(gt2_algorithm_count()) == NULL);
    return check_result();
}
