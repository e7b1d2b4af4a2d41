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

using Detection = gt2_detection;
using Image = gt2_image;
using Track = gt2_track;
using Particle = gt2_particle;
using ParameterInfo = gt2_parameter_info;

/// A call that failed: what() is the library's message, status() one of GT2_ERR_...
class Error : public std::runtime_error {
public:
    Error(gt2_status status, const std::string &message) : std::runtime_error(message), status_(status) {}
    gt2_status status() const noexcept { return status_; }

private:
    gt2_status status_;
};

/// Turns a status that is not GT2_OK into an exception.
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

/// Names of the algorithms in this library.
inline std::vector<std::string> algorithms() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < gt2_algorithm_count(); i++) {
        names.emplace_back(detail::check_text(gt2_algorithm_name(i)));
    }
    return names;
}

/// A detection; `score` in 0..=1, `class_id` and `tag` come back on the track.
inline Detection detection(double left, double top, double width, double height, double score,
                           std::int32_t class_id = 0, std::uint64_t tag = 0) {
    return Detection{left, top, width, height, score, class_id, 0, tag};
}

/// A view of pixels; `format` is one of GT2_PIXEL_..., `stride` the bytes from row to row, 0 if rows are packed.
inline Image image(const std::uint8_t *data, std::uint32_t width, std::uint32_t height, std::int32_t format,
                   std::size_t stride = 0) {
    return Image{sizeof(Image), data, stride, width, height, format, 0};
}

/// Rows of a list that the library lends, `stride` bytes apart; T is what this header knows of a row.
template <class T> class Range {
public:
    class iterator {
    public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using pointer = const T *;
        using reference = const T &;

        iterator() = default;
        iterator(const Range &range, std::size_t index) : range_(range), index_(index) {}
        reference operator*() const { return range_[index_]; }
        pointer operator->() const { return &range_[index_]; }
        iterator &operator++() {
            index_++;
            return *this;
        }
        iterator operator++(int) {
            iterator before = *this;
            index_++;
            return before;
        }
        bool operator==(const iterator &other) const { return index_ == other.index_; }
        bool operator!=(const iterator &other) const { return index_ != other.index_; }

    private:
        Range range_;
        std::size_t index_ = 0;
    };
    using const_iterator = iterator;
    using value_type = T;

    Range() = default;
    Range(const T *first, std::size_t count, std::size_t stride = sizeof(T))
        : first_(first), count_(count), stride_(stride) {}

    std::size_t size() const noexcept { return count_; }
    bool empty() const noexcept { return count_ == 0; }
    /// Row `index`, which must be less than size().
    const T &operator[](std::size_t index) const {
        const void *row = reinterpret_cast<const char *>(first_) + index * stride_;
        return *static_cast<const T *>(row);
    }
    iterator begin() const { return iterator(*this, 0); }
    iterator end() const { return iterator(*this, count_); }
    /// A copy to keep.
    std::vector<T> to_vector() const { return std::vector<T>(begin(), end()); }

private:
    const T *first_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = sizeof(T);
};

using Tracks = Range<Track>;
using Particles = Range<Particle>;
using Ids = Range<std::uint64_t>;

/// An algorithm and its parameters, set by name; see gt2_config.
class Config {
public:
    /// The defaults of an algorithm.
    explicit Config(const std::string &algorithm = "gentrack2") {
        gt2_config *made = nullptr;
        check(gt2_config_new(algorithm.c_str(), &made));
        handle_.reset(made);
    }

    Config(Config &&) noexcept = default;
    Config &operator=(Config &&) noexcept = default;
    Config(const Config &) = delete;
    Config &operator=(const Config &) = delete;

    Config clone() const {
        gt2_config *made = nullptr;
        check(gt2_config_clone(get(), &made));
        return Config(made);
    }

    /// Sets a parameter of any kind from text; the key "preset" loads a preset. Returns itself, to be chained.
    Config &set(const std::string &key, const std::string &value) {
        check(gt2_config_set(get(), key.c_str(), value.c_str()));
        return *this;
    }
    Config &set(const std::string &key, const char *value) { return set(key, std::string(value)); }
    /// Sets a boolean, an integer or a number, whichever T is.
    template <class T, class = typename std::enable_if<std::is_arithmetic<T>::value>::type>
    Config &set(const std::string &key, T value) {
        check(set_value(key.c_str(), value));
        return *this;
    }

    /// The value of any parameter as text.
    std::string text(const std::string &key) const {
        return detail::read_text([&](char *buffer, std::size_t capacity, std::size_t *needed) {
            return gt2_config_get(get(), key.c_str(), buffer, capacity, needed);
        });
    }
    /// The value of a number, integer or boolean.
    double number(const std::string &key) const {
        double value = 0.0;
        check(gt2_config_get_number(get(), key.c_str(), &value));
        return value;
    }
    /// The value of an integer or boolean.
    std::int64_t integer(const std::string &key) const {
        std::int64_t value = 0;
        check(gt2_config_get_integer(get(), key.c_str(), &value));
        return value;
    }

