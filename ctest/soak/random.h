/* Random numbers, the same in every run: SplitMix64. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

static inline uint64_t random_bits(uint64_t *state) {
    uint64_t x = *state += UINT64_C(0x9E3779B97F4A7C15);
    x = (x ^ (x >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94D049BB133111EB);
    return x ^ (x >> 31);
}

/* Uniform in [low, high). */
static inline double random_between(uint64_t *state, double low, double high) {
    return low + (high - low) * (double)(random_bits(state) >> 11) / 9007199254740992.0;
}

/* Uniform in 0 .. n - 1. */
static inline size_t random_below(uint64_t *state, size_t n) { return (size_t)(random_bits(state) % n); }

#endif
