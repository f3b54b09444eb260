// Measures the exact drape: one million vertices of lines on 500,000 triangles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "content/draping/drape_lines.h"
#include "tests/content/draping/made_surfaces.h"

namespace pleinair::content {
namespace {

double Hills(double x, double y) {
  return 8.0 * std::sin(0.021 * x) * std::cos(0.017 * y) + 0.03 * x;
}

/// Winding lines of 1,000 vertices 1 m apart.
std::vector<LineToDrape> Trails(std::size_t lines, double half_m) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-half_m, half_m), turn(-0.3, 0.3);
  std::vector<LineToDrape> trails(lines);
  for (LineToDrape& trail : trails) {
    Vec3 at{place(random), place(random), 0.0};
    double way = place(random);
    for (int i = 0; i < 1000; ++i) {
      trail.points.push_back({at});
      way += turn(random);
      const Vec3 next{at.x + std::cos(way), at.y + std::sin(way), 0.0};
      if (std::fabs(next.x) < half_m && std::fabs(next.y) < half_m) {
        at = next;
      } else {
        way += 2.0;
      }
    }
  }
  return trails;
}

void DrapeAMillionVertices(benchmark::State& state) {
  tests::MeshMaker maker;
  maker.Field(500, 500.0, Hills);
  const SurfaceMesh mesh = maker.Take();
  const std::vector<LineToDrape> trails = Trails(1000, 490.0);
  DrapeOptions options;
  options.threads = static_cast<int>(state.range(0));
  for ([[maybe_unused]] auto each : state) {
    const auto index = SurfaceIndex::Create(mesh);
    const auto layer = DrapeExactly(trails, *index, options, "trails");
    state.counters["vertices_out"] = static_cast<double>(layer->report.vertices_out);
  }
}
BENCHMARK(DrapeAMillionVertices)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace pleinair::content
