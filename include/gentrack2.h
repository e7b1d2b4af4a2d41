/*
 * gentrack2: multi-object tracking. Per frame, detections go in and identities that last come out.
 *
 * This file is generated from the Rust sources by cbindgen and is the manual of the C interface. It is valid C99 and
 * C++11; gentrack2.hpp wraps it for C++17.
 *
 * EXAMPLE
 *
 *     gt2_config *config = NULL;
 *     gt2_tracker *tracker = NULL;
 *     if (gt2_config_new("gentrack2", &config) != GT2_OK || gt2_config_set(config, "frame_rate", "25") != GT2_OK ||
 *         gt2_tracker_new(config, &tracker) != GT2_OK) {
 *         fprintf(stderr, "%s\n", gt2_last_error_message());
 *         exit(1);
 *     }
 *     gt2_config_free(config);
 *     while (next_frame(detections, &count)) {                      // your detector fills an array of gt2_detection
 *         gt2_frame frame = GT2_FRAME_INIT;
 *         frame.detections = detections;
 *         frame.detection_count = count;
 *         if (gt2_tracker_step(tracker, &frame) != GT2_OK) {
 *             fprintf(stderr, "%s\n", gt2_last_error_message());    // the tracker is as before the call
 *             continue;
 *         }
 *         gt2_track_list list = GT2_TRACK_LIST_INIT;
 *         gt2_tracker_tracks(tracker, GT2_TRACKS_REPORTED, &list);
 *         for (size_t i = 0; i < list.count; i++) {
 *             const gt2_track *track = gt2_track_at(&list, i);
 *             printf("%llu: %g %g %g %g\n", (unsigned long long)track->id, track->left, track->top, track->width,
 *                    track->height);
 *         }
 *     }
 *     gt2_tracker_free(tracker);
 *
 * Step every frame of the video, those without detections too: that nothing was detected is information. If the
 * detector did not run on a frame, step it with detector_skipped = 1.
 *
 * ALGORITHMS
 *
 * gt2_config_new takes the name of one: gentrack2, or one of those it is compared with, sort, deepsort, bytetrack,
 * botsort, ocsort, smiletrack, conftrack, which do what their published programs do. gt2_algorithm_count and
 * gt2_algorithm_name list them, gt2_config_parameter_info their parameters. What a frame brings beside detections is
 * used by those that can: the image by gentrack2, embeddings by gentrack2, deepsort, botsort, smiletrack and conftrack,
 * camera motion by gentrack2, botsort, smiletrack and conftrack, and by the others with use_camera_motion. Timestamps,
 * detector_skipped and the parameter class_policy work with all of them.
 *
 * RULES THAT HOLD EVERYWHERE
 *
 * Errors. Functions that can fail return a gt2_status: GT2_OK (0) or a negative GT2_ERR_...; gt2_last_error_message
 * tells what exactly was wrong. After an error outputs are not written and the handle is as before (the exceptions
 * say so). Besides the errors listed with a function, every function that takes a handle may return
 * GT2_ERR_NULL_POINTER, GT2_ERR_INVALID_HANDLE, GT2_ERR_PANIC and GT2_ERR_POISONED. Lookups that return a count, name or text
 * directly return 0 or NULL on an error. The library never prints, never exits, and reads no environment variable.
 *
 * Memory. Handles made by gt2_..._new or _clone are released by the matching gt2_..._free, once; freeing NULL does
 * nothing. What you pass in is yours and is read during the call only. Lists that come out are borrowed: they
 * belong to the tracker, are not to be freed, and end with its next step (a successful one), reset or release. Texts
 * marked static live as long as the library is loaded.
 *
 * Zero and NULL. An array of length 0 may be NULL; NULL with a length is an error. Structs that are all zero are legal
 * and mean the default.
 *
 * Growth. Structs that you fill start with struct_size, which the GT2_..._INIT macros set: a program compiled with an
 * older header keeps working, and one compiled with a newer header is refused only if it uses fields that the library
 * does not know. Set struct_size (or use the macros): 0 stands for the first published layout, whose fields all exist,
 * but fields added later are then ignored.
 *
 * Threads. There is no global state but the last error of each thread. Different handles may be used by different
 * threads at the same time. One handle is for one thread at a time, except that functions that take it as const may
 * run at the same time as each other. A handle may be used by another thread than the one that made it.
 *
 * Results. The same input, config and seed give bit-identical results, on every platform. Coordinates are pixels with
 * y downwards; boxes are given by their left-top corner and size; times are in nanoseconds, velocities in pixels per
 * second.
 */

