/* Sequences of frames from files: those of tests/fixtures/oracles, as its README describes them, and MOT17's. */
#ifndef SEQUENCE_H
#define SEQUENCE_H

#include <stdlib.h>

#include "check.h"

/* Frames of a synthetic sequence, some of the last ones without detections, and numbers per embedding. */
enum { FRAMES = 300, DIMENSION = 16 };

typedef struct sequence {
    const char *path; /* of a synthetic one */
    int frames;
    gt2_detection *detections;
    float *embeddings;
    size_t *first; /* row of the first detection of frame t, from 1 */
    double (*motion)[6];
    int has_motion;
} sequence;

/* A file PATH.ENDING or PATH/ENDING. */
static inline FILE *open_part(const char *path, const char *separator, const char *ending) {
    char name[2048];
    const int length = snprintf(name, sizeof name, "%s%s%s", path, separator, ending);
    return length > 0 && (size_t)length < sizeof name ? fopen(name, "rb") : NULL;
}

static inline size_t count_lines(FILE *file) {
    size_t lines = 0;
    for (int c = fgetc(file); c != EOF; c = fgetc(file)) {
        lines += c == '\n';
    }
    rewind(file);
    return lines;
}

static inline int read_detections(sequence *s, FILE *file, size_t rows) {
    char line[512];
    int frame = 0, last = 0;
    for (size_t row = 0; row < rows; row++) {
        gt2_detection *d = &s->detections[row];
        if (fgets(line, sizeof line, file) == NULL) {
            return 0;
        }
        const int fields = sscanf(line, "%d,%*d,%lf,%lf,%lf,%lf,%lf", &frame, &d->left, &d->top, &d->width, &d->height,
                                  &d->score);
        if (fields != 6 || frame < last || frame > s->frames) {
            return 0;
        }
        d->tag = row;
        d->class_id = (int32_t)(row % 3);
        while (last < frame) {
            s->first[++last] = row;
        }
    }
    while (last <= s->frames) {
        s->first[++last] = rows;
    }
    return 1;
}

static inline int read_motion(sequence *s, FILE *file) {
    for (int t = 1; t <= s->frames; t++) {
        double *m = s->motion[t];
        if (fscanf(file, "%*d %lf %lf %lf %lf %lf %lf", &m[0], &m[1], &m[2], &m[3], &m[4], &m[5]) != 6) {
            return 0;
        }
    }
    return 1;
}

/* Reads so many frames from files whose names begin alike; gives 0 if it is not what it should be. The camera's motion
 * may be missing. */
static inline int read_files(sequence *s, int frames, const char *path, const char *separator, const char *embeddings) {
    memset(s, 0, sizeof *s);
    s->frames = frames;
    FILE *file = open_part(path, separator, "det.txt");
    const size_t rows = file == NULL ? 0 : count_lines(file);
    if (rows == 0) {
        return 0;
    }
    s->detections = (gt2_detection *)calloc(rows, sizeof *s->detections);
    s->embeddings = (float *)calloc(rows * DIMENSION, sizeof *s->embeddings);
    s->first = (size_t *)calloc((size_t)frames + 2, sizeof *s->first);
    s->motion = (double(*)[6])calloc((size_t)frames + 1, sizeof *s->motion);
    int good = s->detections && s->embeddings && s->first && s->motion && read_detections(s, file, rows);
    fclose(file);
    file = open_part(path, separator, embeddings);
    good = good && file != NULL && fread(s->embeddings, sizeof(float) * DIMENSION, rows, file) == rows;
    if (file != NULL) {
        fclose(file);
    }
    file = open_part(path, separator, "gmc.txt");
    s->has_motion = file != NULL;
    if (file != NULL) {
        good = good && read_motion(s, file);
        fclose(file);
    }
    return good;
}

/* Reads a synthetic sequence. */
static inline int read_sequence(sequence *s, const char *path) {
    const int good = read_files(s, FRAMES, path, ".", "f32");
    s->path = path;
    return good;
}

static inline void free_sequence(sequence *s) {
    free(s->detections);
    free(s->embeddings);
    free(s->first);
    free(s->motion);
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
