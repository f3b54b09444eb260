#pragma once

// Virtual objects on a terrace, composed and compared with path-traced ones.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "base/srgb.h"
#include "compositor/composer.h"
#include "tests/compositor/light/light_scenes.h"
#include "tests/compositor/light/path_traced_objects.h"

namespace pleinair::compositor::testing {

/// A sky that is brighter towards the horizon and the sun.
class TerraceDay : public UniformDay {
 public:
  TerraceDay(LinearRgb sky, LinearRgb sun, Vec3 to_sun) : UniformDay(sky, sun, to_sun) {
    constexpr int kSteps = 256;
    for (int i = 0; i < kSteps; ++i) {
      for (int k = 0; k < kSteps; ++k) {
        const double u = (i + 0.5) / kSteps, v = 2.0 * std::numbers::pi * (k + 0.5) / kSteps;
        const double radius = std::sqrt(u);
        level_ = level_ +
                 SkyRadiance({{radius * std::cos(v), radius * std::sin(v), std::sqrt(1.0 - u)}}) *
                     (std::numbers::pi / (kSteps * kSteps));
      }
    }
  }
  LinearRgb SkyRadiance(Direction<World> from) const override {
    return UniformDay::SkyRadiance(from) *
           (1.5 - from.xyz.z + std::exp(8 * (Dot(from.xyz, ToSun().xyz) - 1)));
  }
  LinearRgb SkyHorizontalIrradiance() const override { return level_; }

 private:
  LinearRgb level_;
};

enum class Weather { kSun, kShade, kOvercast };

inline TerraceDay DayOf(Weather weather) {
  if (weather == Weather::kOvercast) return {{4000, 4200, 4500}, {}, {-0.5, -0.5, 0.75}};
  // In the shade the sun is behind the wall.
  const Vec3 to_sun = weather == Weather::kSun ? Vec3{-0.5, -0.5, 0.75} : Vec3{-0.3, 0.7, 0.68};
  return {{2500, 3500, 6000}, {70e3, 65e3, 55e3}, to_sun};
}

/// How much a composed object differs from the path-traced one, over pixels that it covers.
struct ObjectScore {
  int pixels = 0;
  double far_off = 0.0;     ///< Share of pixels with a CIE76 difference above 8.
  double mean = 0.0;        ///< Mean CIE76 difference.
  int darkest_group = 0;    ///< Most connected pixels below half of the true light.
  double brightness = 0.0;  ///< Composed over true light.
};

/// Pixels of every `step`th row and column. An object is seen where it covers the whole pixel.
struct ObjectView {
  struct Pixel {
    int object = -1;   ///< Index into the objects; −1: none.
    LinearRgb linear;  ///< Path-traced, linear as the camera stores it.
  };
  int step = 1, columns = 0;
  std::vector<Pixel> pixels;

