// Measures the time that each of the composer's reductions saves, on the bundled courtyard.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tests/compositor/courtyard_frame.h"

namespace pleinair::compositor {
namespace {

/// Composes the recording's frames in turn, all with the image of one frame, so that decoding costs
/// nothing.
void Compose(benchmark::State& state, const DrawReductions& reductions) {
  static const testing::Courtyard courtyard;
  static const RgbImage picture = courtyard.Picture();
  const auto composer = courtyard.MakeComposer({.reductions = reductions});
  const auto& poses = courtyard.poses();
  const auto draw = [&](std::size_t frame) {
    return composer->Compose(picture.view(), poses[frame % poses.size()], courtyard.ExposureScale())
        .has_value();
  };
  std::size_t frame = 0;
  draw(frame);  // The first frame compiles shaders and draws maps.
  for (auto _ : state) {
    if (!draw(++frame)) state.SkipWithError("not composed");
  }
}

DrawReductions Without(bool DrawReductions::*reduction) {
  DrawReductions others;
  others.*reduction = false;
  return others;
}

const bool kRegistered = [] {
  const std::vector<std::pair<std::string, DrawReductions>> sets{
      {"all", {}},
      {"without_affected_triangles", Without(&DrawReductions::affected_triangles)},
      {"without_sun_footprint", Without(&DrawReductions::sun_footprint)},
      {"without_sun_visibility", Without(&DrawReductions::sun_visibility)},
      {"without_linear_shadow_ratio", Without(&DrawReductions::linear_shadow_ratio)},
      {"without_sun_facing_triangles", Without(&DrawReductions::sun_facing_triangles)},
      {"none", DrawReductions::None()}};
  for (const auto& [name, reductions] : sets) {
    benchmark::RegisterBenchmark(
        ("Compose/" + name).c_str(),
        [reductions = reductions](benchmark::State& state) { Compose(state, reductions); })
        ->MeasureProcessCPUTime()
        ->Iterations(30)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace pleinair::compositor
