/*
 * A tracker that runs for ever among a broken detector, camera and clock: memory and the time of a step stay as they
 * are, no identity is used twice, a refused frame leaves no trace. Each tracker has a process of its own.
 *
 * Usage: soak FIXTURES FRAMES [--judge-times] [ALGORITHM...], where FIXTURES is tests/fixtures. Loops MOT17-04 if
 * GENTRACK2_SHARED names a directory that has it, else the synthetic sequences. Every fourth frame is garbage, of which
 * four in five must be refused; every 4999th a copy is saved, loaded and released. With --judge-times the exit status says
 * whether times stayed flat, too.
 */
#define _POSIX_C_SOURCE 200112L
#include <sys/wait.h>

#include "../feed.h"
#include "../results_hash.h"
#include "garbage.h"
#include "identities.h"
#include "step_times.h"

enum { WARM_UP = 120, WINDOW = 10000, SAVE_EVERY = 4999 };
/* What resident memory may grow by after the first window, and the median step in the last one, relative to it. */
#define MARGIN_KIB 2048L
#define MOST_RATIO 1.1
/* Identities cross the 32-bit border early. */
#define FIRST_ID (UINT64_C(4294967296) - CROWD - 150)

/* Resident memory of this process in KiB. */
static long resident(void) {
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    CHECK(file != NULL && fscanf(file, "%*d %ld", &pages) == 1);
    if (file != NULL) {
        fclose(file);
    }
    return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

static gt2_tracker *new_tracker(const char *algorithm) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    char first_id[32];
    snprintf(first_id, sizeof first_id, "%llu", (unsigned long long)FIRST_ID);
    CHECK_OK(gt2_config_new(algorithm, &config));
    CHECK_OK(gt2_config_set(config, "first_id", first_id));
    const gt2_status status = gt2_config_set(config, "use_camera_motion", "true");
    CHECK(status == GT2_OK || status == GT2_ERR_UNKNOWN_PARAMETER);
    CHECK_OK(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);
    return tracker;
}

/* A copy that went through bytes shows the same. It does not replace the tracker, whose buffers have their sizes. */
static void save_and_load(const gt2_tracker *tracker) {
    size_t size = 0;
    gt2_tracker *loaded = NULL;
    CHECK_OK(gt2_tracker_save(tracker, NULL, 0, &size));
    uint8_t *bytes = (uint8_t *)malloc(size);
    CHECK_OK(gt2_tracker_save(tracker, bytes, size, &size));
    CHECK_OK(gt2_tracker_load(bytes, size, &loaded));
    CHECK(hash_results(0, loaded) == hash_results(0, tracker));
    free(bytes);
    gt2_tracker_free(loaded);
}

typedef struct run {
    gt2_tracker *tracker;
    garbage *garbage;
    identities identities;
    step_times times;
    int64_t now;
    long accepted, refused;
} run;

static void step_refused(run *r, gt2_frame *frame) {
    const uint64_t before = hash_results(0, r->tracker);
    const gt2_status due = spoil(r->garbage, frame, r->now);
    CHECK_STATUS(gt2_tracker_step(r->tracker, frame), due);
    CHECK(gt2_last_error_message()[0] != 0);
    CHECK(hash_results(0, r->tracker) == before);
    r->refused++;
}

static void step_accepted(run *r, gt2_frame *frame, int is_garbage) {
    r->now += 33333333;
    if (is_garbage) {
        distort(r->garbage, frame, &r->now);
    }
    frame->has_timestamp = 1;
    frame->timestamp_ns = r->now;
    const double start = microseconds();
    CHECK_OK(gt2_tracker_step(r->tracker, frame));
    if (!is_garbage) {
        add_time(&r->times, microseconds() - start);
    }
    watch_identities(&r->identities, r->tracker);
    r->accepted++;
}

/*
 * Buffers grow to the size of the largest pile and the largest crowd, which would else come late. The crowd comes last
 * and stays, so that what tracks leave to later ones, such as deepsort's galleries, has its largest size, too.
 */
