#include "app/flow/flow_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "app/flow/speed_colors.h"
#include "export/plots/vector_drawing.h"

namespace pleinair::app {
namespace {

constexpr double kDrawingSide = 1000.0, kBorder = 30.0, kLegend = 70.0;
constexpr int kFlowPlanWidth_px = 1000;
constexpr int kColorBins = 16;
constexpr exports::DrawingColor kText{25, 28, 32};

/// The largest of 1, 2, 5, 10, 20, … that is at most `value`.
double RoundLength(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= value) return step * power;
  }
  return power;
}

}  // namespace

std::string FlowPlan(const FlowLines& lines) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Vec2 low{kFar, kFar}, high{-kFar, -kFar};
  for (const auto& points : lines.points) {
    for (const Vec3& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  if (lines.points.empty()) low = high = {};
  const double extent = std::max({high.x - low.x, high.y - low.y, 1e-9});
  const double scale = (kDrawingSide - 2.0 * kBorder) / extent;
  exports::VectorDrawing drawing;
  drawing.width = (high.x - low.x) * scale + 2.0 * kBorder;
  drawing.width = std::max(drawing.width, 0.5 * kDrawingSide);
  drawing.height = (high.y - low.y) * scale + 2.0 * kBorder + kLegend;
  drawing.title = "Lines of a flow";
  const SpeedColors colors(lines);
  const double range = std::max(colors.high_m_s() - colors.low_m_s(), 1e-12);
  const auto bin_of = [&](double speed_m_s) {
    const double share = std::clamp((speed_m_s - colors.low_m_s()) / range, 0.0, 1.0);
    return std::min(static_cast<int>(share * kColorBins), kColorBins - 1);
  };
  const auto color_of = [&](int bin) {
    const auto rgb = colors.Srgb8(colors.low_m_s() + (bin + 0.5) / kColorBins * range);
    return exports::DrawingColor{rgb[0], rgb[1], rgb[2]};
  };
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    int last_bin = -1;
    for (std::size_t n = 0; n < lines.points[i].size(); ++n) {
      const Vec3& p = lines.points[i][n];
      const Vec2 at{kBorder + (p.x - low.x) * scale, kBorder + (high.y - p.y) * scale};
      const int bin = bin_of(lines.lines[i].speeds_m_s[n]);
      if (n > 0) drawing.lines.back().points.push_back(at);
      if (bin == last_bin) continue;
      drawing.lines.push_back({{at}, color_of(bin), 1.5, false});
      last_bin = bin;
    }
  }
  std::erase_if(drawing.lines,
                [](const exports::DrawingLine& line) { return line.points.size() < 2; });
  const double y = drawing.height - kLegend + 20.0;
  constexpr double kSwatch = 10.0;
  for (int bin = 0; bin < kColorBins; ++bin) {
    const double x = kBorder + bin * kSwatch;
    drawing.lines.push_back({{{x, y}, {x + kSwatch, y}}, color_of(bin), 10.0, false});
  }
  drawing.texts.push_back(
      {{kBorder + 0.5 * kColorBins * kSwatch, y + 25.0},
       14.0,
       fmt::format("speed {:.3g} to {:.3g} m/s", colors.low_m_s(), colors.high_m_s()),
       kText});
  const double bar_m = RoundLength(0.25 * extent);
  const double right = drawing.width - kBorder;
  drawing.lines.push_back({{{right - bar_m * scale, y}, {right, y}}, kText, 3.0, false});
  drawing.texts.push_back(
      {{right - 0.5 * bar_m * scale, y + 25.0}, 14.0, fmt::format("{:g} m", bar_m), kText});
  return exports::DrawingSvg(drawing, kFlowPlanWidth_px);
}

}  // namespace pleinair::app
