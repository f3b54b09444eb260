#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"
#include "tracker/quads/dark_components.h"

namespace pleinair::tracker {

/// Fits a quadrilateral to a component of dark pixels.
class QuadOutline {
 public:
  /// Corners clockwise in the image, half a pixel outside the outermost pixel centres. Returns
  /// nullopt if the convex hull of the component is not a quadrilateral with sides of at least
  /// `min_side_px`.
  std::optional<std::array<Vec2, 4>> Fit(std::span<const DarkRun> runs,
                                         const DarkComponent& component, double min_side_px);

 private:
  void BuildHull(std::span<const DarkRun> runs, const DarkComponent& component);

  struct Vertex {
    int x, y;
  };
  std::vector<int> left_, right_;  // Outermost dark pixels of each row of the component.
  std::vector<Vertex> hull_;       // Clockwise in the image.
  std::vector<int> cuts_;          // Area lost by dropping each vertex of the hull.
};

}  // namespace pleinair::tracker
