#include "onnx_input.hpp"

#include <cstdint>
#include <set>
#include <vector>

namespace examples {
namespace {

/// One field of a protocol buffer message: a number or a piece of bytes.
struct Field {
    std::uint64_t number = 0;
    std::uint64_t value = 0;
    std::string_view bytes;
};

/// Walks the fields of a message; stops at the end or at the first malformed field.
class Message {
public:
    explicit Message(std::string_view text) : rest_(text) {}

    bool next(Field &field) {
        std::uint64_t key = 0;
        if (rest_.empty() || !varint(key)) return false;
        field = {key >> 3, 0, {}};
        switch (key & 7) {
            case 0: return varint(field.value);
            case 1: return take(8, field.bytes);
            case 2: return varint(field.value) && take(field.value, field.bytes);
            case 5: return take(4, field.bytes);
            default: return false;
        }
    }

private:
    bool varint(std::uint64_t &value) {
        value = 0;
        for (int shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
            const auto byte = static_cast<unsigned char>(rest_.front());
            rest_.remove_prefix(1);
            value |= static_cast<std::uint64_t>(byte & 127) << shift;
            if (byte < 128) return true;
        }
        return false;
    }

    bool take(std::uint64_t count, std::string_view &bytes) {
        if (count > rest_.size()) return false;
        bytes = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return true;
    }

    std::string_view rest_;
};

/// The contents of every field of that number.
std::vector<std::string_view> children(std::string_view message, std::uint64_t number) {
    std::vector<std::string_view> found;
    Message walk(message);
    for (Field field; walk.next(field);) {
        if (field.number == number) found.push_back(field.bytes);
    }
    return found;
}

std::string_view child(std::string_view message, std::uint64_t number) {
    const auto found = children(message, number);
    return found.empty() ? std::string_view() : found.back();
}

/// `dim_value` of a dimension; 0 for a symbolic one.
std::uint64_t extent(std::string_view dimension) {
    Message walk(dimension);
    for (Field field; walk.next(field);) {
        if (field.number == 1) return field.value;
    }
    return 0;
}

}  // namespace

std::optional<cv::Size> onnx_input_size(std::string_view model) {
    // Field numbers of onnx.proto3.
    constexpr int model_graph = 7, graph_initializer = 5, graph_input = 11, tensor_name = 8;
    constexpr int value_name = 1, value_type = 2, type_tensor = 1, tensor_shape = 2, shape_dimension = 1;
    const std::string_view graph = child(model, model_graph);
    std::set<std::string_view> weights;
    for (const auto tensor : children(graph, graph_initializer)) weights.insert(child(tensor, tensor_name));
    for (const auto input : children(graph, graph_input)) {
        if (weights.count(child(input, value_name))) continue;
        const auto shape = child(child(child(input, value_type), type_tensor), tensor_shape);
        const auto dimensions = children(shape, shape_dimension);
        if (dimensions.size() != 4) return std::nullopt;
        const std::uint64_t height = extent(dimensions[2]), width = extent(dimensions[3]);
        if (height < 1 || width < 1 || height > 16384 || width > 16384) return std::nullopt;
        return cv::Size(static_cast<int>(width), static_cast<int>(height));
    }
    return std::nullopt;
}

}  // namespace examples
