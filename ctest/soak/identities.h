/* Watches the identities of one tracker for ever, in memory of what is alive now. */
#ifndef IDENTITIES_H
#define IDENTITIES_H

#include <stdlib.h>

#include "../check.h"

typedef struct identities {
    uint64_t *live; /* ascending */
    size_t count, room;
    uint64_t *now; /* of the frame being looked at */
    size_t now_room;
    uint64_t highest;
    uint64_t given; /* so many so far */
} identities;

static inline int by_number(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static inline int was_live(const identities *known, uint64_t id) {
    return known->count > 0 && bsearch(&id, known->live, known->count, sizeof id, by_number) != NULL;
}

/*
 * Looks at the results of a step. An identity is either one of those alive before or greater than all that there ever
 * were, so none is used again; nobody vanishes without an end, and who ended is not listed.
 */
static inline void watch_identities(identities *known, const gt2_tracker *tracker) {
    size_t count = 0, ended_count = 0;
    const uint64_t *ended = NULL;
    uint64_t highest = known->highest;
    for (int32_t kind = GT2_TRACKS_REPORTED; kind <= GT2_TRACKS_LOST; kind++) {
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        CHECK_OK(gt2_tracker_tracks(tracker, kind, &list));
        if (count + list.count > known->now_room) {
            known->now_room = 2 * (count + list.count);
            known->now = (uint64_t *)realloc(known->now, known->now_room * sizeof *known->now);
        }
        for (size_t i = 0; i < list.count; i++) {
            const uint64_t id = gt2_track_at(&list, i)->id;
            const int is_new = id > known->highest;
            CHECK(is_new || was_live(known, id));
            known->given += is_new ? 1 : 0;
            highest = id > highest ? id : highest;
            known->now[count++] = id;
        }
    }
    if (count > 0) {
        qsort(known->now, count, sizeof *known->now, by_number);
    }
    for (size_t i = 1; i < count; i++) {
        CHECK(known->now[i - 1] != known->now[i]);
    }
    CHECK_OK(gt2_tracker_ended(tracker, &ended, &ended_count));
    for (size_t i = 0; i < ended_count; i++) {
        CHECK(was_live(known, ended[i]));
        CHECK(count == 0 || bsearch(&ended[i], known->now, count, sizeof *ended, by_number) == NULL);
    }
    size_t stayed = 0;
    for (size_t i = 0; i < count; i++) {
        stayed += known->now[i] <= known->highest ? 1 : 0;
    }
    CHECK(known->count == stayed + ended_count);
    uint64_t *const spare = known->live;
    const size_t spare_room = known->room;
    known->live = known->now;
    known->room = known->now_room;
    known->now = spare;
    known->now_room = spare_room;
    known->count = count;
    known->highest = highest;
}

static inline void forget_identities(identities *known) {
    free(known->live);
    free(known->now);
}

#endif
