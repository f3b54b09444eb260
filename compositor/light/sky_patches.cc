#include "compositor/light/sky_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/check.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

constexpr std::array<int, 7> kPatchesOfBands{30, 30, 24, 24, 18, 12, 6};
constexpr double kBandHeight = std::numbers::pi / 15.0;  // 12°.
constexpr int kSamplesPerSide = 4;
constexpr double kHalfPi = std::numbers::pi / 2;

}  // namespace

SkyPatches::SkyPatches(Vec3 up, int division) : up_(up), division_(division) {
  CHECK_GE(division, 1);
  CHECK_GE(4, division);
  const TangentFrame frame(up);
  east_ = frame.tangent;
  north_ = frame.bitangent;
  for (std::size_t band = 0; band < kPatchesOfBands.size(); ++band) {
    for (int part = 0; part < division; ++part) {
      const double low =
          kBandHeight * (static_cast<double>(band) + static_cast<double>(part) / division);
      bands_.push_back(
          {low, low + kBandHeight / division, count_, kPatchesOfBands[band] * division});
      count_ += bands_.back().patches;
    }
  }
  bands_.push_back({7 * kBandHeight, kHalfPi, count_, 1});
  ++count_;
}

std::pair<double, double> SkyPatches::Angles(Vec3 direction) const {
  const double elevation = std::asin(std::clamp(Dot(direction, up_), -1.0, 1.0));
  const double turn =
      std::atan2(Dot(direction, east_), Dot(direction, north_)) / (2 * std::numbers::pi);
  return {elevation, turn < 0.0 ? turn + 1.0 : turn};
}

Vec3 SkyPatches::Direction(double elevation, double turn) const {
  const double phi = 2 * std::numbers::pi * turn, c = std::cos(elevation);
  return up_ * std::sin(elevation) + (east_ * std::sin(phi) + north_ * std::cos(phi)) * c;
}

int SkyPatches::BandAt(double elevation) const {
  const int band = static_cast<int>(elevation / (kBandHeight / division_));
  return std::clamp(band, 0, static_cast<int>(bands_.size()) - 1);
}

int SkyPatches::At(Vec3 direction) const {
  const auto [elevation, turn] = Angles(direction);
  if (elevation <= 0.0) return land();
  const Band& band = bands_[BandAt(elevation)];
  return band.first + std::min(static_cast<int>(turn * band.patches), band.patches - 1);
}

double SkyPatches::SolidAngle(int patch) const {
  for (const Band& band : bands_) {
    if (patch >= band.first + band.patches) continue;
    return 2 * std::numbers::pi * (std::sin(band.high) - std::sin(band.low)) / band.patches;
  }
  return 2 * std::numbers::pi;
}

Vec3 SkyPatches::Within(int patch, double across, double up) const {
  const auto band = std::prev(
      std::upper_bound(bands_.begin(), bands_.end(), patch,
                       [](int wanted, const Band& other) { return wanted < other.first; }));
  const double sine = std::lerp(std::sin(band->low), std::sin(band->high), up);
  return Direction(std::asin(sine), (patch - band->first + across) / band->patches);
}

std::vector<LinearRgb> SkyPatches::Radiances(const sky::SkyModel& day,
                                             const Mat3& marker_from_world,
                                             double land_albedo) const {
  const Mat3 world_from_marker = marker_from_world.Transposed();
  std::vector<LinearRgb> radiances;
  radiances.reserve(total());
  for (const Band& band : bands_) {
    for (int patch = 0; patch < band.patches; ++patch) {
      LinearRgb sum;
      for (int i = 0; i < kSamplesPerSide; ++i) {
        // Steps of equal solid angle.
        const double sine =
            std::lerp(std::sin(band.low), std::sin(band.high), (i + 0.5) / kSamplesPerSide);
        for (int j = 0; j < kSamplesPerSide; ++j) {
          const double turn = (patch + (j + 0.5) / kSamplesPerSide) / band.patches;
          sum = sum + day.SkyRadiance({world_from_marker * Direction(std::asin(sine), turn)});
        }
      }
      radiances.push_back(sum * (1.0 / (kSamplesPerSide * kSamplesPerSide)));
    }
  }
  const LinearRgb level =
      day.SkyHorizontalIrradiance() + day.SunNormalIrradiance() * std::max(0.0, day.ToSun().xyz.z);
  radiances.push_back(level * (land_albedo / std::numbers::pi));
  return radiances;
}

std::vector<LinearRgb> SkyPatches::Sun(const sky::SkyModel& day,
                                       const Mat3& marker_from_world) const {
  std::vector<LinearRgb> sun(total());
  const LinearRgb irradiance = day.SunNormalIrradiance();
  if (Luminance(irradiance) <= 0.0) return sun;
  const auto [elevation, turn] = Angles(marker_from_world * day.ToSun().xyz);
  const auto middle = [&](int band) { return (bands_[band].low + bands_[band].high) / 2; };
  int band = BandAt(std::max(0.0, elevation));
  if (elevation < middle(band)) --band;
  const int last = static_cast<int>(bands_.size()) - 1;
  const int low = std::clamp(band, 0, last), high = std::min(std::max(band + 1, 0), last);
  const double above =
      low == high ? 0.0
                  : std::clamp((elevation - middle(low)) / (middle(high) - middle(low)), 0.0, 1.0);
  for (const auto& [index, weight] : {std::pair{low, 1 - above}, {high, above}}) {
    const Band& at = bands_[index];
    const double column = turn * at.patches - 0.5;
    const double floor = std::floor(column);
    for (const int side : {0, 1}) {
      const int patch = at.first + (static_cast<int>(floor) + side + at.patches) % at.patches;
      const double share = weight * (side == 0 ? 1 - (column - floor) : column - floor);
      sun[patch] = sun[patch] + irradiance * (share / SolidAngle(patch));
    }
  }
  return sun;
}

}  // namespace pleinair::compositor