#ifndef GENTRACK2_H
#define GENTRACK2_H

#include <stddef.h>
#include <stdint.h>

/// Version of this header as text; `gt2_version()` is that of the library at run time.
#define GT2_VERSION "0.1.0"


/// Version of this header: the library's major version. `gt2_version` is the version of the library at run time.
#define GT2_VERSION_MAJOR 0

/// Version of this header: the library's minor version.
#define GT2_VERSION_MINOR 1

/// Version of this header: the library's patch version.
#define GT2_VERSION_PATCH 0

/// Version of the binary interface described by this header. A program works with every library whose
/// `gt2_abi_version` is equal: functions and struct fields are only ever added, at the end. It is also the number in
/// the shared library's SONAME (`libgentrack2.so.0`).
#define GT2_ABI_VERSION 0

/// Success.
#define GT2_OK 0

/// A pointer that must not be NULL is NULL.
#define GT2_ERR_NULL_POINTER -1

/// A handle that is not of this type, or has been freed. Detected where possible: this is an aid in finding bugs,
/// not a licence to use freed handles.
#define GT2_ERR_INVALID_HANDLE -2

/// An index, kind or flag out of its range, a misaligned array, or a size or stride that does not fit.
#define GT2_ERR_INVALID_ARGUMENT -3

/// A `struct_size` that makes no sense, or a struct of a newer header that uses fields this library does not know.
#define GT2_ERR_STRUCT_SIZE -4

/// A buffer that is too small; the size that is needed has been stored.
#define GT2_ERR_BUFFER_TOO_SMALL -5

/// A text that is not UTF-8.
#define GT2_ERR_INVALID_TEXT -6

/// An internal error was caught: a bug in the library, please report its message. The handle is poisoned.
#define GT2_ERR_PANIC -7

/// The handle met an internal error before. A tracker works again after `gt2_tracker_reset`; a config can only be
/// freed.
#define GT2_ERR_POISONED -8

/// This build of the library leaves out what the function needs. A library built with the defaults has everything.
#define GT2_ERR_UNSUPPORTED -9

/// A field of a detection is out of range.
#define GT2_ERR_DETECTION -20

/// The image's size, stride, format and buffer do not fit together.
#define GT2_ERR_IMAGE -21

/// Embeddings that do not fit the detections or the frames before, or are not finite.
#define GT2_ERR_EMBEDDINGS -22

/// A camera motion that is not finite, not invertible or scales beyond reason.
#define GT2_ERR_CAMERA_MOTION -23

/// A timestamp that is not greater than the one before.
#define GT2_ERR_TIMESTAMP -24

/// Another field of the frame is out of range or contradicts the others.
#define GT2_ERR_FRAME -25

/// More of something than a parameter of the config allows.
#define GT2_ERR_LIMIT -26

/// No algorithm of that name.
#define GT2_ERR_UNKNOWN_ALGORITHM -40

/// No parameter of that key.
#define GT2_ERR_UNKNOWN_PARAMETER -41

/// A parameter's value is of the wrong kind or out of range, or values contradict each other.
#define GT2_ERR_PARAMETER_VALUE -42

/// Text that is not valid TOML, or not of the expected shape.
#define GT2_ERR_CONFIG_SYNTAX -43

/// No live track has that identity.
#define GT2_ERR_UNKNOWN_TRACK -44

/// Bytes that are no snapshot of a tracker, a damaged one, or one of a later version of the library.
#define GT2_ERR_SNAPSHOT -45

/// A parameter that is a real number.
#define GT2_PARAMETER_NUMBER 1

/// A parameter that is a whole number.
#define GT2_PARAMETER_INTEGER 2

/// A parameter that is true or false.
#define GT2_PARAMETER_BOOLEAN 3

/// A parameter that is one of a list of names.
#define GT2_PARAMETER_CHOICE 4

/// A parameter that is a list of rectangles in pixels; as text "left,top,width,height;left,top,width,height;...".
#define GT2_PARAMETER_AREAS 5

/// One byte of brightness per pixel.
#define GT2_PIXEL_GRAY8 0

/// Three bytes per pixel: red, green, blue.
#define GT2_PIXEL_RGB24 1

/// Three bytes per pixel: blue, green, red (OpenCV's order).
#define GT2_PIXEL_BGR24 2

/// Four bytes per pixel: red, green, blue, alpha (not read).
#define GT2_PIXEL_RGBA32 3

/// Four bytes per pixel: blue, green, red, alpha (not read).
#define GT2_PIXEL_BGRA32 4

