/* Medians of the times of the first and of the last steps. */
#ifndef STEP_TIMES_H
#define STEP_TIMES_H

#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct step_times {
    size_t window, count;
    double *first, *last; /* `last` is a ring */
} step_times;

static inline double microseconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

static inline void begin_times(step_times *times, size_t window) {
    times->window = window;
    times->count = 0;
    times->first = (double *)calloc(window, sizeof(double));
    times->last = (double *)calloc(window, sizeof(double));
}

static inline void add_time(step_times *times, double taken) {
    if (times->count < times->window) {
        times->first[times->count] = taken;
    }
    times->last[times->count++ % times->window] = taken;
}

static inline int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline double median(double *values, size_t count) {
    qsort(values, count, sizeof *values, by_size);
    return count > 0 ? values[count / 2] : 0.0;
}

#endif
