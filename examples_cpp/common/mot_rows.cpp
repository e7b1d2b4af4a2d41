#include "mot_rows.hpp"

#include <algorithm>
#include <cmath>

#include "text.hpp"

namespace examples {
namespace {

/// The library's limit, asked for here to be able to name the line.
constexpr double max_coordinate = 1e12;

MotRow parse(const std::string &file, long line, std::string_view text, const std::vector<const char *> &names) {
    MotRow row{0, 0, 0, 0, 0, 0, split_commas(text), file, line};
    if (row.fields.size() < names.size()) {
        std::string expected;
        for (const char *name : names) expected += (expected.empty() ? "" : ",") + std::string(name);
        row.refuse("expected at least " + std::to_string(names.size()) + " fields " + expected + ", found " +
                   std::to_string(row.fields.size()));
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < names.size(); ++i) values.push_back(row.number(i, names[i]));
    const auto frame = parse_integer(row.fields[0]);
    if (!frame || *frame < 1 || *frame > max_frame) {
        row.refuse("frame " + quoted(row.fields[0]) + " is not an integer in 1.." + std::to_string(max_frame));
    }
    for (std::size_t i = 2; i < 6; ++i) {
        if (std::abs(values[i]) > max_coordinate) {
            row.refuse(std::string(names[i]) + " " + quoted(row.fields[i]) + " is beyond 1e12 pixels");
        }
    }
    for (std::size_t i = 4; i < 6; ++i) {
        if (values[i] < 0) row.refuse(std::string(names[i]) + " " + quoted(row.fields[i]) + " is negative");
    }
    row.frame = static_cast<long>(*frame);
    row.id = values[1], row.left = values[2], row.top = values[3], row.width = values[4], row.height = values[5];
    return row;
}

}  // namespace

double MotRow::number(std::size_t index, const char *name) const {
    const auto value = parse_number(fields[index]);
    if (!value) refuse(std::string(name) + " " + quoted(fields[index]) + " is not a finite number");
    return *value;
}

void MotRow::refuse(const std::string &reason) const { refuse_line(file, line, reason); }

void for_each_line(std::string_view text, const std::function<void(long, std::string_view)> &visit) {
    // Editors on Windows begin files with this.
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.substr(0, byte_order_mark.size()) == byte_order_mark) text.remove_prefix(byte_order_mark.size());
    for (long number = 1; !text.empty(); ++number) {
        const auto end = std::min(text.find('\n'), text.size());
        const auto line = trimmed(text.substr(0, end));
        if (!line.empty()) visit(number, line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

void refuse_line(const std::string &file, long line, const std::string &reason) {
    throw UserError(file + ":" + std::to_string(line) + ": " + reason);
}

void for_each_row(const NamedText &file, const std::vector<const char *> &names,
                  const std::function<void(const MotRow &)> &visit) {
    for_each_line(file.text, [&](long number, std::string_view line) { visit(parse(file.name, number, line, names)); });
}

}  // namespace examples
