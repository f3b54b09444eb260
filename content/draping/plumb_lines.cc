#include "content/draping/plumb_lines.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include "base/parallel_for.h"

namespace pleinair::content {
namespace {

constexpr double kEarthRadius_m = 6.371e6;
constexpr double kEnough_m = 1e-5;  // Of a shift.
constexpr int kSteps = 2;           // Each leaves d/R of the shift before, times the slope.

}  // namespace

void MoveAlongPlumbLines(const LocalFrame& frame, const SurfaceIndex& surface,
                         const SurfaceRule& rule, std::span<const GeodeticPoint> geodetic,
                         std::span<Point<World>> points) {
  constexpr std::size_t kBlock = 4096;
  ParallelForBlocks(points.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      GeodeticPoint at = geodetic[i];
      for (int step = 0; step < kSteps; ++step) {
        const Vec3& point = points[i].xyz;
        const std::optional<double> height_m = surface.HeightAt({point.x, point.y}, rule);
        if (!height_m) break;
        const double rise_m = *height_m - point.z;
        if (std::fabs(rise_m) * std::hypot(point.x, point.y) < kEnough_m * kEarthRadius_m) break;
        at.height_m += rise_m;
        points[i] = frame.EastNorthUp(at);
      }
    }
  });
}

}  // namespace pleinair::content
