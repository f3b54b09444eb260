// Measures what ink adds to a frame of 640×480 on level ground, by the number of segments in view,
// and how long a grid takes to build.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "compositor/composer.h"
#include "compositor/ink/ink_grid.h"
#include "compositor/ink/ink_shape.h"
#include "compositor/light/light_solver.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

const CameraModel kVga{.width = 640, .height = 480, .fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};

/// Contour-like rings over the 8 m of ground that the camera sees, `segments` in all.
std::vector<InkShape> Rings(int segments, InkBlend blend, int per_ring = 100) {
  std::vector<InkShape> shapes;
  const int rings = segments / per_ring;
  for (int ring = 0; ring < rings; ++ring) {
    InkShape shape{.style = {{0.1, 0.2, 0.9}, 1.0F, blend}, .pen = {.width_m = 0.01F}};
    const float radius =
        3.0F * std::sqrt((static_cast<float>(ring) + 0.5F) / static_cast<float>(rings));
    const auto at = [&](int i) {
      const float turn =
          static_cast<float>(i) / static_cast<float>(per_ring) * 2.0F * std::numbers::pi_v<float>;
      const float wave = radius * (1.0F + 0.05F * std::sin(7.0F * turn));
      return glm::vec3(wave * std::cos(turn), wave * std::sin(turn), 0.0F);
    };
    for (int i = 0; i < per_ring; ++i) shape.segments.push_back({at(i), at(i + 1)});
    shapes.push_back(shape);
  }
  return shapes;
}

void Frame(benchmark::State& state, InkBlend blend) {
  const auto composer = LitComposer({kGround}, SouthernSun(), kVga);
  composer->AssumeUnmodelledShadows(false);
  const std::vector<InkShape> ink = Rings(static_cast<int>(state.range(0)), blend);
  if (!composer->SetInk(ink, Mat3{})) state.SkipWithError("no ink");
  RgbImage picture(kVga.width, kVga.height, 3);
  std::fill_n(picture.data(), picture.size(), std::uint8_t{150});
  // Four metres above the ground, 45° down.
  const double s = std::numbers::sqrt2 / 2;
  const Transform<Camera, Marker> pose{{{1, 0, 0, 0, -s, -s, 0, s, -s}}, {0, 0, 5}};
  const auto draw = [&] {
    return composer
        ->Compose(CameraImageView(picture.view()), pose,
                  {kExposureScale, kExposureScale, kExposureScale})
        .has_value();
  };
  draw();
  for (auto _ : state) {
    if (!draw()) state.SkipWithError("not composed");
  }
}

void BM_Stain(benchmark::State& state) { Frame(state, InkBlend::kStain); }
void BM_Paint(benchmark::State& state) { Frame(state, InkBlend::kPaint); }
// The renderer draws with several threads: the time of all processors counts.
BENCHMARK(BM_Stain)
    ->Arg(0)
    ->Arg(2'500)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK(BM_Paint)
    ->Arg(2'500)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void BM_Grid(benchmark::State& state) {
  const std::vector<InkShape> ink = Rings(static_cast<int>(state.range(0)), InkBlend::kStain);
  for (auto _ : state) benchmark::DoNotOptimize(InkGrid(ink));
}
BENCHMARK(BM_Grid)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pleinair::compositor
