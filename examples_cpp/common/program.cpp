#include "program.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace examples {
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

int run_program(const std::string &name, int argc, char **argv,
                const std::function<void(const std::vector<std::string> &)> &work) {
    silence_libraries();
    try {
        work(std::vector<std::string>(argv + 1, argv + argc));
        return EXIT_SUCCESS;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), one_line(error.what()).c_str());
        return EXIT_FAILURE;
    }
}

}  // namespace examples
