#pragma once

namespace pleinair::compositor {

/// Brightness across an edge, 0 in the black to 1 in the white, and its derivatives by distance and
/// by the Gaussian's blur.
struct EdgeProfile {
  double value = 0.0, slope = 0.0, by_blur = 0.0;
};

/// An edge after a uniform disc of this diameter and a Gaussian with this standard deviation, at a
/// distance from the edge towards the white. Pixels.
EdgeProfile DefocusedEdge(double distance_px, double circle_px, double blur_px);

/// The same after a box of this length, too: an edge that moves so far across itself during the
/// exposure.
EdgeProfile MovedEdge(double distance_px, double circle_px, double streak_px, double blur_px);

}  // namespace pleinair::compositor
