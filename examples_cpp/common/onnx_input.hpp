// OpenCV's ONNX importer does not tell the size of the image a model wants; the file does.
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string_view>

namespace examples {

/// Width and height of the model's first input that is not a weight, if the file fixes them.
std::optional<cv::Size> onnx_input_size(std::string_view model);

}  // namespace examples
