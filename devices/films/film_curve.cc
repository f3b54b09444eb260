#include "devices/films/film_curve.h"

#include <vector>

#include "devices/films/film_transfer.h"

namespace pleinair::devices {

CameraResponse ResponseOf(FilmCurve curve) {
  if (curve == FilmCurve::kSrgb) return {};
  constexpr int kCodes = 256;
  constexpr double kMinStep = 2e-6;  // CameraResponse resolves half of it.
  std::vector<double> encoded, light;
  for (int code = 0; code < kCodes; ++code) {
    const double signal = code / 255.0;
    const double each = curve == FilmCurve::kBt709     ? LightFromBt709(signal)
                        : curve == FilmCurve::kGamma22 ? LightFromGamma(signal, 2.2)
                                                       : LightFromGamma(signal, 2.8);
    if (!light.empty() && each - light.back() < kMinStep) continue;
    encoded.push_back(signal);
    light.push_back(each);
  }
  return CameraResponse::FromSamples(encoded, {light, light, light}).value();
}

}  // namespace pleinair::devices