/// A plane of one byte of brightness per pixel; the chroma plane is never read and need not be there.
#define GT2_PIXEL_NV12 5

/// A plane of one byte of brightness per pixel; the chroma planes are never read and need not be there.
#define GT2_PIXEL_I420 6

/// State of a track: born recently, not yet trusted.
#define GT2_TRACK_TENTATIVE 1

/// State of a track: trusted, and matched with a detection when the detector last ran.
#define GT2_TRACK_CONFIRMED 2

/// State of a track: trusted, but without a detection when the detector last ran; its box is a prediction.
#define GT2_TRACK_LOST 3

/// Kind of list: what the tracker stands for in this frame, what a user draws or writes to a file: matched tracks,
/// and lost ones whose predicted box is trusted. Some of the compared trackers report new tracks at once, which then
/// are in this list with the state `GT2_TRACK_TENTATIVE`: botsort and smiletrack always, conftrack in the first frame.
#define GT2_TRACKS_REPORTED 0

/// Kind of list: tracks too young to be reported; with sort and ocsort also those seen again after a miss until they
/// have been seen often enough in a row, and with gentrack2 those whose box, of doubtful score, is mostly beyond the
/// image's border.
#define GT2_TRACKS_TENTATIVE 1

/// Kind of list: live tracks without a detection that are not reported, with their predicted box.
#define GT2_TRACKS_LOST 2

/// Rule that moved a track: none of those below; it has a detection, or its algorithm has no such rules.
#define GT2_MOVE_NONE 0

/// Rule that moved a track: it stays where it is, its speed being below the parameter still_speed.
#define GT2_MOVE_STILL 1

/// Rule that moved a track: its own velocity (eq. 12 of the paper), for want of trustworthy neighbours that move, or
/// because it overtakes them.
#define GT2_MOVE_OWN 2

/// Rule that moved a track: the median displacement of its trustworthy neighbours (eq. 13, first case), which move as
/// it does.
#define GT2_MOVE_WITH_NEIGHBOURS 3

/// Rule that moved a track: around its trustworthy neighbours (eq. 13, second case, and eq. 14), which move otherwise.
#define GT2_MOVE_AROUND 4

/// An algorithm with all its parameters, chosen and set by name. Made by `gt2_config_new` or `gt2_config_clone`,
/// released by `gt2_config_free`. A tracker copies its config, so one config can serve many trackers.
typedef struct gt2_config gt2_config;

/// Tracks the objects of one video stream. Made by `gt2_tracker_new`, released by `gt2_tracker_free`.
typedef struct gt2_tracker gt2_tracker;

/// Result of every function that can fail: `GT2_OK` or one of the negative `GT2_ERR_...`. Numbers never change
/// meaning; later versions may add some, so treat every negative number as an error.
typedef int32_t gt2_status;

/// Description of one parameter, filled by `gt2_config_parameter_info`. Start from `GT2_PARAMETER_INFO_INIT`. All
/// texts are static.
typedef struct gt2_parameter_info {
    /// `sizeof(gt2_parameter_info)`, set by the caller.
    size_t struct_size;
    /// Name by which it is set.
    const char *key;
    /// One of `GT2_PARAMETER_...`.
    int32_t kind;
    /// 0.
    int32_t reserved;
    /// Value in a new config, as text.
    const char *default_text;
    /// Smallest value of a number or integer, otherwise 0.
    double minimum;
    /// Largest value of a number or integer, otherwise 0.
    double maximum;
    /// Unit; "" for pure numbers. A tick is 1/30 s.
    const char *unit;
    /// The symbol of the paper that the parameter comes from; "" if it has none.
    const char *symbol;
    /// One paragraph of English.
    const char *documentation;
    /// The names of a choice, `choice_count` of them; NULL for other kinds.
    const char *const *choices;
    /// How many `choices` there are.
    size_t choice_count;
} gt2_parameter_info;

/// One detection. All zero is an empty box of score 0, which is legal. Boxes may reach or lie outside the image.
typedef struct gt2_detection {
    /// Left edge in pixels; finite, of at most 1e12 like all coordinates.
    double left;
    /// Top edge in pixels; y points down.
    double top;
    /// Width in pixels, not negative. A box of zero width or height (less than 1e-6) is accepted; with gentrack2 it
    /// belongs to no track, as it overlaps no other box. The other algorithms do with it what their publications do.
    double width;
    /// Height in pixels, not negative.
    double height;
    /// Confidence of the detector, in 0..=1.
    double score;
    /// Class of the object, any number; comes back on the track.
    int32_t class_id;
    /// Must be 0.
    int32_t reserved;
    /// Any number of the caller's; comes back on the track that takes this detection.
    uint64_t tag;
} gt2_detection;

