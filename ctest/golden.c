/*
 * Every tracker on every scene gives the committed hash, in one thread and in several at once that begin at different
 * scenes. Usage: golden FIXTURES THREADS, where FIXTURES is tests/fixtures; golden/README.md there says what the scenes
 * are.
 */
#include <pthread.h>

#include "results_hash.h"
#include "sequence.h"

enum { WIDTH = 1920, HEIGHT = 1080, STRIDE = 2048, ROWS = 1200, FRAMES_WITH_IMAGES = 60 };
/* Room for so many. */
enum { SCENES = 512, SEQUENCES = 16, THREADS = 16 };

typedef struct scene_line {
    char algorithm[32], name[32], words[128];
    unsigned long long hash;
    const sequence *frames;
} scene_line;

static scene_line lines[SCENES];
static size_t line_count;
static sequence sequences[SEQUENCES];
static char paths[SEQUENCES][512];
static uint8_t texture[STRIDE * ROWS];

static const sequence *sequence_of(const char *fixtures, const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/oracles/synthetic/%s", fixtures, name);
    for (int i = 0; i < SEQUENCES; i++) {
        if (paths[i][0] == 0) {
            memcpy(paths[i], path, sizeof path);
            return read_sequence(&sequences[i], paths[i]) ? &sequences[i] : NULL;
        }
        if (strcmp(paths[i], path) == 0) {
            return &sequences[i];
        }
    }
    return NULL;
}

static int read_lines(const char *fixtures) {
    char path[512];
    snprintf(path, sizeof path, "%s/golden/hashes.txt", fixtures);
    FILE *file = fopen(path, "r");
    while (file != NULL && line_count < SCENES) {
        scene_line *l = &lines[line_count];
        if (fscanf(file, "%31s %31s %127s %llx", l->algorithm, l->name, l->words, &l->hash) != 4) {
            break;
        }
        l->frames = sequence_of(fixtures, l->name);
        if (!CHECK(l->frames != NULL)) {
            return 0;
        }
        line_count++;
    }
    const int whole = file != NULL && feof(file);
    if (file != NULL) {
        fclose(file);
    }
    return CHECK(whole && line_count > 100);
}

/* No word is a part of another. */
static int has(const scene_line *l, const char *word) { return strstr(l->words, word) != NULL; }

static gt2_tracker *tracker_of(const scene_line *l) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    CHECK_OK(gt2_config_new(l->algorithm, &config));
    if (has(l, "paper")) {
        CHECK_OK(gt2_config_set(config, "preset", "paper"));
    }
    if (has(l, "separate")) {
        CHECK_OK(gt2_config_set(config, "class_policy", "separate"));
    }
    if (has(l, "camera")) {
        const gt2_status status = gt2_config_set(config, "use_camera_motion", "true");
        CHECK(status == GT2_OK || status == GT2_ERR_UNKNOWN_PARAMETER);
    }
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    return tracker;
}

static uint64_t play(const scene_line *l) {
    gt2_tracker *tracker = tracker_of(l);
    uint64_t hash = HASH_OF_NOTHING;
    const int frames = has(l, "images") ? FRAMES_WITH_IMAGES : FRAMES;
    for (int t = 1; t <= frames && tracker != NULL; t++) {
        gt2_frame frame = frame_at(l->frames, t);
        gt2_image image = GT2_IMAGE_INIT;
        frame.image_width = WIDTH;
        frame.image_height = HEIGHT;
        if (!has(l, "embeddings")) {
            frame.embeddings = NULL;
            frame.embedding_dimension = 0;
        }
        if (!has(l, "camera")) {
            frame.camera_motion = NULL;
        }
        if (has(l, "images")) {
            image.data = &texture[2 * t % 100 * STRIDE + 3 * t % 100];
            image.width = WIDTH;
            image.height = HEIGHT;
            image.stride = STRIDE;
            frame.image = &image;
        }
        if (has(l, "times")) {
            frame.has_timestamp = 1;
            frame.timestamp_ns = INT64_C(33333333) * t + 4000000 * (7 * t % 5) + (t >= 150 ? 700000000 : 0);
        }
        if (has(l, "rests") && t % 4 == 3) {
            frame.detector_skipped = 1;
            frame.detection_count = 0;
            frame.embeddings = NULL;
            frame.embedding_dimension = 0;
        }
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        hash = hash_results(hash, tracker);
    }
    gt2_tracker_free(tracker);
    return hash;
}

typedef struct job {
    size_t first;
    size_t wrong;
} job;

static void *play_all(void *argument) {
    job *j = (job *)argument;
    for (size_t i = 0; i < line_count; i++) {
        const scene_line *l = &lines[(j->first + i) % line_count];
        const uint64_t hash = play(l);
        if (hash != l->hash) {
            fprintf(stderr, "%s %s %s: %016llx instead of %016llx\n", l->algorithm, l->name, l->words,
                    (unsigned long long)hash, l->hash);
            j->wrong++;
        }
    }
    return NULL;
}

int main(int count, char **arguments) {
    const size_t threads = count == 3 ? strtoul(arguments[2], NULL, 10) : 0;
    if (threads < 1 || threads > THREADS) {
        fprintf(stderr, "usage: golden FIXTURES THREADS\n");
        return 1;
    }
    for (size_t i = 0; i < sizeof texture; i++) {
        const size_t x = i % STRIDE, y = i / STRIDE;
        texture[i] = (uint8_t)((x / 7) * (y / 5 + 3) * 37 + 2 * x + y);
    }
    if (!read_lines(arguments[1])) {
        return 1;
    }
    pthread_t running[THREADS];
    job jobs[THREADS];
    for (size_t k = 0; k < threads; k++) {
        jobs[k].first = k * line_count / threads;
        jobs[k].wrong = 0;
        CHECK(pthread_create(&running[k], NULL, play_all, &jobs[k]) == 0);
    }
    for (size_t k = 0; k < threads; k++) {
        CHECK(pthread_join(running[k], NULL) == 0);
        CHECK(jobs[k].wrong == 0);
    }
    printf("%zu hashes hold in each of %zu threads\n", line_count, threads);
    for (int i = 0; i < SEQUENCES; i++) {
        free_sequence(&sequences[i]);
    }
    return check_result();
}
