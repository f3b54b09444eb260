#pragma once

#include <array>
#include <cstdint>

#include "app/flow/flow_lines.h"
#include "base/vector.h"

namespace pleinair::app {

/// Colors of speeds between the 2 % and 98 % quantiles of all vertices: viridis (van der Walt,
/// Smith 2015), from dark blue to yellow.
class SpeedColors {
 public:
  explicit SpeedColors(const FlowLines& lines);

  std::array<std::uint8_t, 3> Srgb8(double speed_m_s) const;
  /// Linear values, as vertex colors of glTF have them.
  std::array<std::uint8_t, 3> Linear8(double speed_m_s) const;
  double low_m_s() const { return low_m_s_; }
  double high_m_s() const { return high_m_s_; }

 private:
  LinearRgb SrgbOf(double speed_m_s) const;

  double low_m_s_ = 0.0, high_m_s_ = 1.0;
};

}  // namespace pleinair::app
