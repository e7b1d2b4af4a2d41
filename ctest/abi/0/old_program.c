/*
 * A program of the first days of ABI 0: it is compiled with the header of that time, beside it, and must go on working
 * with every library of that ABI. It calls every function of that header and fills every struct. Neither it nor its
 * header is to be changed.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gentrack2.h"

static int failures = 0;

static void check(int holds, const char *what, int line) {
    if (!holds) {
        failures++;
        fprintf(stderr, "line %d: does not hold: %s (last error: %s)\n", line, what, gt2_last_error_message());
    }
}
#define CHECK(condition) check((condition) != 0, #condition, __LINE__)

static gt2_config *configure(void) {
    static const char toml[] = "preset = \"paper\"\nparticles = 12\n";
    char text[16384];
    size_t needed = 0;
    double number = 0.0;
    int64_t integer = 0;
    gt2_config *config = NULL, *copy = NULL;
    CHECK(gt2_config_new("gentrack2", &config) == GT2_OK);
    CHECK(gt2_config_load_toml(config, toml, sizeof toml - 1) == GT2_OK);
    CHECK(gt2_config_get_integer(config, "particles", &integer) == GT2_OK && integer == 12);
    CHECK(gt2_config_set(config, "preset", "default") == GT2_OK);
    CHECK(gt2_config_set_number(config, "frame_rate", 25.0) == GT2_OK);
    CHECK(gt2_config_set_integer(config, "seed", 7) == GT2_OK);
    CHECK(gt2_config_set_boolean(config, "use_camera_motion", 1) == GT2_OK);
    CHECK(gt2_config_get_number(config, "frame_rate", &number) == GT2_OK && fabs(number - 25.0) < 1e-9);
    CHECK(gt2_config_get(config, "seed", text, sizeof text, &needed) == GT2_OK && strcmp(text, "7") == 0 && needed == 2);
    CHECK(gt2_config_to_toml(config, NULL, 0, &needed) == GT2_OK && needed > 1000);
    CHECK(gt2_config_set(config, "no such", "1") == GT2_ERR_UNKNOWN_PARAMETER);
    CHECK(gt2_config_set(config, "frame_rate", "-1") == GT2_ERR_PARAMETER_VALUE);
    CHECK(strstr(gt2_last_error_message(), "frame_rate") != NULL);
    CHECK(strcmp(gt2_config_algorithm(config), "gentrack2") == 0);
    CHECK(gt2_config_preset_count(config) >= 2 && strcmp(gt2_config_preset_name(config, 0), "default") == 0);
    CHECK(gt2_config_parameter_count(config) > 20);
    for (size_t i = 0; i < gt2_config_parameter_count(config); i++) {
        gt2_parameter_info info = GT2_PARAMETER_INFO_INIT;
        CHECK(gt2_config_parameter_info(config, i, &info) == GT2_OK);
        CHECK(info.key != NULL && info.documentation[0] != '\0' && info.kind >= GT2_PARAMETER_NUMBER);
        CHECK(gt2_config_get(config, info.key, text, sizeof text, NULL) == GT2_OK);
    }
    CHECK(gt2_config_clone(config, &copy) == GT2_OK);
    gt2_config_free(config);
    return copy;
}

/* A walker and one who comes towards them, with everything that a frame could have. */
static void step(gt2_tracker *tracker, int t) {
    static uint8_t pixels[320 * 240];
    static const float embeddings[8] = {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
    const double motion[6] = {1.0, 0.0, 0.5, 0.0, 1.0, 0.0};
    gt2_detection detections[2] = {{20.0 + 3 * t, 60, 40, 100, 0.9, 5, 0, 77}, {250.0 - 3 * t, 75, 40, 100, 0.8, 6, 0, 88}};
    gt2_image image = GT2_IMAGE_INIT;
    gt2_frame frame = GT2_FRAME_INIT;
    image.data = pixels;
    image.width = 320;
    image.height = 240;
    image.stride = 320;
    image.format = GT2_PIXEL_GRAY8;
    frame.detections = detections;
    frame.detection_count = 2;
    frame.embeddings = embeddings;
    frame.embedding_dimension = 4;
    frame.image = &image;
    frame.camera_motion = motion;
    frame.timestamp_ns = 40000000 * (int64_t)(t + 1);
    frame.has_timestamp = 1;
    for (int i = 0; i < 320 * 240; i++) {
        pixels[i] = (uint8_t)((i * 31 + t) % 251);
    }
    CHECK(gt2_tracker_step(tracker, &frame) == GT2_OK);
    detections[1].width = -1.0;
    CHECK(gt2_tracker_step(tracker, &frame) == GT2_ERR_DETECTION);
}

static void results(const gt2_tracker *tracker) {
    const uint64_t *ids = NULL;
    size_t count = 0, needed = 0;
    gt2_track copies[4];
    gt2_track_list list = GT2_TRACK_LIST_INIT;
    gt2_particle_list particles = GT2_PARTICLE_LIST_INIT;
    CHECK(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list) == GT2_OK && list.count == 2);
    CHECK(gt2_tracker_copy_tracks(tracker, GT2_TRACKS_REPORTED, copies, sizeof copies[0], 4, &needed) == GT2_OK);
    CHECK(needed == 2);
    for (size_t i = 0; i < list.count; i++) {
        const gt2_track *track = gt2_track_at(&list, i);
        CHECK(track->id == copies[i].id && track->age == copies[i].age && track->tag == copies[i].tag);
        CHECK(track->state == GT2_TRACK_CONFIRMED && track->detection_index >= 0 && track->hits == 30);
        CHECK(track->tag == (track->detection_index == 0 ? 77u : 88u));
        CHECK(track->class_id == (track->detection_index == 0 ? 5 : 6));
        CHECK(track->width > 30.0 && track->width < 50.0 && track->height > 90.0 && track->height < 110.0);
    }
    CHECK(gt2_tracker_track_of_detection(tracker, &ids, &count) == GT2_OK && count == 2 && ids[0] == 1 && ids[1] == 2);
    CHECK(gt2_tracker_particles(tracker, 1, &particles) == GT2_OK && particles.count > 0);
    CHECK(gt2_particle_at(&particles, particles.count - 1)->fitness <= 1.0);
    CHECK(gt2_tracker_particles(tracker, 99, &particles) == GT2_ERR_UNKNOWN_TRACK);
    CHECK(gt2_tracker_ended(tracker, &ids, &count) == GT2_OK && count == 0);
    CHECK(strcmp(gt2_tracker_algorithm(tracker), "gentrack2") == 0);
}

int main(void) {
    CHECK(gt2_abi_version() == GT2_ABI_VERSION);
    CHECK(gt2_algorithm_count() >= 8);
    for (size_t i = 0; i < gt2_algorithm_count(); i++) {
        CHECK(gt2_algorithm_name(i)[0] != '\0' && gt2_algorithm_description(i)[0] != '\0');
    }
    CHECK(strcmp(gt2_status_str(GT2_ERR_POISONED), "unknown status") != 0);
    gt2_config *config = configure();
    gt2_tracker *tracker = NULL;
    CHECK(gt2_tracker_new(config, &tracker) == GT2_OK);
    gt2_config_free(config);
    for (int round = 0; round < 2; round++) {
        for (int t = 0; t < 30; t++) {
            step(tracker, t);
        }
        results(tracker);
        CHECK(gt2_tracker_reset(tracker) == GT2_OK);
    }
    gt2_tracker_free(tracker);
    printf("compiled with %s, run with %s: %d failures\n", GT2_VERSION, gt2_version(), failures);
    return failures != 0;
}
