// What GenTrack2 considers of a track, drawn over the picture on request.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "drawn_track.hpp"

namespace examples {

/// The particles of a track, the fitter the brighter: their boxes, to go under that of the track, and their centres, to
/// go above it.
void draw_particle_boxes(cv::Mat &image, const DrawnTrack &track);
void draw_particle_centres(cv::Mat &image, const DrawnTrack &track);

/// The neighbours of a weak track, found among `all`, trustworthy ones with a solid line; their median motion in a
/// second as an arrow, bold if the track goes with them.
void draw_neighbours(cv::Mat &image, const DrawnTrack &track, const std::vector<DrawnTrack> &all);

}  // namespace examples