/// An image in the caller's memory, read during `gt2_tracker_step` only. Start from `GT2_IMAGE_INIT`.
typedef struct gt2_image {
    /// `sizeof(gt2_image)`; 0 stands for the first published layout of this struct.
    size_t struct_size;
    /// The left-top pixel; of planar formats that of the luma plane. The memory must reach to the last pixel of the
    /// last row, `stride * (height - 1) + width * bytes per pixel`.
    const uint8_t *data;
    /// Bytes from the start of a row to the start of the next; 0 for rows without padding.
    size_t stride;
    /// Width in pixels, in 1..=65535; width times height at most the parameter max_image_pixels.
    uint32_t width;
    /// Height in pixels, in 1..=65535.
    uint32_t height;
    /// One of `GT2_PIXEL_...`.
    int32_t format;
    /// Must be 0.
    int32_t reserved;
} gt2_image;

/// What is known about one frame. Start from `GT2_FRAME_INIT`, or from all zeros, and fill in what there is. All
/// memory it points to is the caller's and is read during `gt2_tracker_step` only.
typedef struct gt2_frame {
    /// `sizeof(gt2_frame)`; 0 stands for the first published layout of this struct.
    size_t struct_size;
    /// The detections, `detection_count` of them. None at all is normal.
    const struct gt2_detection *detections;
    /// Number of detections, at most the parameter max_detections.
    size_t detection_count;
    /// Bytes from one detection to the next, at least `sizeof(gt2_detection)`; more if they are part of a larger
    /// struct of the caller's. 0 stands for the first published size of `gt2_detection`.
    size_t detection_stride;
    /// Appearance embeddings (re-identification features) of the detections, one row per detection in the same
    /// order, finite; NULL if there are none. They need not be normalised.
    const float *embeddings;
    /// Floats per embedding, at most the parameter max_embedding_dimension, the same for all frames until the tracker
    /// is reset; 0 without embeddings.
    size_t embedding_dimension;
    /// Floats from the start of one embedding to the start of the next; 0 for `embedding_dimension`.
    size_t embedding_stride;
    /// The image, NULL if there is none. Trackers that look at appearance use it, the others do not mind it.
    const struct gt2_image *image;
    /// How the camera moved: 6 numbers a b c d e f that take a point (x, y) of the previous frame to
    /// (a x + b y + c, d x + e y + f) in this one, in pixels (OpenCV's 2x3 affine matrix, row by row). NULL if it
    /// is not known; the identity says that it stood still, which trackers then need not guess.
    const double *camera_motion;
    /// Width of the frame in pixels where no image is given, otherwise 0 or the image's; 0 with `image_height` 0 if
    /// unknown. gentrack2 ends tracks sooner that are known to be out of the frame, and takes boxes that are mostly
    /// beyond its border less seriously.
    uint32_t image_width;
    /// Height of the frame in pixels, as `image_width`.
    uint32_t image_height;
    /// With `has_timestamp` 1: when the frame was taken, in nanoseconds from any fixed origin, greater than in the
    /// frame before. Motion and lifetimes follow the time that passed.
    int64_t timestamp_ns;
    /// 1 if `timestamp_ns` is set; 0: it is ignored, the frame comes one interval of the parameter frame_rate after
    /// the one before.
    int32_t has_timestamp;
    /// 1 if the detector did not run on this frame (and there are no detections): tracks move on and are not blamed
    /// for a miss. 0 if it ran, even if it found nothing. Time passes all the same: for a track that is not matched when
    /// the detector runs again, its whole rest counts as time without a match.
    int32_t detector_skipped;
} gt2_frame;

/// One track after a step.
typedef struct gt2_track {
    /// Identity: unique within its tracker until that is reset, never used again. At least 1.
    uint64_t id;
    /// Left edge of the box in pixels in this frame.
    double left;
    /// Top edge in pixels.
    double top;
    /// Width in pixels.
    double width;
    /// Height in pixels.
    double height;
    /// Velocity of the box's centre to the right, in pixels per second.
    double velocity_u;
    /// Velocity of the box's centre downwards, in pixels per second.
    double velocity_v;
    /// Growth of the width, in pixels per second.
    double velocity_w;
    /// Growth of the height, in pixels per second.
    double velocity_h;
    /// Score of the detection last taken, in 0..=1.
    double score;
    /// Row of the detection taken in this frame, -1 for none.
    int64_t detection_index;
    /// Tag of the detection last taken.
    uint64_t tag;
    /// Class of the detection last taken.
    int32_t class_id;
    /// `GT2_TRACK_TENTATIVE`, `GT2_TRACK_CONFIRMED` or `GT2_TRACK_LOST`.
    int32_t state;
    /// Frames since birth, the birth frame counted as 1.
    uint32_t age;
    /// Detections taken in its life.
    uint32_t hits;
    /// Frames since a detection was last taken; 0 if one was taken in this frame.
    uint32_t frames_since_match;
    /// 0.
    uint32_t reserved;
} gt2_track;

