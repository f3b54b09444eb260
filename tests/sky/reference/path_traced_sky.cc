#include "tests/sky/reference/path_traced_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/units.h"
#include "sky/atmosphere/air_medium.h"
#include "sky/cie_observer.h"

namespace pleinair::sky::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGround = AirMedium::kGroundRadius;
constexpr int kShells = 400;
constexpr double kInfinity = 1e300;

/// Distance along a ray to a sphere about the origin: from inside the exit, from outside the first
/// hit. kInfinity if there is none.
double ToSphere(Vec3 position, Vec3 direction, double radius) {
  const double along = Dot(position, direction);
  const double discriminant = along * along - Dot(position, position) + radius * radius;
  if (discriminant < 0.0) return kInfinity;
  const double root = std::sqrt(discriminant);
  if (-along - root > 0.0) return -along - root;
  return -along + root > 0.0 ? -along + root : kInfinity;
}

/// A direction at polar angle acos(`c`) and azimuth `phi` about `axis`.
Vec3 About(Vec3 axis, double c, double phi) {
  const Vec3 helper = std::fabs(axis.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = Normalized(Cross(helper, axis));
  const Vec3 v = Cross(axis, u);
  const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
  return Normalized(u * (s * std::cos(phi)) + v * (s * std::sin(phi)) + axis * c);
}

/// Cosine distributed by the molecules' phase function; Frisvad 2011, "Importance sampling the
/// Rayleigh phase function", Eq. (15).
double SampleMolecules(double u) {
  const double q = 2.0 * (2.0 * u - 1.0);
  const double w = std::cbrt(-q + std::sqrt(1.0 + q * q));
  return 1.0 / w - w;
}

/// The same for the Henyey & Greenstein function.
double SampleAerosol(double g, double u) {
  if (std::fabs(g) < 1e-3) return 2.0 * u - 1.0;
  const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
  return (1.0 + g * g - s * s) / (2.0 * g);
}

const ObserverBand& ObserverAt(double wavelength_nm) {
  return kCie1931[static_cast<std::size_t>(
      std::lround((wavelength_nm - kCie1931[0].wavelength_nm) / kObserverStepNm))];
}

}  // namespace

struct PathTracedSky::Walk {
  std::mt19937_64 random;
  double Next() { return static_cast<double>(random() >> 11U) * 0x1p-53; }
};

PathTracedSky::PathTracedSky(const Scene& scene) : scene_(scene) {
  const double sun = scene.sun_elevation_deg * kRadiansPerDegree;
  to_sun_ = {std::cos(sun), 0.0, std::sin(sun)};
  const auto mean_exponential = [](double low, double high, double scale) {
    return scale * (std::exp(-low / scale) - std::exp(-high / scale)) / (high - low);
  };
  for (int i = 0; i < kShells; ++i) {
    // Thin shells near the ground, where the haze is: 100 km t².
    const auto height = [](int n) {
      const double t = static_cast<double>(n) / kShells;
      return AirMedium::kTopHeight * t * t;
    };
    const double low = height(i), high = height(i + 1);
    shells_.push_back({kGround + high, mean_exponential(low, high, AirMedium::kMoleculeScaleHeight),
                       mean_exponential(low, high, scene.aerosol.scale_height_m),
                       OzoneDensity(0.5 * (low + high))});
  }
  for (int i = 0; i < kWavelengths; ++i) {
    const double extinction = AerosolExtinction(scene.aerosol, Wavelength(i));
    coefficients_[i] = {MoleculeScattering(Wavelength(i)), extinction,
                        extinction * scene.aerosol.single_scattering_albedo,
                        OzoneAbsorption(Wavelength(i))};
  }
}

int PathTracedSky::ShellAt(double radius) const {
  const auto shell = std::lower_bound(
      shells_.begin(), shells_.end(), radius,
      [](const Shell& candidate, double value) { return candidate.outer_radius < value; });
  return std::min(static_cast<int>(shell - shells_.begin()), kShells - 1);
}

namespace {

/// The segment of a ray within one shell: its length and the next shell (-1: the ground; the number
/// of shells: space).
struct Piece {
  double length;
  int next;
};

template <typename Shells>
Piece NextPiece(const Shells& shells, Vec3 position, Vec3 direction, int shell) {
  const double inner_radius = shell == 0 ? kGround : shells[shell - 1].outer_radius;
  const double along = Dot(position, direction);
  if (along < 0.0) {
    const double inner = ToSphere(position, direction, inner_radius);
    // A ray that grazes the inner sphere from outside.
    if (inner < -along) return {inner, shell - 1};
  }
  const double square = Dot(position, position);
  const double outer = shells[shell].outer_radius;
  const double root = std::sqrt(std::max(0.0, along * along - square + outer * outer));
  return {std::max(0.0, -along + root), shell + 1};
}

}  // namespace

