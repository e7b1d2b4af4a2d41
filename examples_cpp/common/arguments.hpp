// Command lines, and the options that the programs share.
#pragma once

#include <functional>
#include <map>
#include <opencv2/core/types.hpp>
#include <string>
#include <utility>
#include <vector>

#include "inputs.hpp"

namespace examples {

/// The arguments, and which option is being read. Values are checked; what is wrong with one is a `UserError`.
class ArgumentReader {
public:
    explicit ArgumentReader(const std::vector<std::string> &arguments) : arguments_(arguments) {}

    /// Goes to the next option; false at the end.
    bool next();

    const std::string &option() const { return option_; }

    const std::string &value();
    double number(double low, double high, const std::string &expected);
    long integer(long low, long high);
    /// WIDTHxHEIGHT
    cv::Size size();
    /// Frame numbers with commas between.
    std::vector<long> frame_list();
    /// KEY=VALUE
    std::pair<std::string, std::string> setting();

private:
    [[noreturn]] void refuse(const std::string &value, const std::string &expected) const;

    const std::vector<std::string> &arguments_;
    std::size_t at_ = 0;
    std::string option_;
};

/// What reads the value of each option.
using OptionTable = std::map<std::string, std::function<void()>>;

/// The options of both programs about frames, detections and camera motion.
OptionTable input_options(ArgumentReader &reader, InputOptions &options);

/// Reads all arguments, or up to "--help" or "-h", and tells whether that was among them.
bool read_arguments(ArgumentReader &reader, const OptionTable &table);

/// Throws `UserError` for options that do not go together.
void check_inputs(const InputOptions &options);

/// Throws `UserError` if one of the files to be written is one that is read.
void check_not_overwritten(const InputOptions &options, const std::vector<std::string> &also_read,
                           const std::vector<std::string> &written);

/// The names of the trackers, with blanks between.
std::string tracker_names();

}  // namespace examples
