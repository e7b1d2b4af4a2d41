/* `save ALGORITHM FILE` plays half of a scene and saves the tracker; `load ALGORITHM FILE`, in another process, goes on
 * and must give what a tracker gives that was never interrupted. */
#include "scene.h"

enum { HALF = 20, FRAMES = 40 };

static gt2_tracker *tracker_of(const char *algorithm) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    CHECK_OK(gt2_config_new(algorithm, &config));
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    return tracker;
}

/* Somebody is missed now and then, so that there are lost tracks, too. */
static void play(gt2_tracker *tracker, scene *s, int from, int to) {
    for (int t = from; t < to; t++) {
        scene_fill(s, t);
        if (t % 20 >= 17) {
            s->frame.detection_count = SCENE_OBJECTS - 1;
        }
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    }
}

static void refuses_what_is_no_snapshot(uint8_t *bytes, size_t size) {
    gt2_tracker *tracker = NULL;
    CHECK_STATUS(gt2_tracker_load(NULL, 0, &tracker), GT2_ERR_SNAPSHOT);
    CHECK_STATUS(gt2_tracker_load(NULL, 5, &tracker), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_load(bytes, size, NULL), GT2_ERR_NULL_POINTER);
    CHECK_STATUS(gt2_tracker_load(bytes, size - 1, &tracker), GT2_ERR_SNAPSHOT);
    bytes[size / 2] ^= 1;
    CHECK_STATUS(gt2_tracker_load(bytes, size, &tracker), GT2_ERR_SNAPSHOT);
    CHECK_MESSAGE("snapshot is damaged");
    bytes[size / 2] ^= 1;
    CHECK(tracker == NULL);
}

static void save(gt2_tracker *tracker, const char *path) {
    size_t size = 0;
    CHECK_STATUS(gt2_tracker_save(tracker, NULL, 0, NULL), GT2_ERR_NULL_POINTER);
    CHECK_OK(gt2_tracker_save(tracker, NULL, 0, &size));
    uint8_t *bytes = (uint8_t *)calloc(size, 1);
    size_t needed = 0;
    CHECK_STATUS(gt2_tracker_save(tracker, bytes, size - 1, &needed), GT2_ERR_BUFFER_TOO_SMALL);
    CHECK(needed == size && bytes[0] == 0);
    CHECK_OK(gt2_tracker_save(tracker, bytes, size, &needed));
    CHECK(needed == size);
    FILE *file = fopen(path, "wb");
    CHECK(file != NULL && fwrite(bytes, 1, size, file) == size);
    CHECK(file != NULL && fclose(file) == 0);
    refuses_what_is_no_snapshot(bytes, size);
    free(bytes);
}

static gt2_tracker *load(const char *path) {
    static uint8_t bytes[1 << 20];
    FILE *file = fopen(path, "rb");
    const size_t size = file == NULL ? 0 : fread(bytes, 1, sizeof bytes, file);
    CHECK(size > 0 && fclose(file) == 0);
    gt2_tracker *tracker = NULL;
    CHECK_OK(gt2_tracker_load(bytes, size, &tracker));
    return tracker;
}

int main(int argc, char **argv) {
    static scene s;
    if (argc != 4) {
        fprintf(stderr, "usage: %s save|load ALGORITHM FILE\n", argv[0]);
        return 2;
    }
    gt2_tracker *straight = tracker_of(argv[2]);
    play(straight, &s, 0, HALF);
    if (strcmp(argv[1], "save") == 0) {
        save(straight, argv[3]);
    } else {
        gt2_tracker *loaded = load(argv[3]);
        CHECK(strcmp(gt2_tracker_algorithm(loaded), argv[2]) == 0);
        CHECK(same_results(loaded, straight));
        for (int t = HALF; t < FRAMES; t++) {
            play(straight, &s, t, t + 1);
            play(loaded, &s, t, t + 1);
            CHECK(same_results(loaded, straight));
        }
        gt2_tracker_free(loaded);
    }
    gt2_tracker_free(straight);
    return check_result();
}
