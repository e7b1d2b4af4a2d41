// gt2_mot: tracks a video or a file of detections; `gt2_mot --help` is its manual.

#include <cstdio>

#include "options.hpp"
#include "program.hpp"
#include "run.hpp"

int main(int argc, char **argv) {
    return examples::run_program("gt2_mot", argc, argv, [](const std::vector<std::string> &arguments) {
        const auto options = gt2_mot::parse_options(arguments);
        if (options.help) {
            std::fputs(gt2_mot::usage().c_str(), stdout);
        } else {
            gt2_mot::run(options);
        }
    });
}
