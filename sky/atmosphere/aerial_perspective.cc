#include "sky/atmosphere/aerial_perspective.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sky/atmosphere/atmosphere.h"
#include "sky/atmosphere/twilight.h"
#include "sky/color.h"

namespace pleinair::sky {
namespace {

using std::numbers::pi;

/// Linear Rec.709, no channel negative.
std::array<float, 3> RgbOf(const Spectrum& ratio, double factor) {
  const Vec3 xyz = XyzOfSolarRatio(ratio) * factor;
  const LinearRgb c = ClipToGamut(RgbFromXyz(xyz.x, xyz.y, xyz.z));
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

/// Extinction of white light in each color channel, averaged over ten kilometres.
std::array<float, 3> ChannelExtinction(const Spectrum& extinction) {
  constexpr float kLength = 1e4F;
  const std::array<float, 3> before = RgbOf(Spectrum::Of(1.0F), 1.0);
  const std::array<float, 3> after = RgbOf(Transmittance(extinction * kLength), 1.0);
  std::array<float, 3> result{};
  for (int i = 0; i < 3; ++i)
    result[i] = -std::log(std::max(after[i] / before[i], 1e-30F)) / kLength;
  return result;
}

/// (1 − e^−x) / x.
double MeanThrough(double x) {
  return std::fabs(x) < 1e-2 ? 1.0 - x / 2.0 + x * x / 6.0 : (1.0 - std::exp(-x)) / x;
}

}  // namespace

AerialPerspective::AerialPerspective(const AtmosphereTables& tables, Direction<World> to_sun,
                                     double sun_distance_au)
    : nodes_(static_cast<std::size_t>(kRows) * kSectors) {
  static_assert(kRows == ScatteredLight::kViews, "one row an elevation of view");
  const AirMedium& medium = tables.medium;
  const ComputedTwilight twilight =
      TwilightToCompute(std::asin(std::clamp(to_sun.xyz.z, -1.0, 1.0)));
  const double closeness = twilight.share / (sun_distance_au * sun_distance_au);
  const double sun_up = std::sin(twilight.sun_elevation);
  const double sun_level = std::sqrt(1.0 - sun_up * sun_up);
  const Spectrum sunlight = tables.depths.SunTransmittance(AirMedium::kEyeHeight, sun_up);
  const auto place = ScatteredLight::PlaceOfSun(twilight.sun_elevation / kRadiansPerDegree);
  for (int row = 0; row < kRows; ++row) {
    const double view_deg = -90.0 + 180.0 * row / (kRows - 1);
    const double view_up = std::sin(view_deg * kRadiansPerDegree);
    const double view_level = std::cos(view_deg * kRadiansPerDegree);
    ScatteredLight::Source source{};
    source.AddScaled(tables.scattered.At(place.lower, AirMedium::kEyeHeight, view_deg),
                     1.0F - place.upper_share);
    source.AddScaled(tables.scattered.At(place.lower + 1, AirMedium::kEyeHeight, view_deg),
                     place.upper_share);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double turn = pi * std::pow(static_cast<double>(sector) / (kSectors - 1), 1.5);
      Spectrum molecules =
          sunlight * static_cast<float>(
                         MoleculePhase(view_up * sun_up + view_level * sun_level * std::cos(turn)));
      Spectrum aerosol{};
      for (int m = 0; m < ScatteredLight::kAerosolModes; ++m) {
        const auto cosine = static_cast<float>(std::cos(m * turn));
        aerosol.AddScaled(source.aerosol[m], cosine);
        if (m < ScatteredLight::kMoleculeModes) molecules.AddScaled(source.molecules[m], cosine);
      }
      Node& node = nodes_[static_cast<std::size_t>(row) * kSectors + sector];
      node.molecules = RgbOf(molecules * medium.molecules, closeness);
      node.aerosol = RgbOf(aerosol * medium.aerosol_scattering, closeness);
    }
  }
  constants_.sun_on_aerosol = RgbOf(sunlight * medium.aerosol_scattering, closeness);
  constants_.molecule_extinction = ChannelExtinction(medium.molecules);
  constants_.aerosol_extinction = ChannelExtinction(medium.aerosol_extinction);
  constants_.aerosol_scale_height = static_cast<float>(medium.aerosol.scale_height_m);
  constants_.asymmetry = static_cast<float>(medium.aerosol.asymmetry);
  constants_.to_sun = {static_cast<float>(to_sun.xyz.x), static_cast<float>(to_sun.xyz.y),
                       static_cast<float>(to_sun.xyz.z)};
}

AerialPerspective::Columns AerialPerspective::ColumnsTo(Direction<World> towards,
                                                        Metres distance) const {
  // Density e^(−(h + s sin e) / scale) along the ray; downwards at most the density at the ground.
  const double d = std::max(0.0, distance.value());
  const auto column = [&](double scale) {
    return d * MeanThrough(std::max(0.0, towards.xyz.z * d / scale));
  };
  return {column(AirMedium::kMoleculeScaleHeight), column(constants_.aerosol_scale_height)};
}

std::array<double, 3> AerialPerspective::OpticalDepth(const Columns& columns) const {
  std::array<double, 3> depth{};
  for (int i = 0; i < 3; ++i) {
    depth[i] = constants_.molecule_extinction[i] * columns.molecules +
               constants_.aerosol_extinction[i] * columns.aerosol;
  }
  return depth;
}

LinearRgb AerialPerspective::Transmittance(Direction<World> towards, Metres distance) const {
  const std::array<double, 3> depth = OpticalDepth(ColumnsTo(towards, distance));
  return {std::exp(-depth[0]), std::exp(-depth[1]), std::exp(-depth[2])};
}

LinearRgb AerialPerspective::Inscattered(Direction<World> towards, Metres distance) const {
  const Columns columns = ColumnsTo(towards, distance);
  const std::array<double, 3> depth = OpticalDepth(columns);
  const Vec3 d = towards.xyz;
  const Vec3 s{constants_.to_sun[0], constants_.to_sun[1], constants_.to_sun[2]};
  const double elevation = std::atan2(d.z, std::hypot(d.x, d.y));
  const double row = (elevation / pi + 0.5) * (kRows - 1);
  const double turn = std::fabs(std::atan2(d.x * s.y - d.y * s.x, d.x * s.x + d.y * s.y));
  const double column = std::cbrt((turn / pi) * (turn / pi)) * (kSectors - 1);
  const int r = std::clamp(static_cast<int>(row), 0, kRows - 2);
  const int c = std::clamp(static_cast<int>(column), 0, kSectors - 2);
  const double fr = row - r, fc = column - c;
  const double phase = AerosolPhase(constants_.asymmetry, Dot(s, d));
  const Node* node = &nodes_[static_cast<std::size_t>(r) * kSectors + c];
  const auto blend = [&](std::array<float, 3> Node::*member, int i) {
    return std::lerp(
        std::lerp<double>((node[0].*member)[i], (node[1].*member)[i], fc),
        std::lerp<double>((node[kSectors].*member)[i], (node[kSectors + 1].*member)[i], fc), fr);
  };
  const auto channel = [&](int i) {
    const double added =
        blend(&Node::molecules, i) * columns.molecules +
        (blend(&Node::aerosol, i) + phase * constants_.sun_on_aerosol[i]) * columns.aerosol;
    return added * MeanThrough(depth[i]);
  };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace pleinair::sky
