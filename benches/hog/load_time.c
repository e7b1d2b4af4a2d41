/* How long it takes to load the library: microseconds of dlopen and of its first call, and the same for a library that
 * every program has, libc's own libm, to compare with.
 *
 *   usage: load_time LIBRARY
 */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { RUNS = 31 };

static double now_us(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

/* In a process of its own each time, as nobody loads a library twice. */
static double once(const char *path, const char *symbol) {
    int ends[2];
    double took = -1;
    if (pipe(ends) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
        const double start = now_us();
        void *library = dlopen(path, RTLD_NOW);
        if (library && dlsym(library, symbol)) took = now_us() - start;
        const int written = write(ends[1], &took, sizeof took) == (ssize_t)sizeof took;
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    if (child < 0 || read(ends[0], &took, sizeof took) != (ssize_t)sizeof took) took = -1;
    close(ends[0]);
    if (child > 0) waitpid(child, NULL, 0);
    return took;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const char *path, const char *symbol) {
    double times[RUNS];
    for (int i = 0; i < RUNS; i++) times[i] = once(path, symbol);
    qsort(times, RUNS, sizeof *times, ascending);
    return times[0] < 0 ? -1 : times[RUNS / 2];
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: load_time LIBRARY\n");
        return 2;
    }
    const double ours = median(argv[1], "gt2_abi_version"), libm = median("libm.so.6", "sqrt");
    if (ours < 0) {
        fprintf(stderr, "load_time: cannot load %s\n", argv[1]);
        return 1;
    }
    printf("load_us %.1f\nload_libm_us %.1f\n", ours, libm);
    return 0;
}
