// Measures what a frame of a skinned body costs beyond that of the same body at rest.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "compositor/composer.h"
#include "compositor/light/light_solver.h"
#include "compositor/models/animation/model_animation.h"
#include "tests/compositor/light/light_scenes.h"
#include "tests/compositor/models/bending_tube.h"

namespace pleinair::compositor {
namespace {

/// A tube of about 50,000 vertices.
AnimatedModel Tube() {
  const testing::BendingTube tube = testing::MakeBendingTube(250, 200);
  const auto folder = std::filesystem::temp_directory_path() / "pleinair_bending_tube";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "tube.bin", std::ios::binary) << tube.buffer;
  std::ofstream(folder / "tube.gltf") << tube.gltf;
  AnimatedModel model = LoadAnimatedModel(folder / "tube.gltf", {}, "Bend").value();
  std::filesystem::remove_all(folder);
  return model;
}

void EvaluateShape(benchmark::State& state) {
  const AnimatedModel tube = Tube();
  double time_s = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(tube.animation->At(time_s));
    time_s = time_s > 2.0 ? 0.0 : time_s + 0.04;
  }
}
BENCHMARK(EvaluateShape)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A frame of 640 × 480 pixels, a quarter of it with the body, in the sun.
void ComposeFrame(benchmark::State& state) {
  const bool moves = state.range(0) != 0;
  AnimatedModel tube = Tube();
  PlacedModel body;
  body.model = std::make_shared<const Model>(std::move(tube.model));
  if (moves) body.playback = {tube.animation, 0.0, true};
  const std::vector<PlacedModel> scene{testing::Phantom(testing::Ground(4.0, {0.3F, 0.3F, 0.3F})),
                                       body};
  const testing::UniformDay day({3000, 4000, 6000}, {60e3, 55e3, 45e3}, {0.3, -0.5, 0.8});
  const CameraModel camera{
      .width = 640, .height = 480, .fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 32}).value();
  const auto composer = Composer::Create(camera, scene, {}).value();
  if (!composer->SetLight(solver->Solve(day, Mat3{}), day, Mat3{}, {1, 1, 1})) return;
  composer->AssumeUnmodelledShadows(false);
  // From the front, 80 cm away.
  const Transform<Camera, Marker> pose{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {0.0, 0.3, 0.8}};
  RgbImage picture(camera.width, camera.height, 3);
  std::fill_n(picture.data(), picture.size(), std::uint8_t{150});
  double time_s = 0.0;
  const auto frame = [&] {
    if (moves) composer->SetShape(1, tube.animation->At(time_s));
    time_s = time_s > 2.0 ? 0.0 : time_s + 0.04;
    benchmark::DoNotOptimize(composer->Compose(picture.view(), pose, {2e-5, 2e-5, 2e-5}).value());
  };
  frame();
  for (auto _ : state) frame();
}
BENCHMARK(ComposeFrame)
    ->ArgName("moves")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace pleinair::compositor
