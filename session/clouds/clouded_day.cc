#include "session/clouds/clouded_day.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/parallel_for.h"
#include "base/units.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/light/sky_table.h"

namespace pleinair::session {
namespace {

// Nodes per side of the map.
constexpr int kSide = 225;
constexpr double kAureole = 6.0 * kRadiansPerDegree;
// The solver's rays are a few degrees apart: a narrower lobe would fall on some surfaces only.
constexpr double kLobe = 60.0 * kRadiansPerDegree;
constexpr double kLowestRise = 1e-4;  // The border is the horizon.

/// A scaled sky that owns its model.
class OwnedScaledSky : public compositor::ScaledSky {
 public:
  OwnedScaledSky(std::unique_ptr<sky::SkyModel> model, LinearRgb scale)
      : ScaledSky(*model, scale, {1.0, 1.0, 1.0}), owned_(std::move(model)) {}

 private:
  std::unique_ptr<sky::SkyModel> owned_;
};

/// Directions around the sun.
class SunRings {
 public:
  explicit SunRings(Vec3 sun)
      : sun_(sun),
        across_(sun.z < 0.999 ? Normalized(Cross(sun, {0.0, 0.0, 1.0})) : Vec3{1.0, 0.0, 0.0}),
        upwards_(Cross(across_, sun)) {}

  Vec3 At(double angle, double about) const {
    return sun_ * std::cos(angle) + across_ * (std::sin(angle) * std::cos(about)) +
           upwards_ * (std::sin(angle) * std::sin(about));
  }

  /// Integral of radiance, up to an angle, over the cosine from the vertical.
  template <typename Radiance>
  LinearRgb Integrate(double most, const Radiance& radiance) const {
    constexpr int kRings = 32, kSectors = 32;
    LinearRgb sum;
    for (int ring = 0; ring < kRings; ++ring) {
      // Narrow rings near the sun.
      const double x = (ring + 0.5) / kRings, angle = most * x * x;
      const double solid = std::sin(angle) * 2.0 * most * x / kRings * kTurn / kSectors;
      for (int sector = 0; sector < kSectors; ++sector) {
        const Vec3 from = At(angle, kTurn * (sector + 0.5) / kSectors);
        if (from.z > 0.0) sum = sum + radiance(from) * (solid * from.z);
      }
    }
    return sum;
  }

  static constexpr double kTurn = 2.0 * std::numbers::pi;

 private:
  Vec3 sun_, across_, upwards_;
};

/// 1 at the sun, 0 with a level slope from an angle on.
double LobeAt(double cosine, double width) {
  const double r = std::acos(std::clamp(cosine, -1.0, 1.0)) / width;
  return r < 1.0 ? (1.0 - r * r) * (1.0 - r * r) : 0.0;
}

/// Direction of a node of the map.
Vec3 DirectionOfNode(std::size_t row, std::size_t column) {
  const double s = 2.0 * static_cast<double>(column) / (kSide - 1) - 1.0;
  const double t = 2.0 * static_cast<double>(row) / (kSide - 1) - 1.0;
  const double x = 0.5 * (s + t), y = 0.5 * (s - t);
  return Normalized({x, y, std::max(kLowestRise, 1.0 - std::fabs(x) - std::fabs(y))});
}

}  // namespace

std::unique_ptr<sky::SkyModel> WithScaledSky(std::unique_ptr<sky::SkyModel> clear,
                                             LinearRgb scale) {
  return std::make_unique<OwnedScaledSky>(std::move(clear), scale);
}

MirroredClouds::MirroredClouds(const sky::SkyModel& light, CloudedDay clouds)
    : light_(light), clouds_(std::move(clouds)) {
  const LinearRgb none{1e-9, 1e-9, 1e-9};
  scale_ = (light.SkyHorizontalIrradiance() + none) / (clouds_.SkyHorizontalIrradiance() + none);
}

CloudedDay::CloudedDay(std::unique_ptr<sky::SkyModel> clear, LinearRgb sky_scale,
                       clouds::CloudFields fields, double seconds)
    : sun_(clear->SunNormalIrradiance()),
      clouds_(std::make_unique<clouds::CloudSky>(WithScaledSky(std::move(clear), sky_scale),
                                                 std::move(fields), compositor::kLandAlbedo,
                                                 seconds)) {
  Tabulate();
  SpreadAureole();
  horizontal_ = IntegrateTable();
  const double sun = Luminance(sun_) * std::max(0.0, clouds_->ToSun().xyz.z);
  const double clear_sky = Luminance(clouds_->clear().SkyHorizontalIrradiance());
  if (sun + clear_sky > 0.0) share_in_air_ = (sun + Luminance(horizontal_)) / (sun + clear_sky);
}

sky::SkyModel::AirBetween CloudedDay::AirTo(Direction<World> towards, Metres distance) const {
  AirBetween air = clouds_->clear().AirTo(towards, distance);
  air.inscattered = air.inscattered * share_in_air_;
  return air;
}

// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors",
// hemi-oct, as compositor/light/sky_table.h.
void CloudedDay::Tabulate() {
  nodes_.resize(static_cast<std::size_t>(kSide) * kSide);
  ParallelFor(kSide, 0, [&](std::size_t row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      nodes_[row * kSide + column] = clouds_->SkyRadiance({DirectionOfNode(row, column)});
    }
  });
}

