/*
 * A GStreamer pipeline in C whose frames are tracked where they lie, with the stream's own timestamps: any file or URL
 * that GStreamer plays. Detections come from a MOTChallenge file, tracks go as MOTChallenge rows to stdout.
 *
 *   gstreamer_appsink walk.mp4 walk-det.txt > walk.txt
 *
 *   cc gstreamer_appsink.c $(pkg-config --cflags --libs gstreamer-app-1.0 gstreamer-video-1.0) -lgentrack2
 */
#include <gst/app/gstappsink.h>
#include <gst/gst.h>
#include <gst/video/video.h>
#include <stdio.h>
#include <stdlib.h>

#include "gentrack2.h"

enum { MOST = 1024 };

static void stop_on_error(gt2_status status) {
    if (status == GT2_OK) return;
    fprintf(stderr, "gentrack2: %s\n", gt2_last_error_message());
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

/* One frame: its luma plane is handed over without a copy. */
static void track(gt2_tracker *tracker, GstSample *sample, struct detections *detections, int number) {
    GstVideoInfo info;
    GstVideoFrame mapped;
    GstBuffer *buffer = gst_sample_get_buffer(sample);
    if (!gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) ||
        !gst_video_frame_map(&mapped, &info, buffer, GST_MAP_READ)) {
        fprintf(stderr, "frame %d cannot be read\n", number);
        exit(EXIT_FAILURE);
    }
    gt2_image image = GT2_IMAGE_INIT;
    image.data = GST_VIDEO_FRAME_PLANE_DATA(&mapped, 0);
    image.stride = (size_t)GST_VIDEO_FRAME_PLANE_STRIDE(&mapped, 0);
    image.width = (uint32_t)GST_VIDEO_FRAME_WIDTH(&mapped);
    image.height = (uint32_t)GST_VIDEO_FRAME_HEIGHT(&mapped);
    image.format = GT2_PIXEL_I420;

    static gt2_detection rows[MOST];
    gt2_frame frame = GT2_FRAME_INIT;
    frame.detections = rows;
    frame.detection_count = detections_of(detections, number, rows);
    frame.image = &image;
    if (GST_BUFFER_PTS_IS_VALID(buffer)) {
        frame.timestamp_ns = (int64_t)GST_BUFFER_PTS(buffer);
        frame.has_timestamp = 1;
    }
    stop_on_error(gt2_tracker_step(tracker, &frame));
    gst_video_frame_unmap(&mapped);

    gt2_track_list list = GT2_TRACK_LIST_INIT;
    stop_on_error(gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list));
    for (size_t i = 0; i < list.count; i++) {
        const gt2_track *k = gt2_track_at(&list, i);
        printf("%d,%llu,%.2f,%.2f,%.2f,%.2f,%.4f,-1,-1,-1\n", number, (unsigned long long)k->id, k->left, k->top,
               k->width, k->height, k->score);
    }
}

int main(int count, char **arguments) {
    struct detections detections = {0};
    detections.file = count == 3 ? fopen(arguments[2], "r") : NULL;
    if (detections.file == NULL) {
        fprintf(stderr, "usage: gstreamer_appsink FILE-OR-URL DETECTIONS, which must be a file\n");
        return EXIT_FAILURE;
    }
    read_ahead(&detections);
    gst_init(NULL, NULL);
    gchar *uri = gst_uri_is_valid(arguments[1]) ? g_strdup(arguments[1]) : gst_filename_to_uri(arguments[1], NULL);
    GError *error = NULL;
    /* For a camera or a live stream add drop=true max-buffers=1: better to miss a frame than to lag behind. */
    GstElement *pipeline = gst_parse_launch("uridecodebin name=source ! videoconvert ! video/x-raw,format=I420 ! "
                                            "appsink name=frames sync=false max-buffers=4", &error);
    if (pipeline == NULL || uri == NULL) {
        fprintf(stderr, "%s\n", error != NULL ? error->message : "no such file");
        return EXIT_FAILURE;
    }
    GstElement *source = gst_bin_get_by_name(GST_BIN(pipeline), "source");
    GstElement *frames = gst_bin_get_by_name(GST_BIN(pipeline), "frames");
    g_object_set(source, "uri", uri, NULL);

    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    stop_on_error(gt2_config_new("gentrack2", &config));
    stop_on_error(gt2_tracker_new(config, &tracker));
    gt2_config_free(config);

    int number = 0;
    GstBus *bus = gst_element_get_bus(pipeline);
    GstMessage *message = NULL;
    gst_element_set_state(pipeline, GST_STATE_PLAYING);
    while (message == NULL && !gst_app_sink_is_eos(GST_APP_SINK(frames))) {
        GstSample *sample = gst_app_sink_try_pull_sample(GST_APP_SINK(frames), 100 * GST_MSECOND);
        if (sample != NULL) {
            track(tracker, sample, &detections, ++number);
            gst_sample_unref(sample);
        } else {
            /* A pipeline that has failed sends neither frames nor an end. */
            message = gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR);
        }
    }
    if (message != NULL) {
        gst_message_parse_error(message, &error, NULL);
        fprintf(stderr, "%s\n", error->message);
        gst_message_unref(message);
    }
    gst_object_unref(bus);
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(source);
    gst_object_unref(frames);
    gst_object_unref(pipeline);
    g_free(uri);
    gt2_tracker_free(tracker);
    fclose(detections.file);
    return message == NULL && number > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
