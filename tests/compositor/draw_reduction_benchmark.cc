// Measures the time that each of the composer's reductions saves, on the bundled courtyard.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/camera_model.h"
#include "compositor/picture/camera_look.h"
#include "tests/compositor/courtyard_frame.h"

namespace pleinair::compositor {
namespace {

struct Size {
  int width = 640, height = 480;
  bool has_look = false;  // Blur and noise of a phone's film.
};

/// The courtyard's camera with pixels that are so much finer that the image has `size`.
CameraModel CameraOf(const CameraModel& camera, const Size& size) {
  const double scale = static_cast<double>(size.width) / camera.width;
  CameraModel finer = camera;
  finer.width = size.width;
  finer.height = size.height;
  finer.fx *= scale;
  finer.fy *= scale;
  finer.cx = (size.width - 1) / 2.0;
  finer.cy = (size.height - 1) / 2.0;
  return finer;
}

RgbImage Enlarged(const RgbImage& picture, const Size& size) {
  RgbImage large(size.width, size.height, 3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        large(x, y, c) =
            picture(x * picture.width() / size.width, y * picture.height() / size.height, c);
      }
    }
  }
  return large;
}

/// Composes the recording's frames in turn, all with the image of one frame, so that decoding costs
/// nothing.
void Compose(benchmark::State& state, const DrawReductions& reductions, const Size& size) {
  static const testing::Courtyard courtyard;
  const RgbImage picture = Enlarged(courtyard.Picture(), size);
  const auto composer =
      courtyard.MakeComposer({.reductions = reductions}, CameraOf(courtyard.camera(), size));
  if (size.has_look) {
    const CameraLook look{
        .blur_px = 0.6, .noise_constant = {1e-5, 1e-5, 1e-5}, .noise_slope = {3e-4, 3e-4, 3e-4}};
    if (!composer->SetCameraLook(look)) state.SkipWithError("no look");
  }
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
      {"without_affected_tiles", Without(&DrawReductions::affected_tiles)},
      {"none", DrawReductions::None()}};
  const auto add = [](const std::string& name, const DrawReductions& reductions, Size size,
                      int frames) {
    benchmark::RegisterBenchmark(
        name.c_str(),
        [reductions, size](benchmark::State& state) { Compose(state, reductions, size); })
        ->MeasureProcessCPUTime()
        ->Iterations(frames)
        ->Unit(benchmark::kMillisecond);
  };
  for (const auto& [name, reductions] : sets) add("Compose/" + name, reductions, {}, 30);
  const DrawReductions finely = Without(&DrawReductions::coarse_sky_ratio);
  for (const Size& size : {Size{640, 480}, Size{1280, 960}, Size{1920, 1080}}) {
    for (const bool has_look : {false, true}) {
      const Size with{size.width, size.height, has_look};
      const std::string name = "Size/" + std::to_string(size.width) + "x" +
                               std::to_string(size.height) + (has_look ? "/look" : "/clean");
      add(name + "/all", {}, with, 10);
      add(name + "/without_coarse_sky_ratio", finely, with, 10);
    }
  }
  return true;
}();

}  // namespace
}  // namespace pleinair::compositor
