#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/shade/shadow_crossing.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// A surface sample's logarithmic brightness, and where it lies.
struct ShadowSample {
  double value = 0.0;             ///< Mean of the logarithms of linear red, green and blue.
  std::array<double, 2> color{};  ///< Logarithms of red and blue over green.
  Vec3 point;                     ///< Marker coordinates, metres.
};

/// Two levels of brightness, by two-means.
struct TwoLevels {
  double low = 0.0, high = 0.0;  ///< Means.
  double spread = 0.0;           ///< Root mean square about the nearer one.
  double low_share = 0.0;
  std::size_t low_count = 0;
};

/// What is seen of a small place on one material that faces the sun.
struct ShadowCell {
  std::vector<ShadowSample> surface_samples;
  std::vector<double> in_sun;  // Values of the surface samples that the model has in the sun.
  bool lit = false;            // Whether the model has some surface sample in the sun,
  bool unlit = false;          // and whether some in the shade.
  double depth = 0.0;          // Of a shadow there, logarithmic, green.
  std::array<double, 2> color_step{};  // Red and blue against green.
  int surface = 0;
  Vec3 normal;  // Of its surface, unit, marker coordinates, towards the eye.

  SurfacePlane Plane() const { return PlaneOf(surface, normal); }
  double Median() const {
    return surface_samples[surface_samples.size() / 2].value;
  }  // They are sorted.
};

/// Of sorted surface samples.
TwoLevels SplitInTwo(const std::vector<ShadowSample>& sorted);

/// Whether little lies between the levels: a shadow's edge, no gradient or mottling.
bool IsSharp(const TwoLevels& levels);

/// Whether a shadow's edge divides a cell of sorted surface samples: two sharp levels, or two on a
/// side each.
bool HasShadowBoundary(const ShadowCell& cell, const TwoLevels& levels);

/// What a crossed cell shows.
ShadowCrossing CrossingOf(const ShadowCell& cell, const TwoLevels& levels);

/// A cell that lies wholly in shade, darker than in the open by `contrast` (logarithmic, mean of
/// the channels), which is divided among the channels as the model's shadow is.
ShadowCrossing CrossingOfShadowedCell(const ShadowCell& cell, double contrast);

}  // namespace pleinair::compositor