  /// Linear light of an image at pixel `i` of `pixels`.
  LinearRgb At(const RgbImage& image, std::size_t i) const {
    const int x = static_cast<int>(i) % columns * step, y = static_cast<int>(i) / columns * step;
    const auto value = [&](int c) -> double { return LinearFromSrgb8()[image(x, y, c)]; };
    return {value(0), value(1), value(2)};
  }
};

using Lab = std::array<double, 3>;

/// CIELAB of linear Rec.709, white D65.
inline Lab LabOf(LinearRgb c) {
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  const double x = f((0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b) / 0.95047);
  const double y = f(0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b);
  const double z = f((0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

inline double Cie76(LinearRgb a, LinearRgb b) {
  const Lab p = LabOf(a), q = LabOf(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Objects on a terrace, level ground before a wall, seen by a camera 90 cm away. Objects are
/// placed as they are.
class Terrace {
 public:
  Terrace(std::vector<std::shared_ptr<const Model>> objects, const LightSolverOptions& options)
      : objects_(std::move(objects)) {
    scene_ = {Phantom(ground_), Phantom(wall_)};
    for (const auto& object : objects_) scene_.push_back(Object(object));
    solver_ = MakeSolver(scene_, options);
  }

  static CameraModel Camera(int width, double focal_widths) {
    const double focal = focal_widths * width;
    return {.width = width,
            .height = width * 3 / 4,
            .fx = focal,
            .fy = focal,
            .cx = 0.5 * (width - 1),
            .cy = 0.5 * (width * 3 / 4 - 1)};
  }

  /// Composes the objects by the program's way into an even grey image.
  RgbImage Compose(Weather weather, const CameraModel& camera) const {
    const TerraceDay day = DayOf(weather);
    const auto composer = Composer::Create(camera, scene_, {});
    EXPECT_TRUE(composer) << composer.error().Message();
    (*composer)->AssumeUnmodelledShadows(false);
    EXPECT_TRUE((*composer)->SetLight(solver_->Solve(day, Mat3{}), day, Mat3{},
                                      solver_->RadianceFromBelow(day, Mat3{})));
    RgbImage grey(camera.width, camera.height, 3);
    std::fill_n(grey.data(), grey.size(), std::uint8_t{150});
    auto composed = (*composer)->Compose(grey.view(), CameraFromMarker(), ExposureOf(weather, day));
    EXPECT_TRUE(composed) << composed.error().Message();
    return *std::move(composed);
  }

  /// Traces `strata`² paths for each of a pixel's four samples.
  ObjectView Trace(Weather weather, const CameraModel& camera, int step, int strata) const;

 private:
  static constexpr Vec3 kEye{0.25, -0.75, 0.45}, kTarget{0.0, 0.0, 0.09};

  struct View {
    Vec3 forward = Normalized(kTarget - kEye);
    Vec3 right = Normalized(Cross(forward, Vec3{0.0, 0.0, 1.0}));
    Vec3 down = Cross(forward, right);
  };

  static Transform<pleinair::Camera, Marker> CameraFromMarker() {
    const auto [forward, right, down] = View{};
    const Mat3 rotation{
        {right.x, right.y, right.z, down.x, down.y, down.z, forward.x, forward.y, forward.z}};
    return {rotation, -(rotation * kEye)};
  }

  /// White ground is slightly overexposed; in the shade the camera opens up.
  static LinearRgb ExposureOf(Weather weather, const TerraceDay& day) {
    const LinearRgb level = day.SkyHorizontalIrradiance() +
                            day.SunNormalIrradiance() * std::max(0.0, day.ToSun().xyz.z);
    const double white = weather == Weather::kShade ? 3.0 : 1.1;
    return LinearRgb{1.0 / level.r, 1.0 / level.g, 1.0 / level.b} * (white * std::numbers::pi);
  }

  std::vector<std::shared_ptr<const Model>> objects_;
  std::shared_ptr<const Model> ground_ = Ground(2.0, {0.45F, 0.42F, 0.38F});
  std::shared_ptr<const Model> wall_ =
      BoxModel({-2.0, 0.6, -0.1}, {2.0, 0.8, 2.5}, {0.6F, 0.55F, 0.5F});
  std::vector<PlacedModel> scene_;
  std::unique_ptr<LightSolver> solver_;
};

/// The largest number of connected cells of a grid that are set.
inline int LargestGroup(std::vector<std::uint8_t> set, int width) {
  int largest = 0;
  const auto size = static_cast<int>(set.size());
  for (int first = 0; first < size; ++first) {
    std::vector<int> group;
    const auto add = [&](int cell) {
      if (cell < 0 || cell >= size || set[static_cast<std::size_t>(cell)] == 0) return;
      set[static_cast<std::size_t>(cell)] = 0;
      group.push_back(cell);
    };
    add(first);
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (const int beside : {-1, 1, -width, width}) add(group[i] + beside);
    }
    largest = std::max(largest, static_cast<int>(group.size()));
  }
  return largest;
}

inline ObjectView Terrace::Trace(Weather weather, const CameraModel& camera, int step,
                                 int strata) const {
  // Where a pixel is sampled, relative to its centre; as in triangle_id.frag.
  constexpr double kSamples[4][2] = {
      {-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};
  const View view_of_camera;
  const auto& forward = view_of_camera.forward;
  const auto& right = view_of_camera.right;
  const auto& down = view_of_camera.down;
  const TerraceDay day = DayOf(weather);
  const LinearRgb exposure = ExposureOf(weather, day);
  std::vector<const Model*> objects;
  for (const auto& object : objects_) objects.push_back(object.get());
  const PathTracedObjects truth({ground_.get(), wall_.get()}, objects, day);
  ObjectView view{step, camera.width / step, {}};
  view.pixels.resize(static_cast<std::size_t>(view.columns) * (camera.height / step));
  ParallelFor(view.pixels.size(), 0, [&](std::size_t i) {
    const int x = static_cast<int>(i) % view.columns * step;
    const int y = static_cast<int>(i) / view.columns * step;
    ObjectView::Pixel pixel;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const double u = (x + kSamples[k][0] - camera.cx) / camera.fx;
      const double v = (y + kSamples[k][1] - camera.cy) / camera.fy;
      const auto seen = truth.Along(kEye, Normalized(forward + right * u + down * v), strata,
                                    4 * static_cast<std::uint32_t>(i) + k);
      if (!seen || (k > 0 && seen->object != pixel.object)) return;
      pixel.object = seen->object;
      pixel.linear = pixel.linear + seen->radiance * exposure * 0.25;
    }
    const auto stored = [](double v) -> double { return LinearFromSrgb8()[Srgb8FromLinear(v)]; };
    pixel.linear = {stored(pixel.linear.r), stored(pixel.linear.g), stored(pixel.linear.b)};
    view.pixels[i] = pixel;
  });
  return view;
}

inline ObjectScore ScoreOf(int object, const ObjectView& view, const RgbImage& composed) {
  ObjectScore score;
  std::vector<std::uint8_t> dark(view.pixels.size());
  double composed_light = 0.0, true_light = 0.0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (view.pixels[i].object != object) continue;
    const LinearRgb truth = view.pixels[i].linear, seen = view.At(composed, i);
    const double difference = Cie76(seen, truth);
    ++score.pixels;
    score.mean += difference;
    score.far_off += difference > 8.0 ? 1.0 : 0.0;
    dark[i] = Luminance(seen) < 0.5 * Luminance(truth) ? 1 : 0;
    composed_light += Luminance(seen);
    true_light += Luminance(truth);
  }
  score.far_off /= score.pixels;
  score.mean /= score.pixels;
  score.brightness = composed_light / true_light;
  score.darkest_group = LargestGroup(std::move(dark), view.columns) * view.step * view.step;
  return score;
}

/// Mean CIE76 difference of two images over the pixels that objects cover.
inline double MeanDifference(const ObjectView& view, const RgbImage& a, const RgbImage& b) {
  double sum = 0.0;
  int pixels = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (view.pixels[i].object < 0) continue;
    sum += Cie76(view.At(a, i), view.At(b, i));
    ++pixels;
  }
  return sum / pixels;
}

}  // namespace pleinair::compositor::testing
