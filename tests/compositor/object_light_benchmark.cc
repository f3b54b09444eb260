// Compares composed models with path-traced ones on a terrace, in sun, shade and overcast:
//
//     object_light_benchmark [--flat] [--up-z] [--sphere LEVEL] [--ring FACES] [--crown LEAVES]
//       [--leaves LEAVES] [--resolutions] FILE…
//
// Models are scaled to 22 cm. A sphere has 20 · 4^LEVEL faces. A ring is a torus. A crown has loose
// opaque leaves of two triangles; those of --leaves let light through, which the reference does not
// have. --resolutions compares rings of 500, 5,000 and 50,000 faces with one another. Without
// any, it compares the hard shapes of the tests.
//
// Each line has the object's pixels, the share with a CIE76 difference above 8, and the mean
// difference. Then the most connected pixels below half of the true light, and the brightness
// relative to the true one. Last the times in seconds: for preparing the geometry of the light, and
// for the light and a frame together.
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

constexpr std::array kLights{std::pair{Weather::kSun, "sun"}, std::pair{Weather::kShade, "shade"},
                             std::pair{Weather::kOvercast, "overcast"}};

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Compare(const NamedModel& named) {
  const CameraModel camera = Terrace::Camera(480, 1.5);
  const auto start = std::chrono::steady_clock::now();
  const Terrace terrace({named.model}, {});
  const double prepare_s = SecondsSince(start);
  for (const auto& [weather, name] : kLights) {
    const auto before = std::chrono::steady_clock::now();
    const RgbImage composed = terrace.Compose(weather, camera);
    const double frame_s = SecondsSince(before);
    const testing::ObjectScore score =
        ScoreOf(0, terrace.Trace(weather, camera, 2, kStrata), composed);
    std::printf(
        "%-20s %-8s %6d px  above 8: %5.2f %%  mean %.2f  dark %4d px  brightness %.3f  %.2f s"
        "  %.2f s\n",
        named.name.c_str(), name, score.pixels, 100.0 * score.far_off, score.mean,
        score.darkest_group, score.brightness, prepare_s, frame_s);
    std::fflush(stdout);
  }
}

std::shared_ptr<const Model> Ring(double faces, NormalsMode normals) {
  const std::array shapes{testing::Torus(faces).Placed({0.0, 0.0, 0.036}, 0.076)};
  return testing::ModelOf(shapes, normals);
}

std::shared_ptr<const Model> LeafyCrown(std::uint32_t leaves, bool translucent) {
  const std::array shapes{testing::Crown(leaves).Placed({0.0, 0.0, 0.111}, 0.105)};
  std::shared_ptr<Model> crown = testing::ModelOf(shapes, NormalsMode::kFlat);
  crown->materials[0].base_color = {0.09F, 0.2F, 0.05F};
  if (translucent) crown->materials[0].detail.transmission.color = {0.08F, 0.22F, 0.03F};
  return crown;
}

/// Compares images of the same ring of different numbers of faces.
void CompareResolutions() {
  const CameraModel camera = Terrace::Camera(480, 1.5);
  constexpr std::array kFaces{500, 5'000, 50'000};
  std::vector<Terrace> terraces;
  for (const int faces : kFaces) {
    terraces.emplace_back(std::vector{Ring(faces, NormalsMode::kSmooth)}, LightSolverOptions{});
  }
  for (const auto& [weather, name] : kLights) {
    std::vector<RgbImage> images;
    for (const Terrace& terrace : terraces) images.push_back(terrace.Compose(weather, camera));
    const testing::ObjectView view = terraces[0].Trace(weather, camera, 1, 1);
    for (std::size_t coarse = 0; coarse < kFaces.size(); ++coarse) {
      for (std::size_t fine = coarse + 1; fine < kFaces.size(); ++fine) {
        std::printf("rings of %d and %d faces, %s: mean difference %.2f\n", kFaces[coarse],
                    kFaces[fine], name, MeanDifference(view, images[coarse], images[fine]));
      }
    }
  }
}

int Run(int count, char** arguments) {
  ModelOptions options;
  options.normals = NormalsMode::kSmooth;
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
    } else if (argument == "--ring" && i + 1 < count) {
      const int faces = std::atoi(arguments[++i]);
      Compare({"ring of " + std::to_string(faces), Ring(faces, options.normals)});
      any = true;
    } else if ((argument == "--crown" || argument == "--leaves") && i + 1 < count) {
      const auto leaves = static_cast<std::uint32_t>(std::atoi(arguments[++i]));
      Compare({std::string(argument.substr(2)) + " of " + std::to_string(leaves),
               LeafyCrown(leaves, argument == "--leaves")});
      any = true;
    } else if (argument == "--resolutions") {
      CompareResolutions();
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
