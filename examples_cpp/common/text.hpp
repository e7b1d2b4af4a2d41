// Strict reading of numbers, and the one exception type every user mistake becomes.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace examples {

/// A mistake of the user's: `what()` is the one line that goes to stderr.
struct UserError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// `text` without surrounding blanks.
std::string_view trimmed(std::string_view text);

/// The pieces of `line` between commas, trimmed; empty ones are kept, so that a missing field is noticed.
std::vector<std::string_view> split_commas(std::string_view line);

/// The pieces of `line` between blanks, tabs or commas; empty ones are dropped.
std::vector<std::string_view> split_blanks(std::string_view line);

/// `text` for a message: between quotes, what is not printable ASCII in hexadecimal, and cut if it is long.
std::string quoted(std::string_view text);

/// A finite number that fills the whole of `text`, in any locale.
std::optional<double> parse_number(std::string_view text);

/// A decimal integer that fills the whole of `text`; `1.0` counts, as some tools write frame numbers so.
std::optional<long long> parse_integer(std::string_view text);

/// A number with all its digits.
std::string text_of(double number);

/// The whole of a file; a `UserError` if it cannot be read.
std::string read_file(const std::string &path);

}  // namespace examples
