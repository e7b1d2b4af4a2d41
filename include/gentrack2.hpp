/*
 * gentrack2 for C++: handles that clean up after themselves, errors as exceptions, tracks to iterate over. Header-only,
 * over gentrack2.h, which is the manual. Made for C++17; everything works from C++11 on.
 *
 *     gentrack2::Config config("gentrack2");
 *     config.set("frame_rate", 25);
 *     gentrack2::Tracker tracker(config);
 *     std::vector<gentrack2::Detection> detections;
 *     while (next_frame(detections, pixels)) {                        // fills in gentrack2::detection(...)s
 *         gentrack2::Frame frame(detections);
 *         frame.image(gentrack2::image(pixels, 1920, 1080, GT2_PIXEL_BGR24));
 *         for (const gentrack2::Track &track : tracker.step(frame)) {
 *             std::cout << track.id << ": " << track.left << ' ' << track.top << '\n';
 *         }
 *         for (std::uint64_t id : tracker.ended()) {
 *             std::cout << id << " ended\n";
 *         }
 *     }
 *
 * What a Frame points to is yours and must live until the step. What comes out of a Tracker is borrowed until its
 * next step, reset or destruction; to_vector() copies.
 */
#ifndef GENTRACK2_HPP
#define GENTRACK2_HPP

#if !defined(_MSVC_LANG) && __cplusplus < 201103L
#error "gentrack2.hpp needs C++11 or later, C++17 is recommended (-std=c++17)"
#endif

#include "gentrack2.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gentrack2 {

/// What the detector found: a box in pixels, a score in 0..=1, a class and a tag of the caller's. Made by detection().
using Detection = gt2_detection;
/// A view of an image's pixels, which it does not own. Made by image().
using Image = gt2_image;
/// One track after a step: identity, box in pixels, velocity in pixels per second, state and row of its detection.
using Track = gt2_track;
/// A hypothesis of a track's box in pixels, with a fitness in 0..=1.
using Particle = gt2_particle;
/// The neighbours that guided a track without a detection, their median motion, and the rule that moved it. Its
/// `neighbours` are borrowed from the tracker until its next step.
using Neighbourhood = gt2_neighbourhood;
/// Key, kind, default, range, unit and meaning of a parameter.
using ParameterInfo = gt2_parameter_info;

/// A call that failed: what() is the library's message, which names the field or row, status() one of GT2_ERR_...
/// Handles and results are as before the call. Everything in this header that can fail throws it; where documentation
/// says "Throws", it names the statuses.
class Error : public std::runtime_error {
public:
    /// An error of a status, with a message for what().
    Error(gt2_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
    /// One of GT2_ERR_..., which is negative.
    gt2_status status() const noexcept { return status_; }

private:
    gt2_status status_;
};

/// Throws Error with this thread's last message unless `status` is GT2_OK. For calls of gentrack2.h of your own.
inline void check(gt2_status status) {
    if (status != GT2_OK) {
        throw Error(status, gt2_last_error_message());
    }
}

namespace detail {

/// Turns a NULL answer of a lookup into an exception.
inline const char *check_text(const char *text) {
    if (text == nullptr) {
        throw Error(GT2_ERR_INVALID_ARGUMENT, gt2_last_error_message());
    }
    return text;
}

/// Asks for the size of a text, then for the text.
template <class Call> std::string read_text(Call call) {
    std::size_t size = 0;
    check(call(nullptr, 0, &size));
    std::string text(size, '\0');
    check(call(&text[0], text.size(), &size));
    text.resize(size - 1); // without the NUL
    return text;
}

struct Release {
    void operator()(gt2_config *config) const noexcept { gt2_config_free(config); }
    void operator()(gt2_tracker *tracker) const noexcept { gt2_tracker_free(tracker); }
};

} // namespace detail

/// Version of the library at run time, such as "0.1.0".
inline std::string version() { return gt2_version(); }

/// Names of the algorithms in this library, as Config takes them.
inline std::vector<std::string> algorithms() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < gt2_algorithm_count(); i++) {
        names.emplace_back(detail::check_text(gt2_algorithm_name(i)));
    }
    return names;
}

/// A detection: left-top corner and size in pixels, finite, sizes not negative, y downwards; it may reach beyond the
/// image. `score` is in 0..=1, `class_id` and `tag` are any numbers and come back on the track. Nothing is checked
/// before the step.
inline Detection detection(double left, double top, double width, double height, double score,
                           std::int32_t class_id = 0, std::uint64_t tag = 0) {
    return Detection{left, top, width, height, score, class_id, 0, tag};
}