// Within kAureole of the sun, the map takes the mean around it. A wide lobe adds what is missing of
// the light there.
void CloudedDay::SpreadAureole() {
  const Vec3 sun = clouds_->ToSun().xyz;
  if (sun.z <= 0.0) return;
  const SunRings rings(sun);
  constexpr int kEdge = 64;
  LinearRgb edge;
  for (int i = 0; i < kEdge; ++i) {
    edge = edge + CloudedDay::SkyRadiance({rings.At(kAureole, SunRings::kTurn * i / kEdge)}) *
                      (1.0 / kEdge);
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double within = LobeAt(Dot(DirectionOfNode(i / kSide, i % kSide), sun), kAureole);
    nodes_[i] = nodes_[i] * (1.0 - within) + edge * within;
  }
  const auto exact = [this](Vec3 from) { return clouds_->SkyRadiance({from}); };
  const auto smooth = [this](Vec3 from) { return CloudedDay::SkyRadiance({from}); };
  const auto lobe = [&sun](Vec3 from) {
    return LinearRgb{1.0, 1.0, 1.0} * LobeAt(Dot(from, sun), kLobe);
  };
  const LinearRgb missing =
      rings.Integrate(kAureole, exact) + rings.Integrate(kAureole, smooth) * -1.0;
  aureole_ = missing / rings.Integrate(kLobe, lobe);
}

LinearRgb CloudedDay::SkyRadiance(Direction<World> from) const {
  const Vec3 d = from.xyz;
  if (d.z < 0.0) return {};
  const double scale = 1.0 / (std::fabs(d.x) + std::fabs(d.y) + d.z);
  const double x = d.x * scale, y = d.y * scale;
  const double column = std::clamp(0.5 * (x + y + 1.0), 0.0, 1.0) * (kSide - 1);
  const double row = std::clamp(0.5 * (x - y + 1.0), 0.0, 1.0) * (kSide - 1);
  const int c = std::min(static_cast<int>(column), kSide - 2);
  const int r = std::min(static_cast<int>(row), kSide - 2);
  const double u = column - c, v = row - r;
  const LinearRgb* node = &nodes_[static_cast<std::size_t>(r) * kSide + c];
  const LinearRgb smooth = (node[0] * (1.0 - u) + node[1] * u) * (1.0 - v) +
                           (node[kSide] * (1.0 - u) + node[kSide + 1] * u) * v;
  const LinearRgb with = smooth + aureole_ * LobeAt(Dot(d, clouds_->ToSun().xyz), kLobe);
  return {std::max(0.0, with.r), std::max(0.0, with.g), std::max(0.0, with.b)};
}

LinearRgb CloudedDay::IntegrateTable() const {
  constexpr int kRings = 256, kSectors = 512;
  LinearRgb sum;
  for (int ring = 0; ring < kRings; ++ring) {
    // Rings of equal projected solid angle.
    const double level = std::sqrt((ring + 0.5) / kRings), up = std::sqrt(1.0 - level * level);
    LinearRgb of_ring;
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * std::numbers::pi * (sector + 0.5) / kSectors;
      of_ring = of_ring + CloudedDay::SkyRadiance(
                              {{level * std::sin(azimuth), level * std::cos(azimuth), up}});
    }
    sum = sum + of_ring;
  }
  return sum * (std::numbers::pi / (kRings * kSectors));
}

}  // namespace pleinair::session