/// A list of tracks that belongs to the tracker. Start from `GT2_TRACK_LIST_INIT`.
///
/// Go through it with `gt2_track_at`: a later library may have larger tracks than this header knows, `stride` bytes
/// apart.
typedef struct gt2_track_list {
    /// `sizeof(gt2_track_list)`, set by the caller; 0 stands for the first published layout of this struct.
    size_t struct_size;
    /// The tracks; NULL if there are none.
    const struct gt2_track *tracks;
    /// How many there are.
    size_t count;
    /// Bytes from one track to the next.
    size_t stride;
} gt2_track_list;

/// One particle of a track: a hypothesis of its box.
typedef struct gt2_particle {
    /// Left edge in pixels.
    double left;
    /// Top edge in pixels.
    double top;
    /// Width in pixels.
    double width;
    /// Height in pixels.
    double height;
    /// Velocity of the centre to the right, in pixels per second.
    double velocity_u;
    /// Velocity of the centre downwards, in pixels per second.
    double velocity_v;
    /// Growth of the width, in pixels per second.
    double velocity_w;
    /// Growth of the height, in pixels per second.
    double velocity_h;
    /// Fitness after optimisation, in 0..=1.
    double fitness;
} gt2_particle;

/// A list of particles that belongs to the tracker. Start from `GT2_PARTICLE_LIST_INIT` and go through it with
/// `gt2_particle_at`.
typedef struct gt2_particle_list {
    /// `sizeof(gt2_particle_list)`, set by the caller; 0 stands for the first published layout of this struct.
    size_t struct_size;
    /// The particles; NULL if there are none.
    const struct gt2_particle *particles;
    /// How many there are.
    size_t count;
    /// Bytes from one particle to the next.
    size_t stride;
} gt2_particle_list;

/// The neighbours of a track that has no detection, and how they guided it (eq. 11 to 14 of the paper). The algorithm
/// gentrack2 has such. Start from `GT2_NEIGHBOURHOOD_INIT`.
typedef struct gt2_neighbourhood {
    /// `sizeof(gt2_neighbourhood)`, set by the caller; 0 stands for the first published layout of this struct.
    size_t struct_size;
    /// Identities of the neighbours: tracks within neighbour_radius, or if nobody is, within neighbour_radius_expanded
    /// (both are parameters). The trustworthy ones, which took a detection in this frame, come first. Some may have
    /// ended in the same step. NULL if there are none.
    const uint64_t *neighbours;
    /// How many there are.
    size_t count;
    /// How many of them are trustworthy; if it is 0, the medians below are 0.
    size_t trusted_count;
    /// Median of the trustworthy neighbours' centres, to the right, in pixels.
    double centre_u;
    /// The same downwards.
    double centre_v;
    /// Median of what these centres moved by since the previous frame, to the right, in pixels; the camera's motion,
    /// where it is given, is taken out.
    double displacement_u;
    /// The same downwards.
    double displacement_v;
    /// Median of the trustworthy neighbours' velocities to the right, in pixels per second.
    double velocity_u;
    /// The same downwards.
    double velocity_v;
    /// Which rule moved the track, one of `GT2_MOVE_...`.
    int32_t rule;
    /// 0.
    int32_t reserved;
} gt2_neighbourhood;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// Version of the library at run time, such as "0.1.0". Static.
const char *gt2_version(void);

/// Version of the binary interface of the library at run time; compare with `GT2_ABI_VERSION`.
uint32_t gt2_abi_version(void);

/// A short English name of a status, "unknown status" for a number that is none. Static.
const char *gt2_status_str(gt2_status status);

/// What went wrong in the last call on this thread that failed: one line that names the field, the row and the
/// range, such as "detections[3].width: is -2, must not be negative". "" if none has failed; calls that succeed
/// leave it alone. The pointer is valid, and always the same, until the thread ends; copy the text to keep it beyond
/// the next call that fails.
const char *gt2_last_error_message(void);