/// A view of pixels, which are not copied: `data` is the left-top one, `width` and `height` are in 1..=65535, `format`
/// is one of GT2_PIXEL_..., `stride` the bytes from row to row, 0 if rows are packed. Of NV12 and I420 only the luma
/// plane is read. Nothing is checked before the step.
inline Image image(const std::uint8_t *data, std::uint32_t width, std::uint32_t height, std::int32_t format,
                   std::size_t stride = 0) {
    return Image{sizeof(Image), data, stride, width, height, format, 0};
}

/// Rows of a list that the library lends, `stride` bytes apart; T is what this header knows of a row. A Range is a view
/// that is cheap to copy; its rows end with the next step, reset or destruction of the tracker.
template <class T> class Range {
public:
    /// Goes over the rows; a standard forward iterator.
    class iterator {
    public:
        /// It may go over the rows more than once.
        using iterator_category = std::forward_iterator_tag;
        /// A row.
        using value_type = T;
        /// Rows between two iterators.
        using difference_type = std::ptrdiff_t;
        /// Rows are read only.
        using pointer = const T *;
        /// Rows are read only.
        using reference = const T &;

        /// Belongs to no range.
        iterator() = default;
        /// At row `index`, from 0 to range.size(), which is the end.
        iterator(const Range &range, std::size_t index) : range_(range), index_(index) {}
        /// The row.
        reference operator*() const { return range_[index_]; }
        /// The row.
        pointer operator->() const { return &range_[index_]; }
        /// On to the next row.
        iterator &operator++() {
            index_++;
            return *this;
        }
        /// On to the next row; returns where it was.
        iterator operator++(int) {
            iterator before = *this;
            index_++;
            return before;
        }
        /// Whether both are at the same row, of the same range.
        bool operator==(const iterator &other) const { return index_ == other.index_; }
        /// Whether they are at different rows.
        bool operator!=(const iterator &other) const { return index_ != other.index_; }

    private:
        Range range_;
        std::size_t index_ = 0;
    };
    /// Rows are read only.
    using const_iterator = iterator;
    /// A row.
    using value_type = T;

    /// Empty.
    Range() = default;
    /// `count` rows from `first` on, `stride` bytes apart.
    Range(const T *first, std::size_t count, std::size_t stride = sizeof(T))
        : first_(first), count_(count), stride_(stride) {}

    /// Number of rows.
    std::size_t size() const noexcept { return count_; }
    /// Whether there are none.
    bool empty() const noexcept { return count_ == 0; }
    /// Row `index`, which must be less than size().
    const T &operator[](std::size_t index) const {
        const void *row = reinterpret_cast<const char *>(first_) + index * stride_;
        return *static_cast<const T *>(row);
    }
    /// At the first row.
    iterator begin() const { return iterator(*this, 0); }
    /// Behind the last row.
    iterator end() const { return iterator(*this, count_); }
    /// A copy to keep.
    std::vector<T> to_vector() const { return std::vector<T>(begin(), end()); }

private:
    const T *first_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = sizeof(T);
};

/// Tracks of a tracker.
using Tracks = Range<Track>;
/// Particles of a track.
using Particles = Range<Particle>;
/// Identities, 1 or greater; 0 stands for none.
using Ids = Range<std::uint64_t>;

/// An algorithm and its parameters, set by name; see gt2_config. It can be moved, and copied by clone(); a moved-from
/// one may only be assigned to or destroyed.
class Config {
public:
    /// The defaults of an algorithm, one of algorithms(). Throws GT2_ERR_UNKNOWN_ALGORITHM, GT2_ERR_INVALID_TEXT.
    explicit Config(const std::string &algorithm = "gentrack2") {
        gt2_config *made = nullptr;
        check(gt2_config_new(algorithm.c_str(), &made));
        handle_.reset(made);
    }

    /// Takes the handle over.
    Config(Config &&) noexcept = default;
    /// Takes the handle over and releases its own.
    Config &operator=(Config &&) noexcept = default;
    Config(const Config &) = delete;
    Config &operator=(const Config &) = delete;

    /// A copy, independent of this one.
    Config clone() const {
        gt2_config *made = nullptr;
        check(gt2_config_clone(get(), &made));
        return Config(made);
    }

