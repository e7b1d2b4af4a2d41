// gt2_mot: tracks a video or a file of detections; `gt2_mot --help` is its manual.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <string>
#include <vector>

#include "options.hpp"
#include "run.hpp"
#include "text.hpp"

namespace {

/// OpenCV and FFmpeg write their own remarks to stderr; an error is to be one clear line.
void silence_libraries() {
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    cv::redirectError([](int, const char *, const char *, const char *, int, void *) { return 0; });
}

/// A message on one line, whatever a library put into it.
std::string one_line(std::string text) {
    for (char &c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return text;
}

}  // namespace

int main(int argc, char **argv) {
    silence_libraries();
    try {
        const auto options = gt2_mot::parse_options(std::vector<std::string>(argv + 1, argv + argc));
        if (options.help) {
            std::fputs(gt2_mot::usage().c_str(), stdout);
            return EXIT_SUCCESS;
        }
        gt2_mot::run(options);
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "gt2_mot: %s\n", one_line(error.what()).c_str());
        return EXIT_FAILURE;
    }
}
