#include "sky/atmosphere/atmosphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sky/atmosphere/twilight.h"
#include "sky/sun/solar_disc.h"
#include "sky/sun/sun_direction.h"

namespace pleinair::sky {
namespace {

using std::numbers::pi;
constexpr double kGround = AirMedium::kGroundRadius;

// Darkest night sky: starlight and airglow, cd/m², the same in all directions. Horizontal
// illuminance 6.5e-4 lx (Seidelmann 1992, Table 8.2, sun at −18°).
constexpr float kNightLuminance = 2.06e-4F;

// Shells that a line of sight is cut at, metres: 1 + i^… from the eye to space.
constexpr int kShells = 44;
double ShellHeight(int i) {
  const double t = static_cast<double>(i) / kShells;
  return AirMedium::kEyeHeight + (AirMedium::kTopHeight - AirMedium::kEyeHeight) * t * t * t;
}

/// Mean over the sun's disc: rows of the part above the horizon, by Gauss quadrature with five
/// nodes.
Spectrum MeanOverDisc(const OpticalDepthTable& depths, double elevation, double radius) {
  static constexpr std::array<double, 5> kNodes = {-0.9061798459, -0.5384693101, 0.0, 0.5384693101,
                                                   0.9061798459};
  static constexpr std::array<double, 5> kWeights = {0.2369268851, 0.4786286705, 0.5688888889,
                                                     0.4786286705, 0.2369268851};
  const double bottom = std::max(elevation - radius, 0.0), top = elevation + radius;
  Spectrum sum{};
  if (top <= bottom) return sum;
  double whole = 0.0;
  for (int i = 0; i < 5; ++i) {
    const double row = 0.5 * (bottom + top) + 0.5 * (top - bottom) * kNodes[i];
    const double r = (row - elevation) / radius;
    const double chord = std::sqrt(std::max(0.0, 1.0 - r * r)) * kWeights[i];
    whole += chord;
    sum.AddScaled(Transmittance(depths.ToSpace(AirMedium::kEyeHeight, std::sin(row))),
                  static_cast<float>(chord));
  }
  return sum * static_cast<float>(DiscShareAboveHorizon(Radians(elevation)) / whole);
}

/// The spline through the bands may give about −1e-40 in place of zero.
std::array<float, 3> ToFloats(Vec3 v) {
  const auto positive = [](double x) { return static_cast<float>(std::max(x, 0.0)); };
  return {positive(v.x), positive(v.y), positive(v.z)};
}

}  // namespace

Vec3 SunXyz(const AtmosphereTables& tables, Direction<World> to_sun, double sun_distance_au) {
  const double elevation = std::asin(std::clamp(to_sun.xyz.z, -1.0, 1.0));
  const Spectrum passed =
      MeanOverDisc(tables.depths, elevation, kSolarRadiusAt1Au / sun_distance_au);
  return XyzOfSolarRatio(passed) * (1.0 / (sun_distance_au * sun_distance_au));
}

double AtmosphereSky::SoftenedElevation(double elevation, double sun_elevation) {
  const double b = 2.9 * kRadiansPerDegree + 0.54 * std::clamp(-sun_elevation, 0.0, 0.15);
  return elevation < b ? b * std::exp(elevation / b - 1.0) : elevation;
}

AtmosphereSky::AtmosphereSky(std::shared_ptr<const AtmosphereTables> tables,
                             Direction<World> to_sun, double sun_distance_au)
    : tables_(std::move(tables)),
      to_sun_(to_sun),
      closeness_(1.0 / (sun_distance_au * sun_distance_au)),
      nodes_(static_cast<std::size_t>(kRings) * kSectors) {
  for (int ring = 0; ring < kRings; ++ring) FillRing(ring);
}

void AtmosphereSky::FillRing(int ring) {
  const double t = static_cast<double>(ring) / (kRings - 1);
  const ComputedTwilight twilight =
      TwilightToCompute(std::asin(std::clamp(to_sun_.xyz.z, -1.0, 1.0)));
  const double sun = twilight.sun_elevation;
  const double light = closeness_ * twilight.share;
  const double view = SoftenedElevation(0.5 * pi * t * t, sun);
  const double view_up = std::sin(view), view_level = std::cos(view);
  const double sun_up = std::sin(sun), sun_level = std::cos(sun);
  const double eye = kGround + AirMedium::kEyeHeight;
  const AirMedium& medium = tables_->medium;

  struct Sums {
    Spectrum molecules, aerosol, scattered;
  };
  std::array<Sums, kSectors> sums{};
  std::array<double, kSectors> cosines{};  // Of the angle between view and sun.
  std::array<double, kSectors> turns{};    // Cosine of the azimuth from the sun's.
  for (int sector = 0; sector < kSectors; ++sector) {
    const double u = static_cast<double>(sector) / (kSectors - 1);
    turns[sector] = std::cos(pi * std::pow(u, 1.5));
    cosines[sector] = view_up * sun_up + view_level * sun_level * turns[sector];
  }

  Spectrum depth{};  // Optical depth from the eye.
  Spectrum through = Spectrum::Of(1.0F);
  double from_distance = 0.0;
  const auto distance_to = [&](double height) {
    const double radius = kGround + height;
    const double b = eye * view_up;
    return -b + std::sqrt(std::max(0.0, b * b + radius * radius - eye * eye));
  };
  for (int shell = 0; shell < kShells; ++shell) {
    const double to_distance = distance_to(ShellHeight(shell + 1));
    const double length = to_distance - from_distance;
    const double middle = 0.5 * (from_distance + to_distance);
    const double radius = std::sqrt(eye * eye + middle * middle + 2.0 * eye * view_up * middle);
    const double height = radius - kGround;
    from_distance = to_distance;

    const AirMedium::Densities d = medium.DensitiesAt(height);
    const Spectrum extinction = medium.Extinction(d);
    depth += extinction * static_cast<float>(length);
    const Spectrum after = Transmittance(depth);
    // ∫ e^−τ ds over the segment, for a homogeneous medium.
    const Spectrum weight = (through - after) / extinction;
    through = after;
    const Spectrum molecules = medium.molecules * d.molecules * weight;
    const Spectrum aerosol = medium.aerosol_scattering * d.aerosol * weight;

    // The view and sun directions relative to the vertical at the sample point.
    const double local_view_up = std::clamp((eye * view_up + middle) / radius, -1.0, 1.0);
    const double local_view_level = std::sqrt(1.0 - local_view_up * local_view_up);
    const double local_view_deg = std::asin(local_view_up) / kRadiansPerDegree;
    int kept_sun = -1;
    ScatteredLight::Source lower, upper;
    for (int sector = 0; sector < kSectors; ++sector) {
      const double local_sun_up =
          std::clamp((eye * sun_up + middle * cosines[sector]) / radius, -1.0, 1.0);
      const double local_sun_level = std::sqrt(1.0 - local_sun_up * local_sun_up);
      const double product = local_view_level * local_sun_level;
      const double turn =
          product > 1e-9
              ? std::clamp((cosines[sector] - local_view_up * local_sun_up) / product, -1.0, 1.0)
              : turns[sector];
      const ScatteredLight::Place place =
          ScatteredLight::PlaceOfSun(std::asin(local_sun_up) / kRadiansPerDegree);
      if (place.lower != kept_sun) {
        kept_sun = place.lower;
        lower = tables_->scattered.At(kept_sun, height, local_view_deg);
        upper = tables_->scattered.At(kept_sun + 1, height, local_view_deg);
      }
      const Spectrum sunlight = tables_->depths.SunTransmittance(height, local_sun_up);
      Sums& sum = sums[sector];
      sum.molecules += molecules * sunlight;
      sum.aerosol += aerosol * sunlight;
      Spectrum from_molecules{}, from_aerosol{};
      // cos(m φ) by Chebyshev's recurrence.
      double cosine = 1.0, previous = turn;
      for (int m = 0; m < ScatteredLight::kAerosolModes; ++m) {
        const auto high = static_cast<float>(cosine) * place.upper_share;
        const auto low = static_cast<float>(cosine) - high;
        from_aerosol.AddScaled(lower.aerosol[m], low);
        from_aerosol.AddScaled(upper.aerosol[m], high);
        if (m < ScatteredLight::kMoleculeModes) {
          from_molecules.AddScaled(lower.molecules[m], low);
          from_molecules.AddScaled(upper.molecules[m], high);
        }
        previous = std::exchange(cosine, 2.0 * turn * cosine - previous);
      }
      sum.scattered += molecules * from_molecules + aerosol * from_aerosol;
    }
  }

  const Vec3 night = XyzFromRgb({kNightLuminance, kNightLuminance, kNightLuminance});
  for (int sector = 0; sector < kSectors; ++sector) {
    Sums& sum = sums[sector];
    sum.scattered.AddScaled(sum.molecules, static_cast<float>(MoleculePhase(cosines[sector])));
    for (float& value : sum.scattered.v) value = std::max(value, 0.0F);
    Node& node = nodes_[static_cast<std::size_t>(ring) * kSectors + sector];
    node.scattered = ToFloats(XyzOfSolarRatio(sum.scattered) * light + night);
    node.aerosol = ToFloats(XyzOfSolarRatio(sum.aerosol) * light);
  }
}

Vec3 AtmosphereSky::Xyz(Direction<World> from) const {
  if (from.xyz.z < 0.0) return {};
  const double elevation = std::asin(std::min(from.xyz.z, 1.0));
  const double row = std::sqrt(elevation / (0.5 * pi)) * (kRings - 1);
  const Vec3 s = to_sun_.xyz, d = from.xyz;
  // The angle between the azimuths, 0…π.
  const double turn = std::fabs(std::atan2(d.x * s.y - d.y * s.x, d.x * s.x + d.y * s.y));
  const double column = std::cbrt((turn / pi) * (turn / pi)) * (kSectors - 1);
  const int r = std::min(static_cast<int>(row), kRings - 2);
  const int c = std::min(static_cast<int>(column), kSectors - 2);
  const double fr = row - r, fc = column - c;
  const double phase = AerosolPhase(tables_->medium.aerosol.asymmetry, Dot(s, d));
  const Node* node = &nodes_[static_cast<std::size_t>(r) * kSectors + c];
  const auto value = [&](int i) {
    const auto at = [&](const Node& n) { return n.scattered[i] + phase * n.aerosol[i]; };
    return std::lerp(std::lerp(at(node[0]), at(node[1]), fc),
                     std::lerp(at(node[kSectors]), at(node[kSectors + 1]), fc), fr);
  };
  return {value(0), value(1), value(2)};
}

}  // namespace pleinair::sky
