// Measures how long a new light blocks the drawing thread, with a torus of a million triangles.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "compositor/composer.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

std::shared_ptr<Model> Torus() {
  constexpr std::uint32_t kAround = 1000, kAcross = 500;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    for (std::uint32_t k = 0; k < kAcross; ++k) {
      const double a = 2 * std::numbers::pi * i / kAround, b = 2 * std::numbers::pi * k / kAcross;
      const double radius = 0.5 + 0.2 * std::cos(b);
      const auto f = [](double value) { return static_cast<float>(value); };
      mesh.positions.push_back(
          {f(radius * std::cos(a)), f(radius * std::sin(a)), f(0.3 + 0.2 * std::sin(b))});
      mesh.normals.push_back(
          {f(std::cos(b) * std::cos(a)), f(std::cos(b) * std::sin(a)), f(std::sin(b))});
      const std::uint32_t right = (i + 1) % kAround, above = (k + 1) % kAcross;
      const std::uint32_t corners[] = {i * kAcross + k, right * kAcross + k,
                                       right * kAcross + above, i * kAcross + above};
      for (const int c : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(corners[c]);
    }
  }
  return testing::ModelOf(std::move(mesh), {0.5F, 0.5F, 0.5F});
}

/// `surfaces`: number of sets of surfaces that alternate; with one, only the light changes.
void SetLight(benchmark::State& state) {
  const testing::UniformDay day({3000, 4000, 6000}, {60e3, 55e3, 45e3}, {0.3, -0.5, 0.8});
  const CameraModel camera{.width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
  const std::vector<PlacedModel> scene{testing::Phantom(testing::Ground(4.0, {0.3F, 0.3F, 0.3F})),
                                       testing::Object(Torus())};
  std::vector<std::vector<LitMesh>> lights;
  lights.reserve(static_cast<std::size_t>(state.range(0)));
  for (int i = 0; i < state.range(0); ++i) {
    lights.push_back(
        LightSolver::Create(scene, {.rays_per_vertex = 16}).value()->Solve(day, Mat3{}));
  }
  const auto composer = Composer::Create(camera, scene, {});
  std::size_t next = 0;
  while (state.KeepRunning()) {
    if (!(*composer)->SetLight(lights[next++ % lights.size()], day, Mat3{}, {1, 1, 1})) {
      state.SkipWithError("no light");
      break;
    }
    glFinish();
  }
}
BENCHMARK(SetLight)->ArgName("surfaces")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pleinair::compositor
