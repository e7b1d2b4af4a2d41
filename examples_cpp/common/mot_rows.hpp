// One row of a MOTChallenge file, read strictly.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace examples {

/// The highest frame number accepted: a typing error must not become a day of empty steps.
constexpr long max_frame = 10'000'000;

/// What a file holds, and what messages call it.
struct NamedText {
    std::string name;
    std::string_view text;
};

/// `frame,id,left,top,width,height`, which all rows begin with, and all fields.
struct MotRow {
    long frame;
    double id, left, top, width, height;
    std::vector<std::string_view> fields;
    /// Where it is, for messages.
    const std::string &file;
    long line;

    /// Field `index` as a finite number; refused under that name if it is none.
    double number(std::size_t index, const char *name) const;

    [[noreturn]] void refuse(const std::string &reason) const;
};

/// Calls `visit(number, line)` for every line of `text` that is not blank.
void for_each_line(std::string_view text, const std::function<void(long, std::string_view)> &visit);

/// Throws a `UserError` about a line of a file.
[[noreturn]] void refuse_line(const std::string &file, long line, const std::string &reason);

/// Calls `visit` for every row of a file of MOTChallenge rows; blank lines are skipped. `names` are those of the fields
/// that there must be, the first six as above. Throws `UserError` with the line number and the reason for a bad row.
void for_each_row(const NamedText &file, const std::vector<const char *> &names,
                  const std::function<void(const MotRow &)> &visit);

}  // namespace examples
