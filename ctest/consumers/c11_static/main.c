/* Every tracker of the library follows one walker. */
#include <stdio.h>

#include <gentrack2.h>

_Static_assert(sizeof(gt2_detection) % _Alignof(gt2_detection) == 0, "detections are laid out as an array");

static uint64_t follow(const char *algorithm) {
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    uint64_t id = 0;
    if (gt2_config_new(algorithm, &config) != GT2_OK || gt2_tracker_new(config, &tracker) != GT2_OK) {
        printf("%s: %s\n", algorithm, gt2_last_error_message());
    }
    for (int t = 0; t < 30 && tracker != NULL; t++) {
        const gt2_detection walker = {.left = 20.0 + 3 * t, .top = 60, .width = 40, .height = 100, .score = 0.95};
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = &walker;
        frame.detection_count = 1;
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        if (gt2_tracker_step(tracker, &frame) != GT2_OK ||
            gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list) != GT2_OK) {
            printf("%s: %s\n", algorithm, gt2_last_error_message());
            break;
        }
        id = list.count == 1 ? gt2_track_at(&list, 0)->id : 0;
    }
    gt2_tracker_free(tracker);
    gt2_config_free(config);
    return id;
}

int main(void) {
    size_t followed = 0;
    for (size_t i = 0; i < gt2_algorithm_count(); i++) {
        followed += follow(gt2_algorithm_name(i)) == 1;
    }
    printf("gentrack2 %s from C11, static: %zu of %zu trackers follow\n", gt2_version(), followed, gt2_algorithm_count());
    return followed == 0 || followed != gt2_algorithm_count();
}
