/* A sequence without an end: MOT17-04 where GENTRACK2_SHARED names a directory that has it, else synthetic ones. POSIX. */
#ifndef FEED_H
#define FEED_H

#include <unistd.h>

#include "sequence.h"

/* Frames of MOT17-04, and the synthetic sequences that put most into a frame. */
enum { MOT17_04 = 1050, SEQUENCES = 3 };
static const char *const synthetic[SEQUENCES] = {"syn_a2", "syn_b2", "syn_b3"};

typedef struct feed {
    sequence sequences[SEQUENCES];
    int count, which, frame;
    const char *name;
} feed;

/* Opens MOT17-04 or, without it, synthetic sequences; gives 0 if they are not what they should be. */
static inline int open_feed(feed *f, const char *fixtures) {
    char path[1024];
    const char *shared = getenv("GENTRACK2_SHARED");
    memset(f, 0, sizeof *f);
    snprintf(path, sizeof path, "%s/mot17/MOT17-04", shared == NULL ? "" : shared);
    if (shared != NULL && access(path, R_OK) == 0) {
        f->count = 1;
        f->name = "MOT17-04";
        return read_files(&f->sequences[0], MOT17_04, path, "/", "embeddings.f32");
    }
    f->name = "synthetic sequences, as GENTRACK2_SHARED does not name a directory with mot17/MOT17-04";
    for (; f->count < SEQUENCES; f->count++) {
        snprintf(path, sizeof path, "%s/oracles/synthetic/%s", fixtures, synthetic[f->count]);
        if (!read_files(&f->sequences[f->count], FRAMES, path, ".", "f32")) {
            return 0;
        }
    }
    return 1;
}

static inline void close_feed(feed *f) {
    for (int i = 0; i < f->count; i++) {
        free_sequence(&f->sequences[i]);
    }
}

/* The next frame, in turns of all sequences. */
static inline gt2_frame next_frame(feed *f) {
    if (++f->frame > f->sequences[f->which].frames) {
        f->frame = 1;
        f->which = (f->which + 1) % f->count;
    }
    gt2_frame frame = frame_at(&f->sequences[f->which], f->frame);
    frame.image_width = 1920;
    frame.image_height = 1080;
    return frame;
}

#endif
