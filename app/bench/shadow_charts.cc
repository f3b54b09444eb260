#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/bench/shadow_pictures.h"
#include "base/atomic_file.h"
#include "export/plots/vector_drawing.h"

namespace pleinair::app {
namespace {

constexpr double kWidth = 760, kHeight = 460, kLeft = 70, kRight = 150, kTop = 40, kBottom = 50;
constexpr exports::DrawingColor kInk{40, 40, 40}, kGrid{225, 225, 225};
// By method, in the order of ShadowMethods().
constexpr std::array<exports::DrawingColor, 13> kColors{{{120, 120, 120},
                                                         {158, 202, 225},
                                                         {66, 146, 198},
                                                         {8, 81, 156},
                                                         {0, 128, 128},
                                                         {253, 190, 110},
                                                         {230, 130, 40},
                                                         {166, 86, 40},
                                                         {150, 100, 200},
                                                         {90, 60, 140},
                                                         {190, 210, 90},
                                                         {110, 160, 60},
                                                         {140, 0, 0}}};
constexpr exports::DrawingColor kFront{60, 60, 60};

struct Axis {
  double low = 1e30, high = 0.0, start = 0.0, length = 0.0;
  void Include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double At(double value) const {
    return start + length * std::log(value / low) / std::log(high / low);
  }
};

void AddGrid(const Axis& axis, bool along_x, exports::VectorDrawing* drawing) {
  for (int decade = -4; decade <= 4; ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, decade);
      if (value < axis.low || value > axis.high) continue;
      const double at = axis.At(value);
      const std::string text = fmt::format("{:g}", value);
      if (along_x) {
        drawing->lines.push_back({{{at, kTop}, {at, kHeight - kBottom}}, kGrid, 1.0, false});
        drawing->texts.push_back({{at, kHeight - kBottom + 14}, 11.0, text, kInk});
      } else {
        drawing->lines.push_back({{{kLeft, at}, {kWidth - kRight, at}}, kGrid, 1.0, false});
        drawing->texts.push_back({{kLeft - 24, at}, 11.0, text, kInk});
      }
    }
  }
}

/// Draws the Pareto front of time and error as dashed steps.
void AddFront(const ShadowBenchResult& result, const std::string& scene, const Axis& x,
              const Axis& y, exports::VectorDrawing* drawing) {
  std::vector<std::pair<double, double>> rows;
  for (const ShadowBenchRow& row : result.rows) {
    if (row.scene != scene) continue;
    rows.emplace_back(std::max(row.time.cpu_ms, 0.01), std::max(row.errors.rmse, 1e-4));
  }
  std::sort(rows.begin(), rows.end());
  exports::DrawingLine front{.points = {}, .color = kFront, .width = 1.2, .dashed = true};
  double best = 1e30;
  for (const auto& [ms, rmse] : rows) {
    if (rmse >= best) continue;
    if (!front.points.empty()) front.points.push_back({x.At(ms), y.At(best)});
    front.points.push_back({x.At(ms), y.At(rmse)});
    best = rmse;
  }
  if (front.points.size() > 1) drawing->lines.push_back(front);
}

exports::VectorDrawing Chart(const ShadowBenchResult& result, const std::string& scene) {
  exports::VectorDrawing drawing;
  drawing.width = kWidth;
  drawing.height = kHeight;
  drawing.title = "Error over time: " + scene;
  Axis x, y;
  for (const ShadowBenchRow& row : result.rows) {
    if (row.scene != scene) continue;
    x.Include(std::max(row.time.cpu_ms, 0.01));
    y.Include(std::max(row.errors.rmse, 1e-4));
  }
  x.low *= 0.85;
  x.high *= 1.2;
  y.low *= 0.85;
  y.high *= 1.2;
  x.start = kLeft;
  x.length = kWidth - kLeft - kRight;
  y.start = kHeight - kBottom;
  y.length = -(kHeight - kTop - kBottom);
  AddGrid(x, true, &drawing);
  AddGrid(y, false, &drawing);
  drawing.texts.push_back({{kWidth / 2 - 40, 18}, 14.0, drawing.title, kInk});
  drawing.texts.push_back(
      {{kWidth / 2 - 40, kHeight - 14}, 12.0, "processor time of a frame, ms", kInk});
  drawing.texts.push_back({{kLeft - 8, kTop - 12}, 12.0, "RMSE of the picture", kInk});
  AddFront(result, scene, x, y, &drawing);
  double legend = kTop + 8;
  for (const shadows::ShadowMethodTraits& traits : shadows::ShadowMethods()) {
    const exports::DrawingColor color = kColors[static_cast<std::size_t>(traits.method)];
    exports::DrawingLine line;
    line.color = color;
    line.width = traits.method == shadows::ShadowMethod::kSunDisc ? 3.0 : 1.5;
    for (const ShadowBenchRow& row : result.rows) {
      if (row.scene != scene || row.method != traits.method) continue;
      line.points.push_back(
          {x.At(std::max(row.time.cpu_ms, 0.01)), y.At(std::max(row.errors.rmse, 1e-4))});
      drawing.discs.push_back({line.points.back(), line.width + 1.5, color});
    }
    if (line.points.empty()) continue;
    if (line.points.size() > 1) drawing.lines.push_back(line);
    drawing.discs.push_back({{kWidth - kRight + 22, legend}, 4.0, color});
    drawing.texts.push_back({{kWidth - kRight + 78, legend}, 12.0, std::string(traits.name), kInk});
    legend += 22;
  }
  return drawing;
}

}  // namespace

Result<void> WriteShadowCharts(const ShadowBenchResult& result,
                               const std::filesystem::path& folder) {
  std::vector<std::string> scenes;
  for (const ShadowBenchRow& row : result.rows) {
    if (scenes.empty() || scenes.back() != row.scene) scenes.push_back(row.scene);
  }
  for (const std::string& scene : scenes) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / (scene + "_error_over_time.svg"),
                                                 exports::DrawingSvg(Chart(result, scene), 760)));
  }
  return {};
}

}  // namespace pleinair::app
