/*
 * gentrack2 from plain C99, without OpenCV: two people walk towards each other and cross in a synthetic grey image,
 * the detector misses one of them while they overlap, and everyone keeps their number.
 *
 *   cc plain_c.c -lgentrack2 && ./a.out
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gentrack2.h"

enum { WIDTH = 320, HEIGHT = 240, FRAMES = 60 };

/* One person: where they start and how many pixels they walk per frame. */
struct person {
    double left, top, step;
};

static const struct person people[2] = {{20, 60, 4}, {260, 66, -4}};

static void stop_on_error(gt2_status status) {
    if (status == GT2_OK) return;
    fprintf(stderr, "gentrack2: %s\n", gt2_last_error_message());
    exit(EXIT_FAILURE);
}

/* Draws a person with stripes of their own, so that appearance tells the two apart. */
static void draw(unsigned char *image, const gt2_detection *box, int number) {
    for (int y = 0; y < (int)box->height; ++y) {
        for (int x = 0; x < (int)box->width; ++x) {
            int column = (int)box->left + x, row = (int)box->top + y;
            if (column < 0 || column >= WIDTH || row < 0 || row >= HEIGHT) continue;
            int stripe = number == 0 ? x / 6 : y / 6;
            image[row * WIDTH + column] = stripe % 2 ? 220 : 30;
        }
    }
}

int main(void) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    stop_on_error(gt2_config_new("gentrack2", &config));
    stop_on_error(gt2_config_set(config, "frame_rate", "25"));
    stop_on_error(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);

    static unsigned char pixels[WIDTH * HEIGHT];
    gt2_image image = GT2_IMAGE_INIT;
    image.data = pixels;
    image.width = WIDTH;
    image.height = HEIGHT;
    image.stride = WIDTH;
    image.format = GT2_PIXEL_GRAY8;

    uint64_t first_identity[2] = {0, 0}, identity[2] = {0, 0};
    for (int t = 0; t < FRAMES; ++t) {
        gt2_detection detections[2];
        size_t count = 0;
        memset(pixels, 128, sizeof pixels);
        for (int p = 1; p >= 0; --p) {
            gt2_detection d = {0};
            d.left = people[p].left + people[p].step * t;
            d.top = people[p].top;
            d.width = 40;
            d.height = 100;
            d.score = 0.9;
            d.tag = (uint64_t)p; /* comes back on the track */
            draw(pixels, &d, p);
            /* The person behind is not seen while the other covers them. */
            if (p == 1 && t >= 27 && t <= 33) continue;
            detections[count++] = d;
        }

        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = detections;
        frame.detection_count = count;
        frame.image = &image;
        stop_on_error(gt2_tracker_step(tracker, &frame));

        gt2_track_list tracks = GT2_TRACK_LIST_INIT;
        stop_on_error(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &tracks));
        for (size_t i = 0; i < tracks.count; ++i) {
            const gt2_track *track = gt2_track_at(&tracks, i);
            if (track->detection_index < 0) continue; /* predicted */
            if (first_identity[track->tag] == 0) first_identity[track->tag] = track->id;
            identity[track->tag] = track->id;
            if (t % 10 == 0) {
                printf("frame %2d  id %llu  left %6.1f  top %5.1f  %4.0f px/s\n", t, (unsigned long long)track->id,
                       track->left, track->top, track->velocity_u);
            }
        }
    }
    gt2_tracker_free(tracker);

    int kept = identity[0] != 0 && identity[1] != 0 && identity[0] != identity[1] &&
               identity[0] == first_identity[0] && identity[1] == first_identity[1];
    puts(kept ? "both kept their identity" : "identities were lost");
    return kept ? EXIT_SUCCESS : EXIT_FAILURE;
}
