/* The library tracks: objects that cross, are hidden, or seen by a moving camera keep their identities. */
#include "scene.h"

static gt2_frame frame_of(const gt2_detection *detections, size_t count) {
    gt2_frame frame = GT2_FRAME_INIT;
    frame.detections = detections;
    frame.detection_count = count;
    return frame;
}

static uint64_t track_of(const gt2_tracker *tracker, size_t row) {
    const uint64_t *ids = NULL;
    size_t count = 0;
    CHECK_OK(gt2_tracker_track_of_detection(tracker, &ids, &count));
    return CHECK(row < count) ? ids[row] : 0;
}

/* Two people on almost the same row walk towards each other and past, 6 pixels a frame each. */
static void crossing(void) {
    gt2_tracker *tracker = new_tracker();
    for (int t = 0; t < 60; t++) {
        gt2_detection detections[2];
        detections[0] = scene_detection(100.0 + 6.0 * t, 100.0, 40.0, 100.0);
        detections[1] = scene_detection(460.0 - 6.0 * t, 115.0, 40.0, 100.0);
        detections[0].class_id = 7;
        detections[0].tag = (uint64_t)t;
        const gt2_frame frame = frame_of(detections, 2);
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        CHECK(track_of(tracker, 0) == 1 && track_of(tracker, 1) == 2);
        const gt2_track_list list = tracks_of(tracker, GT2_TRACKS_REPORTED);
        if (!CHECK(list.count == 2)) {
            break;
        }
        for (size_t i = 0; i < list.count; i++) {
            const gt2_track *track = gt2_track_at(&list, i);
            CHECK(track->id == 1 || track->id == 2);
            const gt2_detection *d = &detections[track->id - 1];
            CHECK(fabs(track->left - d->left) < 10.0 && fabs(track->top - d->top) < 10.0);
            CHECK(fabs(track->width - d->width) < 10.0 && fabs(track->height - d->height) < 10.0);
            CHECK(track->detection_index == (int64_t)track->id - 1);
            CHECK(track->class_id == d->class_id && track->tag == d->tag);
            CHECK(fabs(track->score - d->score) == 0.0);
            CHECK(track->state == GT2_TRACK_CONFIRMED && track->frames_since_match == 0);
            CHECK(track->age == (uint32_t)t + 1 && track->hits == (uint32_t)t + 1 && track->reserved == 0);
            if (t >= 20) {
                /* 6 pixels a frame at 30 frames a second: 180 pixels a second. */
                CHECK(fabs(track->velocity_u - (track->id == 1 ? 180.0 : -180.0)) < 45.0);
                CHECK(fabs(track->velocity_v) < 30.0);
            }
        }
    }
    gt2_tracker_free(tracker);
}

/* While the detector rests, tracks move on; the object is found again where it has gone. */
static void detector_skipped(void) {
    gt2_tracker *tracker = new_tracker();
    for (int t = 0; t < 60; t++) {
        const gt2_detection detection = scene_detection(100.0 + 6.0 * t, 100.0, 40.0, 100.0);
        gt2_frame frame = frame_of(&detection, 1);
        if (t % 10 >= 6 && t > 20) {
            frame = frame_of(NULL, 0);
            frame.detector_skipped = 1;
        }
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        if (frame.detection_count > 0) {
            CHECK(track_of(tracker, 0) == 1);
        }
    }
    gt2_tracker_free(tracker);
}

/* The camera jerks by more than a box width; told so, the tracker keeps the identities. */
static void camera_motion(void) {
    gt2_tracker *tracker = new_tracker();
    double shift = 0.0;
    for (int t = 0; t < 40; t++) {
        const double jerk = t == 30 ? 90.0 : 0.0;
        shift += jerk;
        const double motion[6] = {1.0, 0.0, jerk, 0.0, 1.0, 0.0};
        gt2_detection detections[2];
        detections[0] = scene_detection(100.0 + shift, 100.0, 40.0, 100.0);
        detections[1] = scene_detection(190.0 + shift, 100.0, 40.0, 100.0);
        gt2_frame frame = frame_of(detections, 2);
        frame.camera_motion = motion;
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        CHECK(track_of(tracker, 0) == 1 && track_of(tracker, 1) == 2);
    }
    gt2_tracker_free(tracker);
}