/// Number of algorithms in this library.
size_t gt2_algorithm_count(void);

/// Name of algorithm `index`, from 0 to `gt2_algorithm_count() - 1`, as `gt2_config_new` takes it. Static. NULL if
/// there is no such algorithm.
const char *gt2_algorithm_name(size_t index);

/// What algorithm `index` is, in one line of English. Static. NULL if there is no such algorithm.
const char *gt2_algorithm_description(size_t index);

/// Makes a config with the defaults of `algorithm` (see `gt2_algorithm_name`), such as "gentrack2", and stores it in
/// `*out`.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_ALGORITHM`.
gt2_status gt2_config_new(const char *algorithm,
                          struct gt2_config **out);

/// Releases a config; NULL is ignored. Trackers made from it live on.
void gt2_config_free(struct gt2_config *config);

/// Makes a copy of a config and stores it in `*out`.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
gt2_status gt2_config_clone(const struct gt2_config *config, struct gt2_config **out);

/// Name of the config's algorithm. Static. NULL if `config` is not a config.
const char *gt2_config_algorithm(const struct gt2_config *config);

/// Sets a parameter of any kind from text, as on a command line: "0.25", "12", "true" or "false", the name of a
/// choice, or areas "left,top,width,height;...". The key "preset" replaces all the algorithm's parameters by a named
/// set (see `gt2_config_preset_name`), so set it first. On an error nothing changes.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_PARAMETER_VALUE` (the
/// message names the range).
gt2_status gt2_config_set(struct gt2_config *config,
                          const char *key,
                          const char *value);

/// Sets a number; an integer too if `value` is whole. Errors as for `gt2_config_set`.
gt2_status gt2_config_set_number(struct gt2_config *config, const char *key, double value);

/// Sets an integer or a number. Errors as for `gt2_config_set`.
gt2_status gt2_config_set_integer(struct gt2_config *config, const char *key, int64_t value);

/// Sets a boolean: `value` 0 is false, 1 is true. Errors as for `gt2_config_set`; another `value` is
/// `GT2_ERR_INVALID_ARGUMENT`.
gt2_status gt2_config_set_boolean(struct gt2_config *config, const char *key, int32_t value);

/// Copies a parameter's value as text, with its terminating NUL, to `buffer` of `capacity` bytes, in the form that
/// `gt2_config_set` reads back to the same value. Stores the number of bytes needed, NUL included, in `*needed`,
/// which may be NULL; with a `capacity` of 0 that is all it does. If the buffer is too small it stays as it is and
/// `*needed` is stored all the same.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_BUFFER_TOO_SMALL`.
gt2_status gt2_config_get(const struct gt2_config *config,
                          const char *key,
                          char *buffer,
                          size_t capacity,
                          size_t *needed);

/// Stores the value of a number, integer or boolean (0 or 1) in `*out`. Integers beyond 2^53 lose digits; use
/// `gt2_config_get_integer`.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_PARAMETER_VALUE` if the
/// parameter is of another kind.
gt2_status gt2_config_get_number(const struct gt2_config *config,
                                 const char *key,
                                 double *out);

/// Stores the value of an integer or boolean (0 or 1) in `*out`. Errors as for `gt2_config_get_number`.
gt2_status gt2_config_get_integer(const struct gt2_config *config, const char *key, int64_t *out);

/// Reads settings from `length` bytes of TOML, which need no NUL: lines `key = value` with keys as in
/// `gt2_config_parameter_info`, besides `algorithm = "name"`, which turns the config into one of that algorithm, and
/// `preset = "name"`, which is loaded before the other keys. What is not named stays. On an error nothing changes.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_CONFIG_SYNTAX` (the message names the line),
/// `GT2_ERR_UNKNOWN_ALGORITHM`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_PARAMETER_VALUE`, `GT2_ERR_UNSUPPORTED`.
gt2_status gt2_config_load_toml(struct gt2_config *config,
                                const char *text,
                                size_t length);

/// Copies the whole config, every parameter with its documentation, as TOML that `gt2_config_load_toml` reads back to
/// the same values. `buffer`, `capacity`, `needed` and errors as for `gt2_config_get`.
gt2_status gt2_config_to_toml(const struct gt2_config *config,
                              char *buffer,
                              size_t capacity,
                              size_t *needed);

/// Number of parameters. 0 if `config` is not a config.
size_t gt2_config_parameter_count(const struct gt2_config *config);