    /// Sets a parameter of any kind from text: "0.25", "12", "true", the name of a choice, or areas in pixels
    /// "left,top,width,height;...". The key "preset" replaces all parameters by those of a preset, so set it first.
    /// Returns itself, to be chained.
    ///
    /// Throws GT2_ERR_UNKNOWN_PARAMETER, GT2_ERR_PARAMETER_VALUE (what() names the range), GT2_ERR_INVALID_TEXT;
    /// nothing is set then.
    Config &set(const std::string &key, const std::string &value) {
        check(gt2_config_set(get(), key.c_str(), value.c_str()));
        return *this;
    }
    /// The same for a literal, which would be taken for a boolean otherwise.
    Config &set(const std::string &key, const char *value) { return set(key, std::string(value)); }
    /// Sets a boolean, an integer or a number, whichever T is; a number takes integers, and an integer whole numbers.
    /// Throws as the one above.
    template <class T, class = typename std::enable_if<std::is_arithmetic<T>::value>::type>
    Config &set(const std::string &key, T value) {
        check(set_value(key.c_str(), value));
        return *this;
    }

    /// The value of any parameter as text, which set() reads back to the same value. Throws GT2_ERR_UNKNOWN_PARAMETER,
    /// GT2_ERR_INVALID_TEXT.
    std::string text(const std::string &key) const {
        return detail::read_text([&](char *buffer, std::size_t capacity, std::size_t *needed) {
            return gt2_config_get(get(), key.c_str(), buffer, capacity, needed);
        });
    }
    /// The value of a number, integer or boolean (0 or 1); integers beyond 2^53 lose digits. Throws
    /// GT2_ERR_UNKNOWN_PARAMETER, GT2_ERR_INVALID_TEXT, and GT2_ERR_PARAMETER_VALUE for another kind.
    double number(const std::string &key) const {
        double value = 0.0;
        check(gt2_config_get_number(get(), key.c_str(), &value));
        return value;
    }
    /// The value of an integer or boolean (0 or 1). Throws as number().
    std::int64_t integer(const std::string &key) const {
        std::int64_t value = 0;
        check(gt2_config_get_integer(get(), key.c_str(), &value));
        return value;
    }

    /// Reads lines `key = value` of TOML, also `algorithm = "name"` and `preset = "name"`; what is not named stays.
    /// Returns itself.
    ///
    /// Throws GT2_ERR_CONFIG_SYNTAX (what() names the line), GT2_ERR_UNKNOWN_ALGORITHM, GT2_ERR_UNKNOWN_PARAMETER,
    /// GT2_ERR_PARAMETER_VALUE, GT2_ERR_INVALID_TEXT, and GT2_ERR_UNSUPPORTED from a library without TOML; nothing is
    /// set then.
    Config &load_toml(const std::string &text) {
        check(gt2_config_load_toml(get(), text.data(), text.size()));
        return *this;
    }
    /// All parameters with their documentation, as TOML that load_toml() reads back to the same values.
    std::string to_toml() const {
        return detail::read_text([&](char *buffer, std::size_t capacity, std::size_t *needed) {
            return gt2_config_to_toml(get(), buffer, capacity, needed);
        });
    }

    /// Name of the algorithm.
    std::string algorithm() const { return detail::check_text(gt2_config_algorithm(get())); }
    /// Descriptions of all parameters; their texts are static.
    std::vector<ParameterInfo> parameters() const {
        std::vector<ParameterInfo> all(gt2_config_parameter_count(get()));
        for (std::size_t i = 0; i < all.size(); i++) {
            all[i].struct_size = sizeof(ParameterInfo);
            check(gt2_config_parameter_info(get(), i, &all[i]));
        }
        return all;
    }
    /// Names of the presets, the default first.
    std::vector<std::string> presets() const {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < gt2_config_preset_count(get()); i++) {
            names.emplace_back(detail::check_text(gt2_config_preset_name(get(), i)));
        }
        return names;
    }

    /// The handle for the functions of gentrack2.h, which stays this object's; nullptr of a moved-from one.
    gt2_config *get() const noexcept { return handle_.get(); }

private:
    explicit Config(gt2_config *made) : handle_(made) {}

    gt2_status set_value(const char *key, bool value) { return gt2_config_set_boolean(get(), key, value ? 1 : 0); }
    template <class T> gt2_status set_value(const char *key, T value) {
        return set_number(key, value, std::is_integral<T>());
    }
    template <class T> gt2_status set_number(const char *key, T value, std::true_type /* integral */) {
        if (std::is_unsigned<T>::value && static_cast<std::uint64_t>(value) > static_cast<std::uint64_t>(INT64_MAX)) {
            return gt2_config_set(get(), key, std::to_string(value).c_str());
        }
        return gt2_config_set_integer(get(), key, static_cast<std::int64_t>(value));
    }
    template <class T> gt2_status set_number(const char *key, T value, std::false_type) {
        return gt2_config_set_number(get(), key, static_cast<double>(value));
    }

    std::unique_ptr<gt2_config, detail::Release> handle_;
};