static void warm_up(run *r) {
    for (int t = 0; t < WARM_UP && check_failures == 0; t++) {
        gt2_frame frame = crowd_frame(r->garbage);
        if (t < 5) {
            random_boxes(r->garbage, &frame, PILE, 1);
        }
        CHECK_OK(gt2_tracker_step(r->tracker, &frame));
        watch_identities(&r->identities, r->tracker);
    }
}

static int soak(const char *algorithm, feed *f, long frames, int judge_times) {
    run r;
    memset(&r, 0, sizeof r);
    /* Short runs compare tenths. */
    const long window = frames / 10 < WINDOW ? frames / 10 : WINDOW;
    uint64_t random = 7;
    long first = 0;
    r.garbage = (garbage *)malloc(sizeof *r.garbage);
    make_room_for_garbage(r.garbage, 1);
    begin_times(&r.times, (size_t)window);
    r.identities.highest = FIRST_ID - 1;
    r.tracker = new_tracker(algorithm);
    warm_up(&r);
    /* A failure would be followed by as many as there are frames. */
    for (long n = 1; n <= frames && check_failures == 0 && r.tracker != NULL; n++) {
        gt2_frame frame = next_frame(f);
        const int is_garbage = random_below(&random, 4) == 0;
        if (is_garbage && random_below(&random, 5) > 0) {
            step_refused(&r, &frame);
        } else {
            step_accepted(&r, &frame, is_garbage);
        }
        if (n % SAVE_EVERY == 0) {
            save_and_load(r.tracker);
        }
        if (n == window) {
            first = resident();
        }
    }
    const long last = resident();
    const size_t timed = r.times.count < (size_t)window ? r.times.count : (size_t)window;
    const double early = median(r.times.first, timed), late = median(r.times.last, timed);
    const int is_flat = late <= MOST_RATIO * early;
    printf("%-10s %9ld %8ld %9ld %9ld %8.1f %8.1f %6.2f %9llu %12llu%s\n", algorithm, r.accepted, r.refused, first,
           last, early, late, late / early, (unsigned long long)r.identities.given, (unsigned long long)r.identities.highest,
           is_flat ? "" : "  steps became slower");
    CHECK(r.accepted + r.refused == frames && r.refused > 0);
    CHECK(last - first <= MARGIN_KIB);
    CHECK(r.identities.highest > UINT32_MAX);
    CHECK(is_flat || !judge_times);
    forget_identities(&r.identities);
    free(r.times.first);
    free(r.times.last);
    free(r.garbage);
    gt2_tracker_free(r.tracker);
    return check_result();
}

static int soak_in_process(const char *algorithm, feed *f, long frames, int judge_times) {
    int status = 0;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        check_failures = 0;
        const int failed = soak(algorithm, f, frames, judge_times);
        fflush(NULL);
        _exit(failed);
    }
    return CHECK(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int main(int count, char **arguments) {
    feed f;
    const long frames = count > 2 ? strtol(arguments[2], NULL, 10) : 0;
    const int judge_times = count > 3 && strcmp(arguments[3], "--judge-times") == 0;
    const int named = 3 + judge_times;
    if (frames < 1000) {
        fprintf(stderr, "usage: soak FIXTURES FRAMES [--judge-times] [ALGORITHM...], with 1000 FRAMES at least\n");
        return 1;
    }
    if (!CHECK(open_feed(&f, arguments[1]))) {
        return 1;
    }
    printf("looped: %s\n", f.name);
    printf("%-10s %9s %8s %9s %9s %8s %8s %6s %9s %12s\n", "", "accepted", "refused", "KiB first", "KiB last",
           "us first", "us last", "ratio", "ids given", "highest id");
    for (size_t k = 0; count == named && k < gt2_algorithm_count(); k++) {
        soak_in_process(gt2_algorithm_name(k), &f, frames, judge_times);
    }
    for (int i = named; i < count; i++) {
        soak_in_process(arguments[i], &f, frames, judge_times);
    }
    close_feed(&f);
    return check_result();
}
