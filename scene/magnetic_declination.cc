#include "scene/magnetic_declination.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/SphericalHarmonic.hpp>

#include "scene/wmm2025_coefficients.h"

namespace pleinair::scene {
namespace {

// WMM2025 technical report, 1.5: validity, from the release to five years after the epoch.
constexpr double kFirstYear = 2024.866, kEndYear = 2030.0;
constexpr double kBlackout_nT = 2000.0;  // 1.9: compasses are unreliable below.

/// Years wholly outside of the validity are returned without their fraction: UtcTime may not reach
/// their ends.
double DecimalYear(UtcTime time) {
  const UtcTime::Civil date = time.ToCivil();
  if (date.year + 1 <= kFirstYear || date.year >= kEndYear) return date.year;
  const auto start_of = [](int year) {
    return UtcTime::Parse(std::to_string(year) + "-01-01T00:00:00Z")->nanoseconds_since_1970();
  };
  const auto start = static_cast<double>(start_of(date.year));
  const auto end = static_cast<double>(start_of(date.year + 1));
  return date.year + (static_cast<double>(time.nanoseconds_since_1970()) - start) / (end - start);
}

/// Field in nT towards east, north and up.
std::array<double, 3> Field_nT(double latitude_deg, double longitude_deg, double height_m,
                               double year) {
  // GeographicLib's order: by columns m, each from n = m; sines begin with m = 1.
  constexpr int kN = kWmmDegree;
  std::vector<double> cosines(static_cast<std::size_t>((kN + 1) * (kN + 2) / 2));
  std::vector<double> sines(static_cast<std::size_t>(kN * (kN + 1) / 2));
  const double years = year - kWmmEpoch;
  for (const GaussCoefficient& each : kWmm2025) {
    const int at = each.m * kN - each.m * (each.m - 1) / 2 + each.n;
    cosines[static_cast<std::size_t>(at)] = each.g_nT + years * each.g_nT_per_year;
    if (each.m == 0) continue;
    sines[static_cast<std::size_t>(at - (kN + 1))] = each.h_nT + years * each.h_nT_per_year;
  }
  const GeographicLib::SphericalHarmonic potential(cosines, sines, kN, kWmmRadius_m,
                                                   GeographicLib::SphericalHarmonic::SCHMIDT);
  double x = 0.0, y = 0.0, z = 0.0;
  std::vector<double> rotation(9);
  GeographicLib::Geocentric::WGS84().Forward(latitude_deg, longitude_deg, height_m, x, y, z,
                                             rotation);
  double gx = 0.0, gy = 0.0, gz = 0.0;
  static_cast<void>(potential(x, y, z, gx, gy, gz));
  // B = -a grad(sum); the rotation's columns are east, north and up in geocentric coordinates.
  std::array<double, 3> field{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    field[axis] =
        -kWmmRadius_m * (rotation[axis] * gx + rotation[3 + axis] * gy + rotation[6 + axis] * gz);
  }
  return field;
}

}  // namespace

Result<Radians> MagneticDeclination(double latitude_deg, double longitude_deg, double height_m,
                                    UtcTime time) {
  const double year = DecimalYear(time);
  if (year < kFirstYear || year >= kEndYear) {
    return InputError("",
                      "the magnetic declination of " + time.ToString() +
                          " is unknown: WMM2025 holds from 2024-11-13 to 2029-12-31",
                      "look it up, add it to the compass's heading, and give heading_deg");
  }
  const auto [east, north, up] = Field_nT(latitude_deg, longitude_deg, height_m, year);
  if (std::hypot(east, north) < kBlackout_nT) {
    return InputError("", "a compass is of no use so near to a magnetic pole",
                      "measure the heading otherwise, and give heading_deg");
  }
  return Radians(std::atan2(east, north));
}

}  // namespace pleinair::scene
