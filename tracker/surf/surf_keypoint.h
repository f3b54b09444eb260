#pragma once

namespace pleinair::tracker {

/// A blob-like keypoint, repeatable under rotation, scaling and moderate tilt. Source: Bay, Ess,
/// Tuytelaars, Van Gool, "Speeded-Up Robust Features (SURF)", Computer Vision and Image
/// Understanding 110(3), 2008; "Bay et al." in this folder.
struct SurfKeypoint {
  float x = 0;  ///< px, integer = centre of a pixel.
  float y = 0;
  float scale = 0;      ///< s = 1.2 L / 9 px for a filter of L px (Bay et al., section 3.3).
  float angle_rad = 0;  ///< Dominant direction, image axes (x right, y down); 0 when upright.
  float response = 0;   ///< Normalised determinant of the Hessian, Eq. (3), for grey in 0..1.
  bool bright = false;  ///< Sign of the Laplacian: true is a bright blob on dark.
};

}  // namespace pleinair::tracker
