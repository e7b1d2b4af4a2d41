/* A library of one tracker: it follows, lists nothing else, and says what it cannot do. */
#include <stdio.h>
#include <string.h>

#include <gentrack2.h>

int main(int count, char **arguments) {
    gt2_config *config = NULL, *other = NULL;
    gt2_tracker *tracker = NULL;
    const uint64_t *ids = NULL;
    size_t ids_count = 0;
    if (gt2_config_new("sort", &config) || gt2_config_set(config, "min_hits", "1") || gt2_tracker_new(config, &tracker)) {
        printf("%s\n", gt2_last_error_message());
        return 1;
    }
    for (int t = 0; t < 20; t++) {
        const gt2_detection box = {20.0 + 3 * t, 60, 40, 100, 0.9, 0, 0, 0};
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = &box;
        frame.detection_count = 1;
        if (gt2_tracker_step(tracker, &frame) || gt2_tracker_track_of_detection(tracker, &ids, &ids_count)) {
            return 1;
        }
    }
    const int follows = ids_count == 1 && ids[0] == 1;
    const int alone = gt2_algorithm_count() == 1 && gt2_config_new("gentrack2", &other) == GT2_ERR_UNKNOWN_ALGORITHM;
    const int no_toml = gt2_config_load_toml(config, "max_age = 3", 11) == GT2_ERR_UNSUPPORTED &&
                        strstr(gt2_last_error_message(), "feature toml") != NULL;
    const int no_snapshots = gt2_tracker_save(tracker, NULL, 0, &ids_count) == GT2_ERR_UNSUPPORTED;
    gt2_tracker_free(tracker);
    gt2_config_free(config);

    FILE *self = count > 0 ? fopen(arguments[0], "rb") : NULL;
    long size = 0;
    if (self != NULL && fseek(self, 0, SEEK_END) == 0) {
        size = ftell(self);
        fclose(self);
    }
    printf("only %s: program of %ld KiB; follows %d, alone %d, refuses TOML %d and snapshots %d\n", gt2_algorithm_name(0),
           size / 1024, follows, alone, no_toml, no_snapshots);
    return !(follows && alone && no_toml && no_snapshots);
}