double PathTracedSky::OpticalDepthToSun(Vec3 position, const Coefficients& c) const {
  if (Dot(position, to_sun_) < 0.0 && ToSphere(position, to_sun_, kGround) < kInfinity) {
    return kInfinity;
  }
  double depth = 0.0;
  int shell = ShellAt(Norm(position));
  while (shell >= 0 && shell < kShells) {
    const Shell& s = shells_[shell];
    const Piece piece = NextPiece(shells_, position, to_sun_, shell);
    if (piece.next < 0) return kInfinity;
    depth += piece.length * (c.molecules * s.molecules + c.aerosol * s.aerosol + c.ozone * s.ozone);
    position = position + to_sun_ * piece.length;
    shell = piece.next;
  }
  return depth;
}

double PathTracedSky::Trace(Vec3 direction, const Coefficients& c, double wall_m,
                            Walk* walk) const {
  const Vec3 eye{0.0, 0.0, kGround + AirMedium::kEyeHeight};
  Vec3 position = eye;
  int shell = ShellAt(position.z);
  double weight = 1.0, radiance = 0.0;
  for (int scattering = 0; scattering < 1000; ++scattering) {
    double wanted = -std::log(1.0 - walk->Next());
    bool scattered = false;
    while (shell >= 0 && shell < kShells) {
      const Shell& s = shells_[shell];
      const double extinction =
          c.molecules * s.molecules + c.aerosol * s.aerosol + c.ozone * s.ozone;
      const Piece piece = NextPiece(shells_, position, direction, shell);
      if (extinction * piece.length >= wanted) {
        position = position + direction * (wanted / extinction);
        scattered = true;
        break;
      }
      wanted -= extinction * piece.length;
      position = position + direction * piece.length;
      shell = piece.next;
    }
    if (scattering == 0 && Norm(position - eye) > wall_m) return 0.0;
    if (!scattered && shell >= kShells) return radiance;  // Into space.
    if (!scattered) {                                     // On the ground.
      const Vec3 up = Normalized(position);
      position = up * (kGround + 1e-3);
      shell = 0;
      weight *= scene_.ground_albedo;
      if (const double cosine = Dot(up, to_sun_); cosine > 0.0) {
        radiance += weight * cosine / kPi * std::exp(-OpticalDepthToSun(position, c));
      }
      direction = About(up, std::sqrt(walk->Next()), 2.0 * kPi * walk->Next());
    } else {
      const Shell& s = shells_[shell];
      const double molecules = c.molecules * s.molecules;
      const double haze = c.aerosol_scattering * s.aerosol;
      const double extinction = molecules + c.aerosol * s.aerosol + c.ozone * s.ozone;
      weight *= (molecules + haze) / extinction;
      const double share = haze / (molecules + haze);
      const double cosine = Dot(direction, to_sun_);
      const double phase = (1.0 - share) * MoleculePhase(cosine) +
                           share * AerosolPhase(scene_.aerosol.asymmetry, cosine);
      radiance += weight * phase * std::exp(-OpticalDepthToSun(position, c));
      const double u = walk->Next();
      const double turn =
          walk->Next() < share ? SampleAerosol(scene_.aerosol.asymmetry, u) : SampleMolecules(u);
      direction = About(direction, std::clamp(turn, -1.0, 1.0), 2.0 * kPi * walk->Next());
    }
    if (weight < 0.1) {  // Russian roulette.
      if (walk->Next() >= weight * 10.0) return radiance;
      weight = 0.1;
    }
  }
  return radiance;
}

XyY PathTracedSky::At(double elevation_deg, double azimuth_from_sun_deg, int paths,
                      std::uint64_t seed, double wall_m) const {
  const double e = elevation_deg * kRadiansPerDegree, a = azimuth_from_sun_deg * kRadiansPerDegree;
  const Vec3 direction{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
  Walk walk{std::mt19937_64(seed)};
  Vec3 xyz;
  for (int i = 0; i < kWavelengths; ++i) {
    double sum = 0.0;
    for (int path = 0; path < paths; ++path)
      sum += Trace(direction, coefficients_[i], wall_m, &walk);
    const ObserverBand& band = ObserverAt(Wavelength(i));
    const double watts = sum / paths * SolarIrradiance(Wavelength(i)) * 20.0 * kLumensPerWatt;
    xyz = xyz + Vec3{band.x, band.y, band.z} * watts;
  }
  return XyYFromXyz(xyz);
}

double PathTracedSky::SunNormalLux() const {
  double lux = 0.0;
  const Vec3 eye{0.0, 0.0, kGround + AirMedium::kEyeHeight};
  for (int i = 0; i < kWavelengths; ++i) {
    lux += ObserverAt(Wavelength(i)).y * SolarIrradiance(Wavelength(i)) * 20.0 * kLumensPerWatt *
           std::exp(-OpticalDepthToSun(eye, coefficients_[i]));
  }
  return lux;
}

}  // namespace pleinair::sky::reference
