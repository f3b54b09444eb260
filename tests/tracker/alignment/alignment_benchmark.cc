// Measures how long a fit of a marker to an image takes, from a guess with a relative error of its
// side.

#include <benchmark/benchmark.h>

#include <memory>

#include "tests/tracker/marker_rendering.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {
namespace {

struct Scene {
  CameraModel camera;
  std::shared_ptr<const MarkerPattern> marker_pattern =
      std::make_shared<MarkerPattern>(SgMarkerPattern(7));
  GreyImage image;
  std::unique_ptr<LensGrid> lens;
  PixelWindow window;
  BlockFitState guess;

  Scene(double side_px, bool bent, double off) {
    camera.width = 320;
    camera.height = 240;
    camera.fx = camera.fy = 400.0;
    camera.cx = 160.3;
    camera.cy = 119.8;
    if (bent) camera.distortion[0] = -0.2;
    RenderedMarker marker;
    marker.pattern = marker_pattern;
    marker.camera_from_marker = PoseAtPixel(camera, {158.0, 121.0}, side_px, marker.size,
                                            Radians(0.5), Radians(0.4), Radians(0.3));
    RenderingOptions options;
    options.blur_px = 0.6;
    options.noise_codes = 2.0;
    image = RenderMarkers(camera, {marker}, options);
    lens = std::make_unique<LensGrid>(camera);
    std::array<Vec2, 4> corners = TrueCorners(camera, marker);
    const int half = static_cast<int>(0.62 * side_px) + 1;
    window = {0, 158 - half, 121 - half, 2 * half, 2 * half};
    for (int i = 0; i < 4; ++i) {
      corners[i] = lens->Undistort(corners[i].x, corners[i].y);
      corners[i].x += off * side_px * (i == 1 ? -0.5 : 1.0);
      corners[i].y += off * side_px * (i == 2 ? -0.7 : 0.6);
    }
    const double half_edge = 0.5 * marker_pattern->edge_modules,
                 middle = 0.5 * marker_pattern->modules;
    guess.modules_from_undistorted = Mat3{{half_edge, 0, middle, 0, -half_edge, middle, 0, 0, 1}} *
                                     Adjugate(HomographyToQuad(corners));
    guess.blur_px = 0.7;
  }
};

/// Edge of the marker in pixels, and number of steps.
void FitFinely(benchmark::State& state) {
  const double side = static_cast<double>(state.range(0));
  const Scene scene(side, true, 0.004);
  ObservedPatch observed;
  TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, &observed);
  BlockFit fit;
  BlockFitOptions options;
  options.steps = static_cast<int>(state.range(1));
  options.fit_blur = true;
  options.done_px = 0.0;
  for (auto _ : state) {
    BlockFitState at = scene.guess;
    benchmark::DoNotOptimize(fit.Run(*scene.marker_pattern, MarkerPart::kWhole, observed,
                                     BlockFit::BlocksAlong(1.2 * side, 14.0), options, &at));
  }
}
BENCHMARK(FitFinely)->Args({120, 5})->Args({42, 5})->Args({16, 5})->Unit(benchmark::kMicrosecond);

/// The same, with a stop at convergence.
void FitFinelyUntilDone(benchmark::State& state) {
  const double side = static_cast<double>(state.range(0));
  const Scene scene(side, true, 0.004);
  ObservedPatch observed;
  TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, &observed);
  BlockFit fit;
  BlockFitOptions options;
  options.steps = 5;
  options.fit_blur = true;
  for (auto _ : state) {
    BlockFitState at = scene.guess;
    benchmark::DoNotOptimize(fit.Run(*scene.marker_pattern, MarkerPart::kWhole, observed,
                                     BlockFit::BlocksAlong(1.2 * side, 14.0), options, &at));
  }
}
BENCHMARK(FitFinelyUntilDone)->Arg(120)->Unit(benchmark::kMicrosecond);

void FitCoarsely(benchmark::State& state) {
  const double side = static_cast<double>(state.range(0));
  const Scene scene(side, true, 0.03);
  ObservedPatch observed;
  TakeCodeWindow(*scene.lens, scene.image.view(), scene.window, &observed);
  BlockFit fit;
  BlockFitOptions options;
  options.steps = static_cast<int>(state.range(1));
  options.done_px = 0.0;
  for (auto _ : state) {
    BlockFitState at = scene.guess;
    at.blur_px = 1.2;
    benchmark::DoNotOptimize(fit.Run(*scene.marker_pattern, MarkerPart::kBorder, observed,
                                     BlockFit::BlocksAlong(1.2 * side, 8.0), options, &at));
  }
}
BENCHMARK(FitCoarsely)->Args({52, 8})->Unit(benchmark::kMicrosecond);

void Render(benchmark::State& state) {
  const Scene scene(static_cast<double>(state.range(0)), true, 0.0);
  WindowRays rays;
  LookUpRays(*scene.lens, scene.window, &rays);
  MarkerRaster raster;
  PlaneMap map;
  PredictedImage image;
  const double blur_px = 0.1 * static_cast<double>(state.range(1));
  for (auto _ : state) {
    raster.Render(*scene.marker_pattern, scene.guess.modules_from_undistorted, rays, blur_px, &map,
                  &image);
    benchmark::DoNotOptimize(image.white.data());
  }
}
BENCHMARK(Render)->Args({120, 6})->Args({52, 12})->Unit(benchmark::kMicrosecond);

void TakeWindow(benchmark::State& state) {
  const Scene scene(static_cast<double>(state.range(0)), true, 0.0);
  ObservedPatch observed;
  for (auto _ : state) {
    TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, &observed);
    benchmark::DoNotOptimize(observed.value.data());
  }
}
BENCHMARK(TakeWindow)->Arg(120)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace pleinair::tracker

BENCHMARK_MAIN();
