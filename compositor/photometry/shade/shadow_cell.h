#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/shade/shadow_crossing.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Logarithmic brightness of a surface sample, and its position.
struct ShadowSample {
  double value = 0.0;             ///< Mean of the logarithms of linear red, green and blue.
  std::array<double, 2> color{};  ///< Logarithms of red and blue over green.
  Vec3 point;                     ///< Marker coordinates, metres.
};

/// Two levels of brightness, by two-means.
struct TwoLevels {
  double low = 0.0, high = 0.0;  ///< Means.
  double spread = 0.0;           ///< Root mean square distance to the nearer mean.
  double low_share = 0.0;
  std::size_t low_count = 0;
};

/// Surface samples of a small cell on one material that faces the sun.
struct ShadowCell {
  std::vector<ShadowSample> surface_samples;
  std::vector<double> in_sun;  // Values of the surface samples that the model has in the sun.
  bool lit = false;            // The model has some surface sample in the sun.
  bool unlit = false;          // The model has some surface sample in the shade.
  double depth = 0.0;          // Depth of a shadow there, logarithmic, green.
  std::array<double, 2> color_step{};  // Red and blue against green.
  int surface = 0;
  std::size_t index = 0;  // Among the cells of the surface samples.
  Vec3 normal;            // Of its surface, unit, marker coordinates, towards the eye.

  SurfacePlane Plane() const { return PlaneOf(surface, normal); }
  double Median() const {
    return surface_samples[surface_samples.size() / 2].value;
  }  // Surface samples are sorted.
};

/// Splits surface samples that are sorted by value.
TwoLevels SplitInTwo(const std::vector<ShadowSample>& sorted);

/// True if few values lie between the levels: a shadow edge, not a gradient or mottling.
bool IsSharp(const TwoLevels& levels);

/// True if the samples are two groups, on opposite sides or sharp, with few values between.
bool AreTwoSides(const std::vector<ShadowSample>& sorted, const TwoLevels& levels);

/// True if a shadow boundary divides a cell of sorted surface samples: two sharp levels, or two
/// levels on opposite sides.
bool HasShadowBoundary(const ShadowCell& cell, const TwoLevels& levels);

/// True if the darker surface samples of a cell have the color of the brighter ones rather than
/// that of a shadow on them: joints and spots of the surface.
bool IsPatterned(const ShadowCell& cell, const TwoLevels& levels);

/// Measures the shadow boundary in a cell that contains one.
ShadowCrossing CrossingOf(const ShadowCell& cell, const TwoLevels& levels);

/// Converts a cell that lies wholly in shade, darker than in direct sunlight by `contrast`
/// (logarithmic, mean of the channels). The contrast is divided among the channels as the modelled
/// shadow is.
ShadowCrossing CrossingOfShadowedCell(const ShadowCell& cell, double contrast);

}  // namespace pleinair::compositor
