#include "app/flow/speed_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/quantile.h"
#include "base/srgb.h"

namespace pleinair::app {
namespace {

/// Viridis at every eighth, as sRGB values.
constexpr std::array<LinearRgb, 9> kViridis = {{{0.267, 0.005, 0.329},
                                                {0.283, 0.141, 0.458},
                                                {0.254, 0.265, 0.530},
                                                {0.207, 0.372, 0.553},
                                                {0.164, 0.471, 0.558},
                                                {0.128, 0.567, 0.551},
                                                {0.267, 0.679, 0.481},
                                                {0.565, 0.790, 0.314},
                                                {0.993, 0.906, 0.144}}};

}  // namespace

SpeedColors::SpeedColors(const FlowLines& lines) {
  std::vector<double> speeds;
  for (const content::FlowLine& line : lines.lines) {
    for (const double speed : line.speeds_m_s) {
      if (std::isfinite(speed)) speeds.push_back(speed);
    }
  }
  if (speeds.empty()) return;
  low_m_s_ = Quantile(speeds, 0.02);
  high_m_s_ = Quantile(std::move(speeds), 0.98);
}

LinearRgb SpeedColors::SrgbOf(double speed_m_s) const {
  const double range = std::max(high_m_s_ - low_m_s_, 1e-12);
  const double at = std::clamp((speed_m_s - low_m_s_) / range, 0.0, 1.0) * (kViridis.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
  const double rest = at - static_cast<double>(index);
  return kViridis[index] * (1.0 - rest) + kViridis[index + 1] * rest;
}

std::array<std::uint8_t, 3> SpeedColors::Srgb8(double speed_m_s) const {
  const LinearRgb color = SrgbOf(speed_m_s);
  const auto code = [](double value) {
    return static_cast<std::uint8_t>(std::lround(value * 255));
  };
  return {code(color.r), code(color.g), code(color.b)};
}

std::array<std::uint8_t, 3> SpeedColors::Linear8(double speed_m_s) const {
  const LinearRgb color = SrgbOf(speed_m_s);
  const auto code = [](double value) {
    return static_cast<std::uint8_t>(std::lround(LinearFromSrgb(value) * 255));
  };
  return {code(color.r), code(color.g), code(color.b)};
}

}  // namespace pleinair::app
