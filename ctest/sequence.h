/* A synthetic sequence of tests/fixtures/oracles, as its README describes it. */
#ifndef SEQUENCE_H
#define SEQUENCE_H

#include <stdlib.h>

#include "check.h"

enum { FRAMES = 300, DIMENSION = 16, MOST = 4096 };

typedef struct sequence {
    const char *path;
    gt2_detection *detections;
    float *embeddings;
    size_t first[FRAMES + 2]; /* row of the first detection of frame t, from 1 */
    double motion[FRAMES + 1][6];
    int has_motion;
} sequence;

static inline FILE *open_part(const char *path, const char *ending) {
    char name[1024];
    snprintf(name, sizeof name, "%s%s", path, ending);
    return fopen(name, "rb");
}

/* Reads a sequence; gives 0 if it is not what it should be. */
static inline int read_sequence(sequence *s, const char *path) {
    char line[512];
    size_t rows = 0;
    int frame = 0, last = 0;
    memset(s, 0, sizeof *s);
    s->path = path;
    s->detections = (gt2_detection *)calloc(MOST, sizeof *s->detections * 4);
    s->embeddings = (float *)calloc((size_t)MOST * 4 * DIMENSION, sizeof *s->embeddings);
    FILE *file = open_part(path, ".det.txt");
    if (file == NULL || s->detections == NULL || s->embeddings == NULL) {
        return 0;
    }
    while (fgets(line, sizeof line, file) != NULL && rows < (size_t)MOST * 4) {
        gt2_detection *d = &s->detections[rows];
        if (sscanf(line, "%d,%*d,%lf,%lf,%lf,%lf,%lf", &frame, &d->left, &d->top, &d->width, &d->height, &d->score) != 6 ||
            frame < last || frame > FRAMES) {
            return 0;
        }
        d->tag = rows;
        while (last < frame) {
            s->first[++last] = rows;
        }
        rows++;
    }
    fclose(file);
    while (last <= FRAMES) {
        s->first[++last] = rows;
    }
    file = open_part(path, ".f32");
    if (file == NULL || fread(s->embeddings, sizeof(float) * DIMENSION, rows, file) != rows) {
        return 0;
    }
    fclose(file);
    file = open_part(path, ".gmc.txt");
    s->has_motion = file != NULL;
    for (int t = 1; s->has_motion && t <= FRAMES; t++) {
        double *m = s->motion[t];
        if (fscanf(file, "%*d %lf %lf %lf %lf %lf %lf", &m[0], &m[1], &m[2], &m[3], &m[4], &m[5]) != 6) {
            return 0;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return rows > 0;
}

static inline void free_sequence(sequence *s) {
    free(s->detections);
    free(s->embeddings);
}

/* Frame t, from 1, with all that the sequence has. */
static inline gt2_frame frame_at(const sequence *s, int t) {
    gt2_frame frame = GT2_FRAME_INIT;
    frame.detections = &s->detections[s->first[t]];
    frame.detection_count = s->first[t + 1] - s->first[t];
    frame.embeddings = &s->embeddings[s->first[t] * DIMENSION];
    frame.embedding_dimension = DIMENSION;
    frame.camera_motion = s->has_motion ? s->motion[t] : NULL;
    return frame;
}

#endif
