#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vector.h"
#include "tracker/calibration/lens_fit.h"

namespace pleinair::tracker {

/// Coverage of the image by the views of a board. The image is divided into cells; a cell is
/// covered by a view if its centre lies inside the outline of the view's points.
struct ViewCoverage {
  static constexpr int kColumns = 16, kRows = 12;
  std::array<int, kColumns * kRows> views{};  ///< Row by row from the top-left.

  double Share() const;
  /// Share of covered cells in the left, right, upper and lower half.
  std::array<double, 4> Halves() const;
  void Add(const std::vector<Vec2>& observed_px, int width, int height);
};

ViewCoverage CoverageOf(const std::vector<PlaneView>& views, int width, int height);

}  // namespace pleinair::tracker