/// Describes parameter `index`, from 0 to `gt2_config_parameter_count() - 1`, in `*info`, whose `struct_size` the
/// caller has set. Its texts are static.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_STRUCT_SIZE`.
gt2_status gt2_config_parameter_info(const struct gt2_config *config,
                                     size_t index,
                                     struct gt2_parameter_info *info);

/// Number of presets of the config's algorithm. 0 if `config` is not a config.
size_t gt2_config_preset_count(const struct gt2_config *config);

/// Name of preset `index`, from 0, the default, to `gt2_config_preset_count() - 1`. Static. NULL if there is no such
/// preset.
const char *gt2_config_preset_name(const struct gt2_config *config,
                                   size_t index);

/// Makes a tracker with a copy of `config` and stores it in `*out`. The first identity is the parameter first_id.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_PARAMETER_VALUE` if parameters contradict each other.
gt2_status gt2_tracker_new(const struct gt2_config *config,
                           struct gt2_tracker **out);

/// Releases a tracker and all lists borrowed from it; NULL is ignored.
void gt2_tracker_free(struct gt2_tracker *tracker);

/// Forgets everything but the config: the next step is as the first of a new tracker, identities start over. Also
/// makes a tracker usable again that met an internal error. Borrowed lists end.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
gt2_status gt2_tracker_reset(struct gt2_tracker *tracker);

/// Advances by one frame. Afterwards the functions below tell what became of the tracks; lists borrowed before have
/// ended. On an error the tracker, the results of the last step included, is as before the call, and the next step
/// gives what it would have given without it (except after `GT2_ERR_PANIC`).
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_STRUCT_SIZE`, and for the contents of the frame
/// `GT2_ERR_DETECTION`, `GT2_ERR_IMAGE`, `GT2_ERR_EMBEDDINGS`, `GT2_ERR_CAMERA_MOTION`, `GT2_ERR_TIMESTAMP`,
/// `GT2_ERR_FRAME`, `GT2_ERR_LIMIT`.
gt2_status gt2_tracker_step(struct gt2_tracker *tracker,
                            const struct gt2_frame *frame);

/// Name of the tracker's algorithm. Static. NULL if `tracker` is not a tracker.
const char *gt2_tracker_algorithm(const struct gt2_tracker *tracker);

/// Lists the tracks of a kind, `GT2_TRACKS_REPORTED`, `GT2_TRACKS_TENTATIVE` or `GT2_TRACKS_LOST`, after the last
/// step, in `*out`, whose `struct_size` the caller has set. The list is borrowed from the tracker until its next step,
/// reset or release. A live track is in exactly one of the three lists.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_STRUCT_SIZE`.
gt2_status gt2_tracker_tracks(const struct gt2_tracker *tracker,
                              int32_t kind,
                              struct gt2_track_list *out);

/// Copies the tracks of a kind to `buffer`, an array of `capacity` elements of `element_size` bytes, which is
/// `sizeof(gt2_track)`; fields that this library does not know become 0. Stores the number of tracks in `*needed`,
/// which may be NULL; with a `capacity` of 0 that is all it does. If the buffer is too small it stays as it is and
/// `*needed` is stored all the same.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_BUFFER_TOO_SMALL`.
gt2_status gt2_tracker_copy_tracks(const struct gt2_tracker *tracker,
                                   int32_t kind,
                                   struct gt2_track *buffer,
                                   size_t element_size,
                                   size_t capacity,
                                   size_t *needed);

/// Stores in `*ids` and `*count` the identities that ended in the last step, each named in one step only. Borrowed as
/// in `gt2_tracker_tracks`; NULL if there are none.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
gt2_status gt2_tracker_ended(const struct gt2_tracker *tracker,
                             const uint64_t **ids,
                             size_t *count);

/// Stores in `*ids` and `*count` for each detection of the last step, in their order, the identity of the track that
/// took it, 0 for none. Borrowed as in `gt2_tracker_tracks`; NULL if there were no detections.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
gt2_status gt2_tracker_track_of_detection(const struct gt2_tracker *tracker,
                                          const uint64_t **ids,
                                          size_t *count);

/// Lists the particles of the live track `id` as they were in the last step, in `*out`, whose `struct_size` the caller
/// has set. Borrowed as in `gt2_tracker_tracks`. Empty for algorithms without particles.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_UNKNOWN_TRACK`, `GT2_ERR_STRUCT_SIZE`.
gt2_status gt2_tracker_particles(const struct gt2_tracker *tracker,
                                 uint64_t id,
                                 struct gt2_particle_list *out);

