/*
 * A host that has its tracker as a plugin: it loads the library, uses it, unloads it, and does so again. Usage:
 *   plugin_host libgentrack2.so.0
 */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include <gentrack2.h> /* for the types; nothing is linked */

/* POSIX's way to make a function's pointer of an object's. */
#define LOAD(function)                                                                                                 \
    do {                                                                                                               \
        void *symbol = dlsym(library, #function);                                                                      \
        if (symbol == NULL) return fprintf(stderr, "%s\n", dlerror()), 0;                                              \
        memcpy(&function##_, &symbol, sizeof symbol);                                                                  \
    } while (0)

/* Tracks a walker with the library, provokes an error, and gives the number of the track, 0 for a failure. */
static unsigned long long use(void *library) {
    gt2_status (*gt2_config_new_)(const char *, gt2_config **);
    gt2_status (*gt2_tracker_new_)(const gt2_config *, gt2_tracker **);
    gt2_status (*gt2_tracker_step_)(gt2_tracker *, const gt2_frame *);
    gt2_status (*gt2_tracker_tracks_)(const gt2_tracker *, int32_t, gt2_track_list *);
    void (*gt2_config_free_)(gt2_config *);
    void (*gt2_tracker_free_)(gt2_tracker *);
    const char *(*gt2_last_error_message_)(void);
    LOAD(gt2_config_new);
    LOAD(gt2_tracker_new);
    LOAD(gt2_tracker_step);
    LOAD(gt2_tracker_tracks);
    LOAD(gt2_config_free);
    LOAD(gt2_tracker_free);
    LOAD(gt2_last_error_message);

    gt2_config *config = NULL;
    gt2_tracker *tracker = NULL;
    if (gt2_last_error_message_()[0] != '\0') return 0; /* a library that was loaded anew has had no error */
    if (gt2_config_new_("no such tracker", &config) != GT2_ERR_UNKNOWN_ALGORITHM) return 0;
    if (gt2_config_new_("gentrack2", &config) != GT2_OK || gt2_tracker_new_(config, &tracker) != GT2_OK) return 0;
    gt2_config_free_(config);
    unsigned long long id = 0;
    for (int t = 0; t < 30; t++) {
        const gt2_detection walker = {20.0 + 3 * t, 60, 40, 100, 0.9, 0, 0, 0};
        gt2_frame frame = GT2_FRAME_INIT;
        frame.detections = &walker;
        frame.detection_count = 1;
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        if (gt2_tracker_step_(tracker, &frame) || gt2_tracker_tracks_(tracker, GT2_TRACKS_REPORTED, &list)) return 0;
        id = list.count == 1 ? gt2_track_at(&list, 0)->id : 0;
    }
    gt2_tracker_free_(tracker);
    return id;
}

int main(int count, char **arguments) {
    if (count != 2) return 2;
    for (int round = 1; round <= 2; round++) {
        void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
        if (library == NULL) return fprintf(stderr, "%s\n", dlerror()), 1;
        const unsigned long long id = use(library);
        if (dlclose(library) != 0) return 1;
        const int gone = dlopen(arguments[1], RTLD_NOW | RTLD_NOLOAD) == NULL;
        printf("round %d: track %llu, library %s\n", round, id, gone ? "unloaded" : "still there");
        if (id != 1 || !gone) return 1;
    }
    return 0;
}