/// What is known about one frame; see gt2_frame. Everything but the detections is optional and may be chained. It
/// copies the image's description and the camera motion, and points to the rest, pixels included, which must live until
/// the step. Only the step checks what it holds, and throws.
class Frame {
public:
    /// No detections: the detector ran and found nothing.
    Frame() = default;
    /// The detections in an array of `count`, at most the parameter max_detections; their order is that of embeddings
    /// and of Tracker::track_of_detection().
    Frame(const Detection *detections, std::size_t count) {
        raw_.detections = detections;
        raw_.detection_count = count;
    }
    /// The detections in a container with data() and size(), such as std::vector or std::array.
    template <class Container, class = decltype(std::declval<const Container &>().data())>
    explicit Frame(const Container &detections) : Frame(detections.data(), detections.size()) {}
    /// A temporary would be gone before the step.
    template <class Container, class = decltype(std::declval<const Container &>().data()),
              class = typename std::enable_if<!std::is_lvalue_reference<Container>::value>::type>
    explicit Frame(Container &&) = delete;

    /// A frame on which the detector did not run: tracks move on and are not blamed for a miss.
    static Frame skipped() {
        Frame frame;
        frame.raw_.detector_skipped = 1;
        return frame;
    }

    /// The image, for algorithms that look at it; boxes are in its pixels.
    Frame &image(const Image &image) {
        image_ = image;
        has_image_ = true;
        return *this;
    }
    /// One row of `dimension` floats per detection, in the order of the detections, `stride` floats apart (0: packed).
    /// They are finite and need not be normalised; `dimension` is at most the parameter max_embedding_dimension and the
    /// same for all frames.
    Frame &embeddings(const float *data, std::size_t dimension, std::size_t stride = 0) {
        raw_.embeddings = data;
        raw_.embedding_dimension = dimension;
        raw_.embedding_stride = stride;
        return *this;
    }
    /// The 2x3 affine map {a, b, c, d, e, f} that takes a point (x, y) of the previous frame to (a x + b y + c,
    /// d x + e y + f) in this one, in pixels; finite and invertible.
    Frame &camera_motion(const std::array<double, 6> &affine) {
        camera_motion_ = affine;
        has_camera_motion_ = true;
        return *this;
    }
    /// Width and height of the frame in pixels where no image is given.
    Frame &size(std::uint32_t width, std::uint32_t height) {
        raw_.image_width = width;
        raw_.image_height = height;
        return *this;
    }
    /// When the frame was taken, from any fixed origin; must grow from frame to frame. Without it a frame comes one
    /// interval of the parameter frame_rate after the one before.
    Frame &timestamp(std::chrono::nanoseconds time) {
        raw_.timestamp_ns = static_cast<std::int64_t>(time.count());
        raw_.has_timestamp = 1;
        return *this;
    }

    /// The C struct; it points into this object and to what this object points to.
    gt2_frame raw() const noexcept {
        gt2_frame frame = raw_;
        frame.image = has_image_ ? &image_ : nullptr;
        frame.camera_motion = has_camera_motion_ ? camera_motion_.data() : nullptr;
        return frame;
    }

private:
    gt2_frame raw_ = GT2_FRAME_INIT;
    gt2_image image_ = GT2_IMAGE_INIT;
    std::array<double, 6> camera_motion_ = {{1.0, 0.0, 0.0, 0.0, 1.0, 0.0}};
    bool has_image_ = false;
    bool has_camera_motion_ = false;
};

/// Tracks the objects of one video; see gt2_tracker. It can be moved, not copied; a moved-from one may only be assigned
/// to or destroyed. Different trackers may be used by different threads, one tracker by one thread at a time.
class Tracker {
public:
    /// A tracker with a copy of `config`. Throws GT2_ERR_PARAMETER_VALUE if parameters contradict each other.
    explicit Tracker(const Config &config = Config()) {
        gt2_tracker *made = nullptr;
        check(gt2_tracker_new(config.get(), &made));
        handle_.reset(made);
    }

