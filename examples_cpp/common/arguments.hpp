// Command lines.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core/types.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

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
    /// Identities with commas between.
    std::set<std::uint64_t> identities();
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

/// Reads all arguments, or up to "--help" or "-h", and tells whether that was among them.
bool read_arguments(ArgumentReader &reader, const OptionTable &table);

}  // namespace examples
