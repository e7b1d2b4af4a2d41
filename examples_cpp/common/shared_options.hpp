// The options that the programs share.
#pragma once

#include <string>
#include <vector>

#include "arguments.hpp"
#include "drawn_tracks.hpp"
#include "inputs.hpp"

namespace examples {

/// The options of both programs about frames, detections and camera motion.
OptionTable input_options(ArgumentReader &reader, InputOptions &options);

/// Those about what is drawn.
OptionTable drawing_options(ArgumentReader &reader, DrawingOptions &options, InputOptions &input);

/// Throws `UserError` for options that do not go together.
void check_inputs(const InputOptions &options);

/// Throws `UserError` if one of the files to be written is one that is read.
void check_not_overwritten(const InputOptions &options, const std::vector<std::string> &also_read,
                           const std::vector<std::string> &written);

/// The names of the trackers, with blanks between.
std::string tracker_names();

}  // namespace examples
