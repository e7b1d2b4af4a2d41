/* A number for the bits of all results of a step; tests/fixtures/golden/README.md says which bits in which order. */
#ifndef RESULTS_HASH_H
#define RESULTS_HASH_H

#include "check.h"

#define HASH_OF_NOTHING UINT64_C(14695981039346656037)

/* FNV-1a over the bytes of a word, the lowest first. */
static inline uint64_t hash_word(uint64_t hash, uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) {
        hash = (hash ^ ((word >> shift) & 255)) * UINT64_C(1099511628211);
    }
    return hash;
}

static inline uint64_t hash_ids(uint64_t hash, gt2_status (*list)(const gt2_tracker *, const uint64_t **, size_t *),
                                const gt2_tracker *tracker) {
    const uint64_t *ids = NULL;
    size_t count = 0;
    CHECK_OK(list(tracker, &ids, &count));
    hash = hash_word(hash, count);
    for (size_t i = 0; i < count; i++) {
        hash = hash_word(hash, ids[i]);
    }
    return hash;
}

static inline uint64_t hash_track(uint64_t hash, const gt2_track *t) {
    const double numbers[] = {t->left,       t->top,        t->width,      t->height, t->velocity_u,
                              t->velocity_v, t->velocity_w, t->velocity_h, t->score};
    const uint64_t words[] = {(uint64_t)t->detection_index, t->tag, (uint64_t)(int64_t)t->class_id,
                              (uint64_t)(int64_t)t->state,  t->age, t->hits, t->frames_since_match};
    hash = hash_word(hash, t->id);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        uint64_t bits = 0;
        memcpy(&bits, &numbers[i], sizeof bits);
        hash = hash_word(hash, bits);
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        hash = hash_word(hash, words[i]);
    }
    return hash;
}

/* Continues a hash with the results of the last step. */
static inline uint64_t hash_results(uint64_t hash, const gt2_tracker *tracker) {
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        CHECK_OK(gt2_tracker_tracks(tracker, kind, &list));
        hash = hash_word(hash, list.count);
        for (size_t i = 0; i < list.count; i++) {
            hash = hash_track(hash, gt2_track_at(&list, i));
        }
    }
    return hash_ids(hash_ids(hash, gt2_tracker_ended, tracker), gt2_tracker_track_of_detection, tracker);
}

#endif
