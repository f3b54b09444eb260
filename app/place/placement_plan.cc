#include "app/place/placement_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/units.h"

namespace pleinair::app {
namespace {

constexpr double kSide = 1000.0;
constexpr double kFooter = 90.0;
constexpr double kMargin = 60.0;
constexpr double kPlanRadius = kSide / 2.0 - kMargin;
constexpr Vec2 kCentre{kSide / 2.0, kSide / 2.0};

constexpr exports::DrawingColor kGrid{205, 210, 215};
constexpr exports::DrawingColor kQuiet{110, 115, 120};
constexpr exports::DrawingColor kInk{25, 28, 32};
constexpr exports::DrawingColor kMarker{200, 30, 30};
constexpr std::array<exports::DrawingColor, 6> kLayerColors = {
    {{20, 95, 170}, {20, 130, 70}, {160, 90, 10}, {120, 50, 150}, {0, 125, 140}, {90, 90, 30}}};

/// The part of a segment within the disc of `radius` about the origin.
std::optional<std::pair<Vec2, Vec2>> ClippedToDisc(Vec2 a, Vec2 b, double radius) {
  const Vec2 way = b - a;
  const double square = way.x * way.x + way.y * way.y;
  if (!(square > 0.0)) return std::nullopt;
  const double half = (a.x * way.x + a.y * way.y) / square;
  const double root = half * half - (a.x * a.x + a.y * a.y - radius * radius) / square;
  if (!(root > 0.0)) return std::nullopt;
  const double begin = std::max(0.0, -half - std::sqrt(root));
  const double end = std::min(1.0, -half + std::sqrt(root));
  if (!(begin < end)) return std::nullopt;
  return std::pair{a + way * begin, a + way * end};
}

/// The largest of 1, 2, 5 times a power of ten that is at most `value`.
double RoundDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= value) return step * power;
  }
  return power;
}

/// Drawings have ASCII text.
std::string Ascii(const std::string& text, std::size_t max_length) {
  std::string plain;
  for (const char c : text.substr(0, max_length)) plain += c >= ' ' && c <= '~' ? c : '?';
  return plain;
}

class Plan {
 public:
  explicit Plan(const Placement& placement) : placement_(placement) {
    drawing_.width = kSide;
    drawing_.height = kSide + kFooter;
    drawing_.title = "Plan of " + placement.file;
    reach_m_ = 1.0;
    for (const content::PlacedLayer& layer : placement.layers) {
      for (const content::PlacedFeature& feature : layer.features) {
        if (feature.nearest_m > placement.radius_m) continue;
        reach_m_ = std::max(reach_m_, std::min(feature.farthest_m, placement.radius_m));
      }
    }
    reach_m_ *= 1.05;
  }

  exports::VectorDrawing Draw() && {
    DrawRings();
    for (std::size_t i = 0; i < placement_.layers.size(); ++i) {
      DrawLayer(placement_.layers[i], kLayerColors[i % kLayerColors.size()]);
    }
    DrawMarker();
    DrawWords();
    return std::move(drawing_);
  }

 private:
  Vec2 OnPlan(Vec2 world) const {
    return kCentre + Vec2{world.x, -world.y} * (kPlanRadius / reach_m_);
  }

  void DrawRings() {
    const double step_m = RoundDown(reach_m_ / 2.0);
    for (int ring = 1; ring * step_m <= reach_m_; ++ring) {
      const double radius = ring * step_m * kPlanRadius / reach_m_;
      exports::DrawingLine circle{{}, kGrid, 1.0, false};
      for (int degrees = 0; degrees <= 360; degrees += 3) {
        const double a = FromDegrees(degrees).value();
        circle.points.push_back(kCentre + Vec2{std::sin(a), -std::cos(a)} * radius);
      }
      drawing_.lines.push_back(std::move(circle));
      drawing_.texts.push_back({kCentre + Vec2{radius * 0.7071, radius * 0.7071}, 14.0,
                                fmt::format("{:g} m", ring * step_m), kQuiet});
    }
    constexpr std::array<std::pair<const char*, Vec2>, 4> kCompass = {
        {{"N", {0.0, -1.0}}, {"E", {1.0, 0.0}}, {"S", {0.0, 1.0}}, {"W", {-1.0, 0.0}}}};
    for (const auto& [name, way] : kCompass) {
      drawing_.lines.push_back({{kCentre, kCentre + way * kPlanRadius}, kGrid, 1.0, false});
      drawing_.texts.push_back({kCentre + way * (kPlanRadius + 25.0), 26.0, name, kInk});
    }
  }

