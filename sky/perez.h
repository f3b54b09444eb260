#pragma once

#include <array>

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"
#include "sky/color.h"

namespace pleinair::sky {

/// Clear to hazy sky in the form of Perez, Seals & Michalsky 1993, "All-weather model for sky
/// luminance distribution", with the coefficients of Preetham, Shirley & Smits 1999, "A practical
/// analytic model for daylight", appendix A.2:
///
///   F(θ, γ) = (1 + A e^(B / cos θ)) (1 + C e^(D γ) + E cos² γ),
///   value(θ, γ) = value_zenith F(θ, γ) / F(0, θ_sun),   for luminance Y and chromaticity x, y,
///
/// θ is the angle from the zenith, γ that from the sun. Y, x and y each have their own A…E and
/// zenith values, which are functions of turbidity and sun elevation (Kolivand & Sunar 2014, Eqs.
/// 8–9, use the same A…E for all three by mistake).
///
/// Turbidity is clamped to the range in which the model is finite and positive; NaN becomes the
/// minimum. A sun below the horizon is moved to the horizon, and the light is scaled by
/// TwilightShare() (sky/atmosphere/twilight.h).
///
/// Luminances are the model's own, 1.1 to 3.9 times those of measured and simulated clear skies;
/// sky/atmosphere/atmosphere.h is more accurate.
class PerezSky {
 public:
  /// Below 2 the zenith normaliser and the horizon become negative; above 10 the zenith does at low
  /// suns.
  static constexpr double kMinTurbidity = 2.0;
  static constexpr double kMaxTurbidity = 10.0;
  /// A clear day (Preetham et al. 1999, Fig. 3: 2 very clear, 3 clear, 6 hazy).
  static constexpr double kDefaultTurbidity = 2.5;

  /// `to_sun`: unit vector, east, north, up.
  PerezSky(double turbidity, Direction<World> to_sun);

  /// The turbidity in use, clamped to the valid range.
  double turbidity() const { return turbidity_; }
  bool TurbidityWasClamped() const { return turbidity_was_clamped_; }

  /// Luminance (cd/m²) and chromaticity in a direction; black below the horizon.
  XyY At(Direction<World> from) const;

  /// The same direction as linear Rec.709: radiance in cd/m², no channel negative.
  LinearRgb Radiance(Direction<World> from) const { return RgbFromXyY(At(from)); }

  /// Horizontal illuminance of the sky, lux, by IntegrateProjectedDome().
  LinearRgb HorizontalIrradiance() const;

 private:
  struct Distribution {
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0, e = 0.0;
    double zenith_over_f = 0.0;  ///< value_zenith / F(0, θ_sun).
    double At(double cos_theta, double gamma, double cos_gamma) const;
  };

  double turbidity_ = kMinTurbidity;
  bool turbidity_was_clamped_ = false;
  Vec3 to_sun_;  ///< On the horizon when the sun is below it.
  Distribution luminance_, x_, y_;
};

}  // namespace pleinair::sky
