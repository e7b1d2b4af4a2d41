// Includes the header before anything else, and a second time in this program.
#include "gentrack2_opencv.hpp"

#include "gentrack2_opencv.hpp"

unsigned format_of_grey() { return static_cast<unsigned>(gentrack2::image(cv::Mat::zeros(2, 3, CV_8UC1)).format); }
