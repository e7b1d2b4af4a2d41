#include "text.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace examples {
namespace {

constexpr std::string_view blanks = " \t\r\n";

}  // namespace

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> split_commas(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
        const auto comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

std::vector<std::string_view> split_blanks(std::string_view line) {
    constexpr std::string_view separators = " \t\r\n,";
    std::vector<std::string_view> fields;
    for (;;) {
        const auto first = line.find_first_not_of(separators);
        if (first == std::string_view::npos) return fields;
        line.remove_prefix(first);
        const auto end = line.find_first_of(separators);
        fields.push_back(line.substr(0, end));
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end);
    }
}

std::string quoted(std::string_view text) {
    static constexpr std::size_t longest = 60;
    std::string out = "\"";
    for (const char c : text.substr(0, longest)) {
        if (c >= ' ' && c <= '~') {
            out += c;
        } else {
            char code[5];
            std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
            out += code;
        }
    }
    return out + (text.size() > longest ? "...\"" : "\"");
}

std::optional<double> parse_number(std::string_view text) {
    // One sign; a minus is left to `from_chars`.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<long long> parse_integer(std::string_view text) {
    const auto value = parse_number(text);
    if (!value || *value != std::floor(*value) || std::fabs(*value) > 9007199254740992.0) return std::nullopt;
    return static_cast<long long>(*value);
}

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

std::string read_file(const std::string &path) {
    // A directory opens as a stream and then reads as empty.
    if (std::filesystem::is_directory(path)) throw UserError(path + ": is a directory");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw UserError(path + ": " + (errno ? std::strerror(errno) : "cannot be opened"));
    std::ostringstream text;
    text << file.rdbuf();
    if (file.bad()) throw UserError(path + ": cannot be read");
    return std::move(text).str();
}

}  // namespace examples
