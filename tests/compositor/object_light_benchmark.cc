// Compares composed models with path-traced ones on a terrace, in sun, shade and under an overcast
// sky:
//
//     object_light_benchmark [--flat] [--up-z] [--sphere LEVEL…] FILE…
//
// Models are scaled to 22 cm. A sphere has 20 · 4^LEVEL faces. Without files and spheres, it
// compares the hard shapes of the tests. Each line
// has the object's pixels; the share with a CIE76 difference above 8; the mean difference; the most
// connected pixels below half of the true light; the brightness relative to the true one; the time
// in which the light is prepared, in seconds.
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/compositor/light/shapes.h"
#include "tests/compositor/light/terrace.h"

namespace pleinair::compositor {
namespace {

using testing::Float3;
using testing::NamedModel;
using testing::Terrace;
using testing::Weather;

constexpr double kSize_m = 0.22;
constexpr int kStrata = 6;

/// Scales the model and stands it on the ground at the origin.
std::shared_ptr<const Model> Standing(Model model, bool up_z) {
  constexpr float kFar = std::numeric_limits<float>::max();
  Float3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (Mesh& mesh : model.meshes) {
    for (auto* vectors : {&mesh.positions, &mesh.normals}) {
      for (Float3& v : *vectors) {
        if (!up_z) v = {v[0], -v[2], v[1]};
      }
    }
    for (const Float3& p : mesh.positions) {
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    }
  }
  const float extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const float scale = static_cast<float>(kSize_m) / extent;
  for (Mesh& mesh : model.meshes) {
    for (Float3& p : mesh.positions) {
      p = {(p[0] - 0.5F * (low[0] + high[0])) * scale, (p[1] - 0.5F * (low[1] + high[1])) * scale,
           (p[2] - low[2]) * scale + 0.001F};
    }
  }
  if (model.materials.empty()) model.materials.push_back({});
  for (Material& material : model.materials) material.base_color = {0.55F, 0.5F, 0.45F};
  return std::make_shared<const Model>(std::move(model));
}

void Compare(const NamedModel& named) {
  const CameraModel camera = Terrace::Camera(480, 1.5);
  const auto start = std::chrono::steady_clock::now();
  const Terrace terrace({named.model}, {});
  const std::chrono::duration<double> time_s = std::chrono::steady_clock::now() - start;
  for (const auto& [weather, name] : {std::pair{Weather::kSun, "sun"},
                                      {Weather::kShade, "shade"},
                                      {Weather::kOvercast, "overcast"}}) {
    const testing::ObjectScore score =
        ScoreOf(0, terrace.Trace(weather, camera, 2, kStrata), terrace.Compose(weather, camera));
    std::printf(
        "%-20s %-8s %6d px  above 8: %5.2f %%  mean %.2f  dark %4d px  brightness %.3f  %.2f s\n",
        named.name.c_str(), name, score.pixels, 100.0 * score.far_off, score.mean,
        score.darkest_group, score.brightness, time_s.count());
    std::fflush(stdout);
  }
}

int Run(int count, char** arguments) {
  ModelOptions options{.normals = NormalsMode::kSmooth};
  bool up_z = false, any = false;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--flat") {
      options.normals = NormalsMode::kFlat;
    } else if (argument == "--up-z") {
      up_z = true;
    } else if (argument == "--sphere" && i + 1 < count) {
      const int level = std::atoi(arguments[++i]);
      const std::array shapes{testing::Icosphere(level).Placed({0.0, 0.0, 0.111}, 0.11)};
      Compare({std::to_string(20 << (2 * level)) + " faces",
               testing::ModelOf(shapes, options.normals)});
      any = true;
    } else {
      auto model = LoadModel(argument, options);
      if (!model) {
        std::fprintf(stderr, "%s\n", model.error().Message().c_str());
        return 2;
      }
      Compare({std::string(argument.substr(argument.rfind('/') + 1)),
               Standing(*std::move(model), up_z)});
      any = true;
    }
  }
  if (any) return 0;
  for (const NamedModel& shape : testing::HardShapes()) Compare(shape);
  return 0;
}

}  // namespace
}  // namespace pleinair::compositor

int main(int count, char** arguments) { return pleinair::compositor::Run(count, arguments); }