    Config &load_toml(const std::string &text) {
        check(gt2_config_load_toml(get(), text.data(), text.size()));
        return *this;
    }
    std::string to_toml() const {
        return detail::read_text([&](char *buffer, std::size_t capacity, std::size_t *needed) {
            return gt2_config_to_toml(get(), buffer, capacity, needed);
        });
    }

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

    /// The handle for the functions of gentrack2.h.
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
/// copies the image's description and the camera motion, and points to the rest.
class Frame {
public:
    /// No detections: the detector ran and found nothing.
    Frame() = default;
    /// The detections in an array or in a container with data() and size(), such as std::vector.
    Frame(const Detection *detections, std::size_t count) {
        raw_.detections = detections;
        raw_.detection_count = count;
    }
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

    Frame &image(const Image &image) {
        image_ = image;
        has_image_ = true;
        return *this;
    }
    /// One row of `dimension` floats per detection, `stride` floats apart (0: packed).
    Frame &embeddings(const float *data, std::size_t dimension, std::size_t stride = 0) {
        raw_.embeddings = data;
        raw_.embedding_dimension = dimension;
        raw_.embedding_stride = stride;
        return *this;
    }
    /// The 2x3 affine map from the previous frame to this one, row by row, in pixels.
    Frame &camera_motion(const std::array<double, 6> &affine) {
        camera_motion_ = affine;
        has_camera_motion_ = true;
        return *this;
    }
    /// Width and height of the frame where no image is given.
    Frame &size(std::uint32_t width, std::uint32_t height) {
        raw_.image_width = width;
        raw_.image_height = height;
        return *this;
    }
    /// When the frame was taken, from any fixed origin; must grow from frame to frame.
    Frame &timestamp(std::chrono::nanoseconds time) {
        raw_.timestamp_ns = static_cast<std::int64_t>(time.count());
        raw_.has_timestamp = 1;
        return *this;
    }

    /// The C struct; it points into this object.
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

/// Tracks the objects of one video; see gt2_tracker.
class Tracker {
public:
    explicit Tracker(const Config &config = Config()) {
        gt2_tracker *made = nullptr;
        check(gt2_tracker_new(config.get(), &made));
        handle_.reset(made);
    }

    /// Advances by one frame and returns the reported tracks. If it throws, the tracker is as before.
    Tracks step(const Frame &frame) {
        const gt2_frame raw = frame.raw();
        check(gt2_tracker_step(get(), &raw));
        return reported();
    }
    /// Forgets everything but the config.
    void reset() { check(gt2_tracker_reset(get())); }

    /// What the tracker stands for in this frame.
    Tracks reported() const { return tracks(GT2_TRACKS_REPORTED); }
    /// Tracks too young to be reported.
    Tracks tentative() const { return tracks(GT2_TRACKS_TENTATIVE); }
    /// Live tracks without a detection that are not reported, with their predicted box.
    Tracks lost() const { return tracks(GT2_TRACKS_LOST); }
    /// Identities that ended in the last step.
    Ids ended() const { return ids(gt2_tracker_ended); }
    /// For each detection of the last step the identity of its track, 0 for none.
    Ids track_of_detection() const { return ids(gt2_tracker_track_of_detection); }
    /// The particles of a live track.
    Particles particles(std::uint64_t id) const {
        gt2_particle_list list = GT2_PARTICLE_LIST_INIT;
        check(gt2_tracker_particles(get(), id, &list));
        return Particles(list.particles, list.count, list.stride);
    }
    std::string algorithm() const { return detail::check_text(gt2_tracker_algorithm(get())); }

    /// Everything the tracker knows, as bytes of which `load` makes a tracker that goes on exactly as this one would.
    std::vector<std::uint8_t> save() const {
        std::size_t size = 0;
        check(gt2_tracker_save(get(), nullptr, 0, &size));
        std::vector<std::uint8_t> bytes(size);
        check(gt2_tracker_save(get(), bytes.data(), bytes.size(), &size));
        return bytes;
    }
    /// The tracker of a snapshot. Throws for bytes that are none, damaged, or of a later version.
    static Tracker load(const std::uint8_t *bytes, std::size_t size) {
        gt2_tracker *made = nullptr;
        check(gt2_tracker_load(bytes, size, &made));
        return Tracker(made);
    }
    static Tracker load(const std::vector<std::uint8_t> &bytes) { return load(bytes.data(), bytes.size()); }

    /// The handle for the functions of gentrack2.h.
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
