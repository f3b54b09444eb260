#include "content/draping/screen_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/parallel_for.h"

namespace pleinair::content {
namespace {

constexpr double kBeyond_m = 1.0;  // Of the line, at both ends.
constexpr int kMaxSteps = 32;
constexpr double kEnough_px = 0.5;
constexpr double kTolerance_px = 2.0, kTolerance_m = 0.02;

/// A vertical line by two heights.
struct Column {
  Vec2 at;
  double high_m = 0.0, low_m = 0.0;

  Vec3 Point(double height_m) const { return {at.x, at.y, height_m}; }
};

/// Clips a column to the half-space in which a function, linear in the height, is positive.
template <typename Linear>
bool ClipColumn(const Linear& value, Column* column) {
  const double high = value(column->high_m), low = value(column->low_m);
  if (high < 0.0 && low < 0.0) return false;
  const double zero = column->low_m + (column->high_m - column->low_m) * (low / (low - high));
  if (high < 0.0) column->high_m = zero;
  if (low < 0.0) column->low_m = zero;
  return true;
}

/// Clips a column to the picture: homogeneous coordinates are linear in the height.
bool ClipToPicture(const SurfaceView& view, Column* column) {
  const CameraModel& camera = view.camera();
  const auto at = [&](double height_m) { return view.InCamera(column->Point(height_m)); };
  return ClipColumn([&](double h) { return at(h).z - SurfaceView::kNear_m; }, column) &&
         ClipColumn([&](double h) { return camera.fx * at(h).x + (camera.cx + 0.5) * at(h).z; },
                    column) &&
         ClipColumn(
             [&](double h) {
               return (camera.width - 0.5 - camera.cx) * at(h).z - camera.fx * at(h).x;
             },
             column) &&
         ClipColumn([&](double h) { return camera.fy * at(h).y + (camera.cy + 0.5) * at(h).z; },
                    column) &&
         ClipColumn(
             [&](double h) {
               return (camera.height - 0.5 - camera.cy) * at(h).z - camera.fy * at(h).y;
             },
             column);
}

/// A place of the column against the surface on its ray.
struct Probe {
  double height_m = 0.0;
  Vec2 pixel;
  std::optional<SurfaceView::Sight> sight;
  double below_m = 0.0;  // How much farther than the surface it is; negative: it is above.
};

Probe ProbeAt(const SurfaceView& view, const Column& column, double height_m) {
  Probe probe;
  probe.height_m = height_m;
  const Vec3 point = column.Point(height_m);
  probe.pixel = view.PixelOf(point).value_or(Vec2{-1e9, -1e9});
  // Rounding may put the ends of a clipped column just outside.
  probe.pixel = {std::clamp(probe.pixel.x, -0.5, view.camera().width - 0.5),
                 std::clamp(probe.pixel.y, -0.5, view.camera().height - 0.5)};
  probe.sight = view.At(probe.pixel);
  probe.below_m = probe.sight ? Norm(point - view.centre()) - Norm(probe.sight->at - view.centre())
                              : -std::numeric_limits<double>::infinity();
  return probe;
}

double BesideOf(const SurfaceView::Sight& sight, const Column& column) {
  return std::hypot(sight.at.x - column.at.x, sight.at.y - column.at.y);
}

}  // namespace

HeightRange HeightsOf(const SurfaceIndex& surface) {
  HeightRange range{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const Point<World>& vertex : surface.mesh().vertices) {
    range.low_m = std::min(range.low_m, vertex.xyz.z);
    range.high_m = std::max(range.high_m, vertex.xyz.z);
  }
  return range;
}

std::optional<ScreenHeight> SearchScreen(const SurfaceView& view, Vec2 east_north,
                                         const HeightRange& range) {
  Column column{east_north, range.high_m + kBeyond_m, range.low_m - kBeyond_m};
  if (!(column.high_m > column.low_m) || !ClipToPicture(view, &column)) return std::nullopt;
  Probe high = ProbeAt(view, column, column.high_m), low = ProbeAt(view, column, column.low_m);
  for (int step = 0; step < kMaxSteps && Norm(high.pixel - low.pixel) > kEnough_px; ++step) {
    const Probe middle = ProbeAt(view, column, 0.5 * (high.height_m + low.height_m));
    (middle.below_m < 0.0 ? high : low) = middle;
  }
  // One secant step, where both ends see a surface and lie on its two sides.
  Probe found = low.sight ? low : high;
  if (high.sight && low.sight && high.below_m < 0.0 && low.below_m >= 0.0) {
    const double share = high.below_m / (high.below_m - low.below_m);
    found = ProbeAt(view, column, high.height_m + (low.height_m - high.height_m) * share);
  }
  if (!found.sight) return std::nullopt;
  const double pixel_m =
      Norm(found.sight->at - view.centre()) / std::min(view.camera().fx, view.camera().fy);
  const double tolerance_m = kTolerance_px * pixel_m + kTolerance_m;
  const bool hidden = BesideOf(*found.sight, column) > tolerance_m;
  return ScreenHeight{hidden ? found.sight->at.z : found.height_m, hidden};
}

ScreenDrape DrapeOnScreen(std::span<const LineToDrape> lines, const SurfaceView& view,
                          const SurfaceIndex& surface, const DrapeOptions& options) {
  const HeightRange range = HeightsOf(surface);
  ScreenDrape all;
  all.draped.rings.resize(lines.size());
  std::vector<ScreenDrape> parts(lines.size());
  ParallelFor(lines.size(), options.threads, [&](std::size_t i) {
    const LineToDrape& line = lines[i];
    ScreenDrape& part = parts[i];
    bool goes_on = false;
    for (const Point<World>& point : line.points) {
      ++part.draped.report.vertices_in;
      const Vec2 at{point.xyz.x, point.xyz.y};
      if (Norm(at) > options.radius_m) {
        ++part.draped.report.clipped;
        goes_on = false;
        continue;
      }
      const std::optional<ScreenHeight> seen = SearchScreen(view, at, range);
      double height_m = seen ? seen->height_m : 0.0;
      bool hidden = false;
      if (!seen || seen->hidden) {
        const std::optional<double> exact_m = surface.HeightAt(at, options.on);
        if (!exact_m) {
          ++part.draped.report.off_target;
          goes_on = false;
          continue;
        }
        height_m = *exact_m;
        hidden = IsHiddenFrom(surface, view.centre(), {at.x, at.y, height_m});
      }
      if (!std::exchange(goes_on, true)) {
        part.draped.pieces.push_back({i, {}, true, true});
        part.hidden.emplace_back();
      }
      const Point<World> draped{{at.x, at.y, height_m + line.above_m}};
      part.draped.pieces.back().vertices.push_back({draped, true});
      part.hidden.back().push_back(hidden);
      ++part.draped.report.vertices_out;
      if (line.kind == PartKind::kRing) all.draped.rings[i].push_back(draped);
    }
  });
  for (ScreenDrape& part : parts) {
    std::move(part.draped.pieces.begin(), part.draped.pieces.end(),
              std::back_inserter(all.draped.pieces));
    std::move(part.hidden.begin(), part.hidden.end(), std::back_inserter(all.hidden));
    all.draped.report.vertices_in += part.draped.report.vertices_in;
    all.draped.report.vertices_out += part.draped.report.vertices_out;
    all.draped.report.off_target += part.draped.report.off_target;
    all.draped.report.clipped += part.draped.report.clipped;
  }
  return all;
}

}  // namespace pleinair::content
