/*
 * Tracks in raw video without OpenCV: I420 or NV12 frames from stdin, detections from a MOTChallenge file, tracks as
 * MOTChallenge rows to stdout. Only the luma plane is looked at, where it lies: nothing is copied or converted.
 *
 *   ffmpeg -i walk.mp4 -f rawvideo -pix_fmt yuv420p - | raw_yuv 768 576 25 walk-det.txt > walk.txt
 */
#include <stdio.h>
#include <stdlib.h>

#include "gentrack2.h"

enum { MOST = 1024 };

static void stop_on_error(gt2_status status) {
    if (status == GT2_OK) return;
    fprintf(stderr, "raw_yuv: %s\n", gt2_last_error_message());
    exit(EXIT_FAILURE);
}

/* Rows of a MOTChallenge file, frame by frame. Put your own detector here. */
struct detections {
    FILE *file;
    int row_frame; /* frame of the row that was read ahead, 0 for none */
    gt2_detection row;
};

static void read_ahead(struct detections *d) {
    gt2_detection row = {0};
    int frame = 0;
    d->row_frame = 0;
    if (fscanf(d->file, "%d,%*d,%lf,%lf,%lf,%lf,%lf%*[^\n]", &frame, &row.left, &row.top, &row.width, &row.height,
               &row.score) == 6) {
        d->row_frame = frame;
        d->row = row;
    }
}

static size_t detections_of(struct detections *d, int frame, gt2_detection *rows) {
    size_t count = 0;
    while (d->row_frame == frame && count < MOST) {
        rows[count++] = d->row;
        read_ahead(d);
    }
    return count;
}

int main(int count, char **arguments) {
    if (count != 5) {
        fprintf(stderr, "usage: raw_yuv WIDTH HEIGHT FRAMES-PER-SECOND DETECTIONS < FRAMES\n");
        return EXIT_FAILURE;
    }
    const long width = strtol(arguments[1], NULL, 10), height = strtol(arguments[2], NULL, 10);
    struct detections detections = {0};
    detections.file = fopen(arguments[4], "r");
    if (width < 2 || height < 2 || width > 16384 || height > 16384 || detections.file == NULL) {
        fprintf(stderr, "raw_yuv: a size in pixels and a file of detections are needed\n");
        return EXIT_FAILURE;
    }
    read_ahead(&detections);

    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    stop_on_error(gt2_config_new("gentrack2", &config));
    stop_on_error(gt2_config_set(config, "frame_rate", arguments[3]));
    stop_on_error(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);

    /* Both formats have a chroma plane, or two, of half as many bytes behind the luma plane; an odd size is rounded up. */
    const size_t luma = (size_t)width * (size_t)height;
    const size_t size = luma + 2 * (((size_t)width + 1) / 2) * (((size_t)height + 1) / 2);
    unsigned char *pixels = malloc(size);
    static gt2_detection rows[MOST];
    for (int t = 1; pixels != NULL && fread(pixels, 1, size, stdin) == size; t++) {
        gt2_image image = GT2_IMAGE_INIT;
        image.data = pixels;
        image.width = (uint32_t)width;
        image.height = (uint32_t)height;
        image.format = GT2_PIXEL_I420; /* GT2_PIXEL_NV12 is read in the same way */
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = rows;
        frame.detection_count = detections_of(&detections, t, rows);
        frame.image = &image;
        stop_on_error(gt2_tracker_step(tracker, &frame));

        gt2_track_list list = GT2_TRACK_LIST_INIT;
        stop_on_error(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list));
        for (size_t i = 0; i < list.count; i++) {
            const gt2_track *k = gt2_track_at(&list, i);
            printf("%d,%llu,%.2f,%.2f,%.2f,%.2f,%.4f,-1,-1,-1\n", t, (unsigned long long)k->id, k->left, k->top, k->width,
                   k->height, k->score);
        }
    }
    free(pixels);
    gt2_tracker_free(tracker);
    fclose(detections.file);
    return EXIT_SUCCESS;
}
