/*
 * Prints a number for the bits of every step's results, of every tracker on every sequence given: two machines agree if
 * their lines do. Usage: bits PATH..., where PATH.det.txt and PATH.f32 exist and PATH.gmc.txt may, as
 * tests/fixtures/oracles/README.md describes them. Image pixels are made up.
 */
#include "results_hash.h"
#include "sequence.h"

enum { WIDTH = 640, HEIGHT = 360 };

static void track(const char *algorithm, const sequence *s, int with_image) {
    static uint8_t pixels[WIDTH * HEIGHT];
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    size_t reported = 0;
    CHECK_OK(gt2_config_new(algorithm, &config));
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    for (int t = 1; t <= FRAMES && tracker != NULL; t++) {
        gt2_frame frame = frame_at(s, t);
        gt2_image image = GT2_IMAGE_INIT;
        if (with_image) {
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                pixels[i] = (uint8_t)((i % WIDTH * 7 + i / WIDTH * 13 + t * 5) % 256);
            }
            image.data = pixels;
            image.width = WIDTH;
            image.height = HEIGHT;
            frame.image = &image;
        }
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        CHECK_OK(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list));
        reported += list.count;
        printf("%s %s%s %d %016llx\n", algorithm, strrchr(s->path, '/') + 1, with_image ? " with image" : "", t,
               (unsigned long long)hash_results(HASH_OF_NOTHING, tracker));
    }
    CHECK(reported > 100);
    /* A saved tracker is made of the same bytes, too. */
    size_t size = 0;
    CHECK_OK(gt2_tracker_save(tracker, NULL, 0, &size));
    uint8_t *saved = (uint8_t *)calloc(size + 1, 1);
    CHECK_OK(gt2_tracker_save(tracker, saved, size, &size));
    uint64_t hash = HASH_OF_NOTHING;
    for (size_t i = 0; i < size; i++) {
        hash = hash_word(hash, saved[i]);
    }
    printf("%s %s saved %016llx\n", algorithm, strrchr(s->path, '/') + 1, (unsigned long long)hash);
    free(saved);
    gt2_tracker_free(tracker);
}

int main(int count, char **paths) {
    for (int i = 1; i < count; i++) {
        sequence s;
        if (!CHECK(strchr(paths[i], '/') != NULL && read_sequence(&s, paths[i]))) {
            fprintf(stderr, "%s: cannot be read\n", paths[i]);
            return 1;
        }
        for (size_t k = 0; k < gt2_algorithm_count(); k++) {
            track(gt2_algorithm_name(k), &s, 0);
        }
        if (i == count - 1) {
            track("gentrack2", &s, 1);
        }
        free_sequence(&s);
    }
    CHECK(count > 1);
    return check_result();
}
