/* Two people walk past each other; a frame is refused, and tracking goes on. */
#include <stdio.h>
#include <string.h>

#include <gentrack2.h>

int main(void) {
    static const char settings[] = "frame_rate = 25\nseed = 7\n";
    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    if (gt2_config_new("gentrack2", &config) || gt2_config_load_toml(config, settings, sizeof settings - 1) ||
        gt2_tracker_new(config, &tracker)) {
        printf("%s\n", gt2_last_error_message());
        return 1;
    }
    gt2_config_free(config);

    unsigned long long first = 0, second = 0;
    int refused = 0;
    for (int t = 0; t < 60; t++) {
        gt2_detection detections[2] = {{100.0 + 6 * t, 100, 40, 100, 0.9, 0, 0, 0}, {460.0 - 6 * t, 115, 40, 100, 0.9, 0, 0, 0}};
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = detections;
        frame.detection_count = 2;
        detections[1].width = t == 30 ? -2 : 40;
        if (gt2_tracker_step(tracker, &frame) != GT2_OK) {
            refused += strstr(gt2_last_error_message(), "detections[1].width") != NULL;
            continue;
        }
        const uint64_t *ids = NULL;
        size_t count = 0;
        if (gt2_tracker_track_of_detection(tracker, &ids, &count) || count != 2) {
            return 1;
        }
        first = ids[0];
        second = ids[1];
    }
    gt2_tracker_free(tracker);
    printf("gentrack2 %s from C99: walkers %llu and %llu, %d frame refused\n", gt2_version(), first, second, refused);
    return !(first == 1 && second == 2 && refused == 1);
}
