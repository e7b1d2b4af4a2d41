/*
 * A tracker is saved now and then on its way through real sequences, and each time goes on in another process, which must
 * give the bits that the first one gives, frame by frame. All trackers.
 *
 * Usage: relay FIXTURES, where FIXTURES is tests/fixtures; it calls itself as relay FIXTURES FILE FRAME to go on after
 * that frame with the tracker in FILE.
 */
#define _POSIX_C_SOURCE 200112L
#include "feed.h"
#include "results_hash.h"

enum { END = 400, STEP = 37, EARLY = 4, MOST_BYTES = 1 << 22 };

/* Early, when everything is new, and at intervals. */
static int is_saved_after(int t) { return t <= EARLY || t % STEP == 0; }

static void save(const gt2_tracker *tracker, const char *path) {
    size_t size = 0;
    CHECK_OK(gt2_tracker_save(tracker, NULL, 0, &size));
    CHECK(size <= MOST_BYTES);
    uint8_t *bytes = (uint8_t *)malloc(size);
    CHECK_OK(gt2_tracker_save(tracker, bytes, size, &size));
    FILE *file = fopen(path, "wb");
    CHECK(file != NULL && fwrite(bytes, 1, size, file) == size);
    CHECK(file != NULL && fclose(file) == 0);
    free(bytes);
}

/* Goes on to the end and prints the hash of each frame's results. */
static int go_on(feed *f, const char *path, int after) {
    uint8_t *bytes = (uint8_t *)malloc(MOST_BYTES);
    FILE *file = fopen(path, "rb");
    const size_t size = file == NULL ? 0 : fread(bytes, 1, MOST_BYTES, file);
    gt2_tracker *tracker = NULL;
    CHECK(file != NULL && fclose(file) == 0);
    CHECK_OK(gt2_tracker_load(bytes, size, &tracker));
    free(bytes);
    for (int t = 1; t <= END && check_failures == 0; t++) {
        const gt2_frame frame = next_frame(f);
        if (t > after) {
            CHECK_OK(gt2_tracker_step(tracker, &frame));
            printf("%016llx\n", (unsigned long long)hash_results(HASH_OF_NOTHING, tracker));
        }
    }
    gt2_tracker_free(tracker);
    return check_result();
}

/* Lets another process go on, and compares with the hashes of frames 1 to the last one. */
static void compare(const char *program, const char *fixtures, const char *path, int after, const uint64_t *hashes) {
    char command[4096];
    unsigned long long hash = 0;
    int t = after;
    const int length = snprintf(command, sizeof command, "'%s' '%s' '%s' %d", program, fixtures, path, after);
    CHECK(length > 0 && (size_t)length < sizeof command);
    FILE *other = popen(command, "r");
    CHECK(other != NULL);
    while (other != NULL && fscanf(other, "%llx", &hash) == 1) {
        CHECK(t < END && hash == hashes[t + 1]);
        t++;
    }
    CHECK(t == END);
    CHECK(other != NULL && pclose(other) == 0);
}

static void run(const char *program, const char *fixtures, const char *algorithm, feed *f) {
    static uint64_t hashes[END + 1];
    char path[256];
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    int legs = 0;
    size_t tracks = 0;
    CHECK_OK(gt2_config_new(algorithm, &config));
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    for (int t = 1; t <= END; t++) {
        const gt2_frame frame = next_frame(f);
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        CHECK_OK(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list));
        tracks += list.count;
        hashes[t] = hash_results(HASH_OF_NOTHING, tracker);
        if (is_saved_after(t)) {
            snprintf(path, sizeof path, "relay-%s-%d.snapshot", algorithm, t);
            save(tracker, path);
        }
    }
    for (int t = 1; t < END && check_failures == 0; t++) {
        if (is_saved_after(t)) {
            snprintf(path, sizeof path, "relay-%s-%d.snapshot", algorithm, t);
            compare(program, fixtures, path, t, hashes);
            CHECK(remove(path) == 0);
            legs++;
        }
    }
    printf("%-10s goes on in %d other processes, %zu boxes reported\n", algorithm, legs, tracks);
    CHECK(tracks > END);
    gt2_tracker_free(tracker);
}

int main(int count, char **arguments) {
    feed f;
    if (count != 2 && count != 4) {
        fprintf(stderr, "usage: relay FIXTURES\n");
        return 2;
    }
    if (!CHECK(open_feed(&f, arguments[1]))) {
        return 1;
    }
    if (count == 4) {
        return go_on(&f, arguments[2], atoi(arguments[3]));
    }
    printf("through %s\n", f.name);
    for (size_t k = 0; k < gt2_algorithm_count(); k++) {
        f.which = f.frame = 0;
        run(arguments[0], arguments[1], gt2_algorithm_name(k), &f);
    }
    close_feed(&f);
    return check_result();
}