  void DrawLayer(const content::PlacedLayer& layer, exports::DrawingColor color) {
    for (const content::PlacedFeature& feature : layer.features) {
      for (const content::PlacedPart& part : feature.parts) DrawPart(part, color);
    }
  }

  void DrawPart(const content::PlacedPart& part, exports::DrawingColor color) {
    const auto at = [&](std::size_t i) { return Vec2{part.points[i].xyz.x, part.points[i].xyz.y}; };
    if (part.kind == content::PartKind::kPoint) {
      if (Norm(at(0)) <= reach_m_) drawing_.discs.push_back({OnPlan(at(0)), 5.0, color});
      return;
    }
    exports::DrawingLine line{{}, color, 2.2, false};
    for (std::size_t i = 1; i < part.points.size(); ++i) {
      const auto clipped = ClippedToDisc(at(i - 1), at(i), reach_m_);
      if (!clipped) continue;
      const Vec2 begin = OnPlan(clipped->first), end = OnPlan(clipped->second);
      if (line.points.empty() || Norm(line.points.back() - begin) > 0.05) {
        if (line.points.size() > 1) drawing_.lines.push_back(line);
        line.points = {begin};
      }
      line.points.push_back(end);
    }
    if (line.points.size() > 1) drawing_.lines.push_back(std::move(line));
  }

  void DrawMarker() {
    drawing_.discs.push_back({kCentre, 6.0, kMarker});
    if (!placement_.marker_from_world) return;
    // The marker's +y, or on a wall the way into it, as a direction on the map.
    const Mat3 world_from_marker = placement_.marker_from_world->Transposed();
    Vec3 ahead = world_from_marker * Vec3{0.0, 1.0, 0.0};
    if (std::fabs(ahead.z) > 0.5) ahead = world_from_marker * Vec3{0.0, 0.0, -1.0};
    const Vec2 way{ahead.x, -ahead.y};
    const Vec2 side{-way.y, way.x};
    const Vec2 tip = kCentre + way * 60.0;
    drawing_.lines.push_back({{kCentre, tip}, kMarker, 3.0, false});
    drawing_.lines.push_back(
        {{tip - way * 14.0 + side * 8.0, tip, tip - way * 14.0 - side * 8.0}, kMarker, 3.0, false});
  }

  void DrawWords() {
    const std::string name = std::filesystem::path(placement_.file).filename().string();
    drawing_.texts.push_back(
        {{kSide / 2.0, kSide + 5.0},
         20.0,
         fmt::format("{} around {:.6f}, {:.6f}", Ascii(name, 50), placement_.place.latitude_deg,
                     placement_.place.longitude_deg),
         kInk});
    const std::size_t shown = std::min<std::size_t>(placement_.layers.size(), 4);
    for (std::size_t i = 0; i < shown; ++i) {
      const double x = kSide * (static_cast<double>(i) + 0.5) / static_cast<double>(shown);
      drawing_.texts.push_back({{x, kSide + 50.0},
                                16.0,
                                Ascii(placement_.layers[i].name, 26),
                                kLayerColors[i % kLayerColors.size()]});
    }
  }

  const Placement& placement_;
  exports::VectorDrawing drawing_;
  double reach_m_ = 1.0;  ///< At the rim of the plan.
};

}  // namespace

exports::VectorDrawing DrawPlacement(const Placement& placement) { return Plan(placement).Draw(); }

}  // namespace pleinair::app