    /// Advances by one frame and returns the reported tracks; lists lent before have ended.
    ///
    /// Throws, for what the frame holds, GT2_ERR_DETECTION, GT2_ERR_IMAGE, GT2_ERR_EMBEDDINGS, GT2_ERR_CAMERA_MOTION,
    /// GT2_ERR_TIMESTAMP, GT2_ERR_FRAME, GT2_ERR_LIMIT, GT2_ERR_NULL_POINTER, GT2_ERR_INVALID_ARGUMENT; what() names
    /// field and row. The tracker and its results are then as before. After GT2_ERR_PANIC it needs a reset().
    Tracks step(const Frame &frame) {
        const gt2_frame raw = frame.raw();
        check(gt2_tracker_step(get(), &raw));
        return reported();
    }
    /// Forgets everything but the config; identities start over. Lists lent before have ended.
    void reset() { check(gt2_tracker_reset(get())); }

    /// What the tracker stands for in this frame: matched tracks, and lost ones whose predicted box is trusted. A live
    /// track is in exactly one of reported(), tentative() and lost().
    Tracks reported() const { return tracks(GT2_TRACKS_REPORTED); }
    /// Tracks too young to be reported, or, as `GT2_TRACKS_TENTATIVE` says, not trusted for another reason.
    Tracks tentative() const { return tracks(GT2_TRACKS_TENTATIVE); }
    /// Live tracks without a detection that are not reported, with their predicted box.
    Tracks lost() const { return tracks(GT2_TRACKS_LOST); }
    /// Identities that ended in the last step.
    Ids ended() const { return ids(gt2_tracker_ended); }
    /// For each detection of the last step the identity of its track, 0 for none.
    Ids track_of_detection() const { return ids(gt2_tracker_track_of_detection); }
    /// The particles of the live track `id` in the last step; empty for algorithms without particles. Throws
    /// GT2_ERR_UNKNOWN_TRACK.
    Particles particles(std::uint64_t id) const {
        gt2_particle_list list = GT2_PARTICLE_LIST_INIT;
        check(gt2_tracker_particles(get(), id, &list));
        return Particles(list.particles, list.count, list.stride);
    }
    /// The neighbours that guided the live track `id` in the last step if it has no detection; empty for tracks with one
    /// and for algorithms without such guidance. Throws GT2_ERR_UNKNOWN_TRACK.
    Neighbourhood neighbourhood(std::uint64_t id) const {
        gt2_neighbourhood n = GT2_NEIGHBOURHOOD_INIT;
        check(gt2_tracker_neighbourhood(get(), id, &n));
        return n;
    }
    /// Name of the algorithm.
    std::string algorithm() const { return detail::check_text(gt2_tracker_algorithm(get())); }

    /// Everything the tracker knows, as bytes of which load() makes a tracker that goes on exactly as this one would,
    /// in any process and on any machine. Throws GT2_ERR_UNSUPPORTED from a library without snapshots.
    std::vector<std::uint8_t> save() const {
        std::size_t size = 0;
        check(gt2_tracker_save(get(), nullptr, 0, &size));
        std::vector<std::uint8_t> bytes(size);
        check(gt2_tracker_save(get(), bytes.data(), bytes.size(), &size));
        return bytes;
    }
    /// The tracker of a snapshot of `size` bytes. Throws GT2_ERR_SNAPSHOT for bytes that are none, damaged, or of a
    /// later version, and GT2_ERR_UNSUPPORTED from a library without snapshots.
    static Tracker load(const std::uint8_t *bytes, std::size_t size) {
        gt2_tracker *made = nullptr;
        check(gt2_tracker_load(bytes, size, &made));
        return Tracker(made);
    }
    /// The same with what save() returned.
    static Tracker load(const std::vector<std::uint8_t> &bytes) { return load(bytes.data(), bytes.size()); }

    /// The handle for the functions of gentrack2.h, which stays this object's; nullptr of a moved-from one.
    gt2_tracker *get() const noexcept { return handle_.get(); }

private:
    explicit Tracker(gt2_tracker *made) : handle_(made) {}

    Tracks tracks(std::int32_t kind) const {
        gt2_track_list list = GT2_TRACK_LIST_INIT;
        check(gt2_tracker_tracks(get(), kind, &list));
        return Tracks(list.tracks, list.count, list.stride);
    }
    template <class Call> Ids ids(Call call) const {
        const std::uint64_t *first = nullptr;
        std::size_t count = 0;
        check(call(get(), &first, &count));
        return Ids(first, count);
    }

    std::unique_ptr<gt2_tracker, detail::Release> handle_;
};

} // namespace gentrack2

#endif // GENTRACK2_HPP
