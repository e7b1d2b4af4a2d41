#include "arguments.hpp"

#include <optional>
#include <string_view>

#include "mot_rows.hpp"
#include "text.hpp"

namespace examples {

bool ArgumentReader::next() {
    if (at_ >= arguments_.size()) return false;
    option_ = arguments_[at_++];
    return true;
}

const std::string &ArgumentReader::value() {
    if (at_ >= arguments_.size()) throw UserError(option_ + " needs a value");
    return arguments_[at_++];
}

void ArgumentReader::refuse(const std::string &value, const std::string &expected) const {
    throw UserError(option_ + " " + value + ": expected " + expected);
}

double ArgumentReader::number(double low, double high, const std::string &expected) {
    const std::string text = value();
    const auto number = parse_number(text);
    if (!number || *number < low || *number > high) refuse(text, expected);
    return *number;
}

long ArgumentReader::integer(long low, long high) {
    const std::string text = value();
    const auto number = parse_integer(text);
    if (!number || *number < low || *number > high) {
        refuse(text, "an integer in " + std::to_string(low) + ".." + std::to_string(high));
    }
    return static_cast<long>(*number);
}

cv::Size ArgumentReader::size() {
    const std::string text = value();
    const auto cross = text.find('x');
    const auto width = parse_integer(std::string_view(text).substr(0, cross));
    const auto height = cross == std::string::npos ? std::nullopt : parse_integer(text.substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > 65535 || *height > 65535) {
        refuse(text, "WIDTHxHEIGHT in pixels, such as 1920x1080");
    }
    return {static_cast<int>(*width), static_cast<int>(*height)};
}

std::vector<long> ArgumentReader::frame_list() {
    const std::string text = value();
    std::vector<long> frames;
    for (const auto field : split_commas(text)) {
        const auto frame = parse_integer(field);
        if (!frame || *frame < 1 || *frame > max_frame) refuse(text, "frame numbers with commas between");
        frames.push_back(static_cast<long>(*frame));
    }
    return frames;
}

std::set<std::uint64_t> ArgumentReader::identities() {
    const std::string text = value();
    std::set<std::uint64_t> ids;
    for (const auto field : split_commas(text)) {
        const auto id = parse_integer(field);
        if (!id || *id < 1) refuse(text, "identities with commas between");
        ids.insert(static_cast<std::uint64_t>(*id));
    }
    return ids;
}

std::pair<std::string, std::string> ArgumentReader::setting() {
    const std::string text = value();
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) refuse(text, "KEY=VALUE");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

bool read_arguments(ArgumentReader &r, const OptionTable &table) {
    while (r.next()) {
        if (r.option() == "--help" || r.option() == "-h") return true;
        const auto reader = table.find(r.option());
        if (reader == table.end()) throw UserError("unknown option " + r.option() + " (--help lists the options)");
        reader->second();
    }
    return false;
}

}  // namespace examples
