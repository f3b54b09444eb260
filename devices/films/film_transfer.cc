#include "devices/films/film_transfer.h"

#include <algorithm>
#include <cmath>

namespace pleinair::devices {
namespace {

// ITU-R BT.2100-2, Table 5: b = 1 - 4 a, c = 1/2 - a ln(4 a).
constexpr double kHlgA = 0.17883277;
constexpr double kHlgB = 0.28466892;
constexpr double kHlgC = 0.55991073;

// ITU-R BT.2100-2, Table 4.
constexpr double kPqM1 = 2610.0 / 16384.0;
constexpr double kPqM2 = 2523.0 / 4096.0 * 128.0;
constexpr double kPqC1 = 3424.0 / 4096.0;
constexpr double kPqC2 = 2413.0 / 4096.0 * 32.0;
constexpr double kPqC3 = 2392.0 / 4096.0 * 32.0;
constexpr double kPqPeak_cd_m2 = 10'000.0;

double Clamped(double signal) { return std::clamp(signal, 0.0, 1.0); }

/// The linear part of BT.709 ends at the signal 4.5 × 0.018.
constexpr double kBt709LinearLight = 0.018;
constexpr double kBt709Slope = 4.5;

}  // namespace

double LightFromBt709(double signal) {
  const double e = Clamped(signal);
  if (e < kBt709Slope * kBt709LinearLight) return e / kBt709Slope;
  return std::pow((e + 0.099) / 1.099, 1.0 / 0.45);
}

double Bt709FromLight(double light) {
  const double e = Clamped(light);
  return e < kBt709LinearLight ? kBt709Slope * e : 1.099 * std::pow(e, 0.45) - 0.099;
}

double LightFromGamma(double signal, double gamma) { return std::pow(Clamped(signal), gamma); }

double LightFromHlg(double signal) {
  const double e = Clamped(signal);
  return e <= 0.5 ? e * e / 3.0 : (std::exp((e - kHlgC) / kHlgA) + kHlgB) / 12.0;
}

double HlgFromLight(double light) {
  const double e = Clamped(light);
  return e <= 1.0 / 12.0 ? std::sqrt(3.0 * e) : kHlgA * std::log(12.0 * e - kHlgB) + kHlgC;
}

double DisplayFromPq_cd_m2(double signal) {
  const double power = std::pow(Clamped(signal), 1.0 / kPqM2);
  const double ratio = std::max(power - kPqC1, 0.0) / (kPqC2 - kPqC3 * power);
  return kPqPeak_cd_m2 * std::pow(ratio, 1.0 / kPqM1);
}

double PqFromDisplay_cd_m2(double display_cd_m2) {
  const double power = std::pow(Clamped(display_cd_m2 / kPqPeak_cd_m2), kPqM1);
  return std::pow((kPqC1 + kPqC2 * power) / (1.0 + kPqC3 * power), kPqM2);
}

double LightFromPq(double signal) {
  constexpr double kG709LinearLight = 0.0003024, kG709Slope = 267.84, kG709Scale = 59.5208;
  const double e = std::pow(DisplayFromPq_cd_m2(signal) / 100.0, 1.0 / 2.4);
  if (e <= kG709LinearLight * kG709Slope) return e / kG709Slope;
  return std::pow((e + 0.099) / 1.099, 1.0 / 0.45) / kG709Scale;
}

double HlgReferenceWhite() { return LightFromHlg(0.75); }

double PqReferenceWhite() { return LightFromPq(PqFromDisplay_cd_m2(203.0)); }

}  // namespace pleinair::devices
