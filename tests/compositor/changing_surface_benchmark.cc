// Measures what a frame of a skinned body costs beyond that of the same body at rest.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
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

/// The body, 80 cm before a camera of 640 × 480 pixels; it fills a quarter of the image.
class BodyBeforeCamera {
 public:
  BodyBeforeCamera(bool moves, bool sunny) {
    AnimatedModel tube = Tube();
    PlacedModel body;
    body.model = std::make_shared<const Model>(std::move(tube.model));
    if (moves) body.playback = {tube.animation, 0.0, true};
    animation_ = body.playback.animation;
    const std::vector<PlacedModel> scene{testing::Phantom(testing::Ground(4.0, {0.3F, 0.3F, 0.3F})),
                                         body};
    const testing::UniformDay day(
        {3000, 4000, 6000}, sunny ? LinearRgb{60e3, 55e3, 45e3} : LinearRgb{}, {0.3, -0.5, 0.8});
    const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 32}).value();
    composer_ = Composer::Create(kCamera, scene, {}).value();
    if (!composer_->SetLight(solver->Solve(day, Mat3{}), day, Mat3{}, {1, 1, 1})) std::abort();
    composer_->AssumeUnmodelledShadows(false);
    std::fill_n(picture_.data(), picture_.size(), std::uint8_t{150});
  }

  void Compose() {
    NextShape();
    benchmark::DoNotOptimize(
        composer_->Compose(picture_.view(), kPose, {2e-5, 2e-5, 2e-5}).value());
  }
  /// Follows the shape without an image.
  void Follow() {
    NextShape();
    if (!composer_->SkipImage(kPose)) std::abort();
    glFinish();
  }

 private:
  static constexpr CameraModel kCamera{
      .width = 640, .height = 480, .fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};
  static constexpr Transform<Camera, Marker> kPose{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {0.0, 0.3, 0.8}};

  void NextShape() {
    if (animation_) composer_->SetShape(1, animation_->At(time_s_));
    time_s_ = time_s_ > 2.0 ? 0.0 : time_s_ + 0.04;
  }

  std::shared_ptr<const ModelAnimation> animation_;  // Null: it stands still.
  std::unique_ptr<Composer> composer_;
  RgbImage picture_{kCamera.width, kCamera.height, 3};
  double time_s_ = 0.0;
};

void ComposeFrame(benchmark::State& state) {
  BodyBeforeCamera body(state.range(0) != 0, true);
  body.Compose();
  for (auto _ : state) body.Compose();
}
BENCHMARK(ComposeFrame)
    ->ArgName("moves")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void FollowShape(benchmark::State& state) {
  BodyBeforeCamera body(true, state.range(0) != 0);
  body.Follow();
  for (auto _ : state) body.Follow();
}
BENCHMARK(FollowShape)
    ->ArgName("sun")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace pleinair::compositor
