/*
 * What a tracker costs: time of a step and memory, on a sequence as bits.c takes them. Run it on the machine that counts.
 * Usage: footprint PATH [ALGORITHM], where without one those that the library has are measured.
 */
#define _POSIX_C_SOURCE 199309L
#include <malloc.h>
#include <time.h>

#include "sequence.h"

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

/* Bytes of the heap in use, those that the allocator got by mmap included. */
static size_t heap(void) {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

static void measure(const char *algorithm, const sequence *s) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    double sum = 0.0, longest = 0.0;
    size_t most = 0, reported = 0;
    CHECK_OK(gt2_config_new(algorithm, &config));
    const size_t before = heap();
    CHECK_OK(gt2_tracker_new(config, &tracker));
    for (int t = 1; t <= FRAMES && tracker != NULL; t++) {
        gt2_frame frame = frame_at(s, t);
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        const double start = now();
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        const double taken = now() - start;
        sum += taken;
        longest = taken > longest ? taken : longest;
        most = heap() - before > most ? heap() - before : most;
        CHECK_OK(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list));
        reported += list.count;
    }
    printf("%-10s  mean step %6.1f us, longest %6.1f us, heap %5zu KiB, %4.1f tracks reported\n", algorithm, sum / FRAMES,
           longest, most / 1024, (double)reported / FRAMES);
    CHECK(reported > 0 && most > 0);
    gt2_tracker_free(tracker);
    gt2_config_free(config);
}

int main(int count, char **arguments) {
    sequence s;
    if (count < 2 || !read_sequence(&s, arguments[1])) {
        fprintf(stderr, "usage: footprint PATH [ALGORITHM]\n");
        return 1;
    }
    for (size_t k = 0; count == 2 && k < gt2_algorithm_count(); k++) {
        measure(gt2_algorithm_name(k), &s);
    }
    if (count > 2) {
        measure(arguments[2], &s);
    }
    free_sequence(&s);
    return check_result();
}