static void particles(void) {
    gt2_tracker *tracker = new_tracker();
    scene *s = (scene *)malloc(sizeof *s);
    for (int t = 0; t < 5; t++) {
        scene_fill(s, t);
        CHECK_OK(gt2_tracker_step(tracker, &s->frame));
    }
    gt2_particle_list list = GT2_PARTICLE_LIST_INIT;
    CHECK_OK(gt2_tracker_particles(tracker, 1, &list));
    CHECK(list.count == 8);
    for (size_t i = 0; i < list.count; i++) {
        const gt2_particle *p = gt2_particle_at(&list, i);
        /* Within a box width of the object. */
        CHECK(fabs(p->left - s->detections[0].left) < 40.0 && fabs(p->top - s->detections[0].top) < 40.0);
        CHECK(p->width > 0.0 && p->height > 0.0 && p->fitness >= 0.0 && p->fitness <= 1.0);
    }
    free(s);
    gt2_tracker_free(tracker);
}

/* Three people walk abreast, 3 pixels per frame; the one in the middle is not seen any more. */
static void neighbourhood(void) {
    gt2_tracker *tracker = new_tracker();
    for (int t = 0; t < 25; t++) {
        gt2_detection detections[3];
        for (int i = 0; i < 3; i++) {
            detections[i] = scene_detection(100.0 + 40.0 * i + 3.0 * t, 100.0, 40.0, 100.0);
        }
        if (t >= 20) detections[1] = detections[2];
        gt2_frame frame = frame_of(detections, t < 20 ? 3 : 2);
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        gt2_neighbourhood near = GT2_NEIGHBOURHOOD_INIT;
        CHECK_OK(gt2_tracker_neighbourhood(tracker, 1, &near));
        CHECK(near.neighbours == NULL && near.count == 0 && near.rule == GT2_MOVE_NONE);
        CHECK_OK(gt2_tracker_neighbourhood(tracker, 2, &near));
        if (t < 20) {
            CHECK(near.neighbours == NULL && near.rule == GT2_MOVE_NONE);
            continue;
        }
        CHECK(near.struct_size == sizeof near && near.reserved == 0);
        if (!CHECK(near.count == 2 && near.trusted_count == 2)) continue;
        CHECK(near.neighbours[0] == 1 && near.neighbours[1] == 3);
        CHECK(near.rule == GT2_MOVE_WITH_NEIGHBOURS);
        /* Between the two, at their speed: 3 pixels per frame are 90 per second. */
        CHECK(fabs(near.centre_u - (160.0 + 3.0 * t)) < 2.0 && fabs(near.centre_v - 150.0) < 2.0);
        CHECK(fabs(near.displacement_u - 3.0) < 0.5 && fabs(near.displacement_v) < 0.5);
        CHECK(fabs(near.velocity_u - 90.0) < 10.0 && fabs(near.velocity_v) < 10.0);
    }
    gt2_neighbourhood wrong = GT2_NEIGHBOURHOOD_INIT;
    wrong.struct_size = 1;
    CHECK_STATUS(gt2_tracker_neighbourhood(tracker, 2, &wrong), GT2_ERR_STRUCT_SIZE);
    CHECK_STATUS(gt2_tracker_neighbourhood(tracker, 2, NULL), GT2_ERR_NULL_POINTER);
    /* A program of an older header gets what it knows. */
    wrong.struct_size = offsetof(gt2_neighbourhood, trusted_count);
    wrong.trusted_count = 77;
    CHECK_OK(gt2_tracker_neighbourhood(tracker, 2, &wrong));
    CHECK(wrong.count == 2 && wrong.trusted_count == 77);
    gt2_tracker_free(tracker);
}

int main(void) {
    crossing();
    detector_skipped();
    camera_motion();
    particles();
    neighbourhood();
    return check_result();
}
