// Marks identity switches on pictures.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "identity_switches.hpp"

namespace examples {

class SwitchMarks {
public:
    /// Marks are shown for a second.
    explicit SwitchMarks(double frame_rate);

    /// Takes in a frame: matches its tracks with the truth and marks the switches.
    void add(const std::vector<TrueBox> &truth, const std::vector<TrackedBox> &tracks);

    /// Draws the marks of the last second: a frame around the object's true box, which closes in on it and then stays,
    /// and the old and the new identity.
    void draw(cv::Mat &image) const;

    /// Whether any is shown.
    bool active() const { return !marks_.empty(); }

    /// Switches so far.
    long count() const { return switches_.count(); }

private:
    struct Mark {
        std::uint64_t object;
        std::string text;
        cv::Rect2d box;
        int age;
    };

    IdentitySwitches switches_;
    int duration_;
    std::vector<Mark> marks_;
};

}  // namespace examples
