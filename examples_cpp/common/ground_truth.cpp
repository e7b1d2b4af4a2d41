#include "ground_truth.hpp"

#include "text.hpp"

namespace examples {
namespace {

/// MOT16's and MOT17's numbers of classes.
constexpr long long pedestrian = 1, person_on_vehicle = 2, static_person = 7, distractor = 8, reflection = 12;

bool is_distractor(long long kind) {
    return kind == person_on_vehicle || kind == static_person || kind == distractor || kind == reflection;
}

}  // namespace

GroundTruth read_ground_truth(const std::string &path) {
    const std::string text = read_file(path);
    return parse_ground_truth({path, text});
}

GroundTruth parse_ground_truth(const NamedText &file) {
    GroundTruth truth;
    for_each_row(file, {"frame", "id", "left", "top", "width", "height"}, [&](const MotRow &row) {
        const auto object = parse_integer(row.fields[1]);
        if (!object || *object < 0) row.refuse("id " + quoted(row.fields[1]) + " is not an integer from 0");
        const double flag = row.fields.size() > 6 ? row.number(6, "flag") : 1;
        const bool has_class = row.fields.size() == 8 || row.fields.size() == 9;
        const auto kind = has_class ? parse_integer(row.fields[7]) : pedestrian;
        if (!kind) row.refuse("class " + quoted(row.fields[7]) + " is not an integer");
        truth[row.frame].push_back({static_cast<std::uint64_t>(*object),
                                    {row.left, row.top, row.width, row.height},
                                    flag != 0 && *kind == pedestrian,
                                    is_distractor(*kind)});
    });
    return truth;
}

}  // namespace examples