/// Tells in `*out`, whose `struct_size` the caller has set, which neighbours the live track `id` had in the last step
/// and how they guided it, if it has no detection. Borrowed as in `gt2_tracker_tracks`. Empty for a track with a
/// detection, for one that is kept without being moved, for algorithms without such guidance, and after
/// `gt2_tracker_load` until the next step.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_UNKNOWN_TRACK`, `GT2_ERR_STRUCT_SIZE`.
gt2_status gt2_tracker_neighbourhood(const struct gt2_tracker *tracker,
                                     uint64_t id,
                                     struct gt2_neighbourhood *out);

/// Writes everything that a tracker knows, its config included, to `buffer`, an array of `capacity` bytes, and stores
/// the number of bytes in `*needed`, which may be NULL; with a `capacity` of 0 that is all it does. If the buffer is
/// too small it stays as it is and `*needed` is stored all the same. `gt2_tracker_load` makes a tracker of the bytes
/// that goes on, in any process and on any machine, exactly as this one would. The tracker is unchanged.
///
/// A later version of the library reads the snapshots of earlier ones.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_BUFFER_TOO_SMALL`, `GT2_ERR_UNSUPPORTED` from a library that was built
/// without snapshots.
gt2_status gt2_tracker_save(const struct gt2_tracker *tracker,
                            uint8_t *buffer,
                            size_t capacity,
                            size_t *needed);

/// Makes a tracker of the `size` bytes of a snapshot and stores it in `*out`; release it with `gt2_tracker_free`. Its
/// lists are those of the tracker that was saved. On an error `*out` is not written.
///
/// The bytes are checked, so a file that was cut or damaged is refused. They are not a place for secrets, nor proof
/// against someone who forges them: what is loaded from a forged snapshot may track nonsense or end in
/// `GT2_ERR_PANIC`, but harms nothing else.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_SNAPSHOT` for bytes that are no snapshot, a damaged one, or one of a later
/// version, `GT2_ERR_UNSUPPORTED` from a library that was built without snapshots.
gt2_status gt2_tracker_load(const uint8_t *bytes,
                            size_t size,
                            struct gt2_tracker **out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* GENTRACK2_H */

#ifndef GENTRACK2_H_HELPERS
#define GENTRACK2_H_HELPERS

/// Initial values of a `gt2_image`.
#define GT2_IMAGE_INIT {sizeof(gt2_image), NULL, 0, 0, 0, GT2_PIXEL_GRAY8, 0}

/// Initial values of a `gt2_frame`: no detections, nothing else known.
#define GT2_FRAME_INIT                                                                                     \
    {sizeof(gt2_frame), NULL, 0, sizeof(gt2_detection), NULL, 0, 0, NULL, NULL, 0, 0, 0, 0, 0}

/// Initial values of a `gt2_track_list`: empty.
#define GT2_TRACK_LIST_INIT {sizeof(gt2_track_list), NULL, 0, sizeof(gt2_track)}

/// Initial values of a `gt2_particle_list`: empty.
#define GT2_PARTICLE_LIST_INIT {sizeof(gt2_particle_list), NULL, 0, sizeof(gt2_particle)}

/// Initial values of a `gt2_neighbourhood`: empty.
#define GT2_NEIGHBOURHOOD_INIT {sizeof(gt2_neighbourhood), NULL, 0, 0, 0, 0, 0, 0, 0, 0, GT2_MOVE_NONE, 0}

/// Initial values of a `gt2_parameter_info`.
#define GT2_PARAMETER_INFO_INIT {sizeof(gt2_parameter_info), NULL, 0, 0, NULL, 0.0, 0.0, NULL, NULL, NULL, NULL, 0}

/* C's casts draw warnings from C++ compilers that are asked for them. */
#ifdef __cplusplus
#define GT2_CAST(type, pointer) static_cast<type>(static_cast<const void *>(pointer))
#else
#define GT2_CAST(type, pointer) ((type)(const void *)(pointer))
#endif

/// Track `index` of a list, from 0 to `list->count - 1`.
static inline const gt2_track *gt2_track_at(const gt2_track_list *list, size_t index) {
    return GT2_CAST(const gt2_track *, GT2_CAST(const char *, list->tracks) + index * list->stride);
}

/// Particle `index` of a list, from 0 to `list->count - 1`.
static inline const gt2_particle *gt2_particle_at(const gt2_particle_list *list, size_t index) {
    return GT2_CAST(const gt2_particle *, GT2_CAST(const char *, list->particles) + index * list->stride);
}

#undef GT2_CAST

#endif /* GENTRACK2_H_HELPERS */
