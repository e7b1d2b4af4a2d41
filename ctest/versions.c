/* What the header says is what the library says. */
#include "scene.h"

static void versions(void) {
    char text[64];
    snprintf(text, sizeof text, "%d.%d.%d", GT2_VERSION_MAJOR, GT2_VERSION_MINOR, GT2_VERSION_PATCH);
    CHECK(strcmp(gt2_version(), GT2_VERSION) == 0);
    CHECK(strcmp(gt2_version(), text) == 0);
    CHECK(gt2_abi_version() == GT2_ABI_VERSION);
}

/* Every status of the header has a name of its own in the library. */
static void statuses(void) {
    static const gt2_status all[] = {
        GT2_OK,
        GT2_ERR_NULL_POINTER,
        GT2_ERR_INVALID_HANDLE,
        GT2_ERR_INVALID_ARGUMENT,
        GT2_ERR_STRUCT_SIZE,
        GT2_ERR_BUFFER_TOO_SMALL,
        GT2_ERR_INVALID_TEXT,
        GT2_ERR_PANIC,
        GT2_ERR_POISONED,
        GT2_ERR_UNSUPPORTED,
        GT2_ERR_DETECTION,
        GT2_ERR_IMAGE,
        GT2_ERR_EMBEDDINGS,
        GT2_ERR_CAMERA_MOTION,
        GT2_ERR_TIMESTAMP,
        GT2_ERR_FRAME,
        GT2_ERR_LIMIT,
        GT2_ERR_UNKNOWN_ALGORITHM,
        GT2_ERR_UNKNOWN_PARAMETER,
        GT2_ERR_PARAMETER_VALUE,
        GT2_ERR_CONFIG_SYNTAX,
        GT2_ERR_UNKNOWN_TRACK,
        GT2_ERR_SNAPSHOT,
    };
    const size_t count = sizeof all / sizeof all[0];
    const char *unknown = gt2_status_str(1);
    CHECK(strcmp(unknown, "unknown status") == 0);
    size_t named = 0;
    for (gt2_status status = -1000; status <= 1000; status++) {
        named += strcmp(gt2_status_str(status), unknown) != 0;
    }
    CHECK(named == count); /* the library knows no status that is missing above */
    for (size_t i = 0; i < count; i++) {
        CHECK(all[i] <= 0 && strcmp(gt2_status_str(all[i]), unknown) != 0);
        for (size_t k = 0; k < i; k++) {
            CHECK(strcmp(gt2_status_str(all[i]), gt2_status_str(all[k])) != 0);
        }
    }
}

/* Accepted pixel formats are exactly those of the header, with the bytes per pixel that it says. */
static void pixel_formats(void) {
    static const struct {
        int32_t format;
        uint32_t bytes;
    } formats[] = {
        {GT2_PIXEL_GRAY8, 1},  {GT2_PIXEL_RGB24, 3}, {GT2_PIXEL_BGR24, 3}, {GT2_PIXEL_RGBA32, 4},
        {GT2_PIXEL_BGRA32, 4}, {GT2_PIXEL_NV12, 1},  {GT2_PIXEL_I420, 1},
    };
    const int32_t count = (int32_t)(sizeof formats / sizeof formats[0]);
    static uint8_t pixels[20 * 10 * 4];
    gt2_tracker *tracker = new_tracker();
    gt2_image image = GT2_IMAGE_INIT;
    gt2_frame frame = GT2_FRAME_INIT;
    image.data = pixels;
    image.width = 20;
    image.height = 10;
    frame.image = &image;
    for (int32_t i = 0; i < count; i++) {
        CHECK(formats[i].format == i);
        image.format = formats[i].format;
        image.stride = 20 * formats[i].bytes;
        CHECK_OK(gt2_tracker_step(tracker, &frame));
        image.stride--;
        CHECK_STATUS(gt2_tracker_step(tracker, &frame), GT2_ERR_IMAGE);
        CHECK_MESSAGE("image.stride: ");
    }
    image.stride = 80;
    image.format = count;
    CHECK_STATUS(gt2_tracker_step(tracker, &frame), GT2_ERR_IMAGE);
    CHECK_MESSAGE("image.format: ");
    image.format = -1;
    CHECK_STATUS(gt2_tracker_step(tracker, &frame), GT2_ERR_IMAGE);
    gt2_tracker_free(tracker);
}

/* So are the kinds of parameters: their texts behave as their kind says. */
static void parameter_kinds(void) {
    gt2_config *config = new_config();
    int seen[6] = {0, 0, 0, 0, 0, 0};
    for (size_t i = 0; i < gt2_config_parameter_count(config); i++) {
        gt2_parameter_info info = GT2_PARAMETER_INFO_INIT;
        CHECK_OK(gt2_config_parameter_info(config, i, &info));
        if (!CHECK(info.kind >= GT2_PARAMETER_NUMBER && info.kind <= GT2_PARAMETER_AREAS)) {
            continue;
        }
        seen[info.kind] = 1;
        const int is_number = info.kind == GT2_PARAMETER_NUMBER || info.kind == GT2_PARAMETER_INTEGER;
        const int is_whole = info.kind == GT2_PARAMETER_INTEGER || info.kind == GT2_PARAMETER_BOOLEAN;
        double number = 0.0;
        int64_t integer = 0;
        CHECK((gt2_config_get_integer(config, info.key, &integer) == GT2_OK) == is_whole);
        CHECK((gt2_config_get_number(config, info.key, &number) == GT2_OK) == (is_number || is_whole));
        CHECK((gt2_config_set(config, info.key, "true") == GT2_OK) == (info.kind == GT2_PARAMETER_BOOLEAN));
        CHECK((gt2_config_set(config, info.key, "1,2,3,4") == GT2_OK) == (info.kind == GT2_PARAMETER_AREAS));
        CHECK((info.choice_count > 0) == (info.kind == GT2_PARAMETER_CHOICE));
        CHECK((info.maximum > info.minimum) == is_number);
    }
    for (int kind = GT2_PARAMETER_NUMBER; kind <= GT2_PARAMETER_AREAS; kind++) {
        CHECK(seen[kind]);
    }
    gt2_config_free(config);
}

int main(void) {
    CHECK(strcmp(gt2_last_error_message(), "") == 0); /* nothing has failed yet */
    versions();
    statuses();
    pixel_formats();
    parameter_kinds();
    return check_result();
}
