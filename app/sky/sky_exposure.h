#pragma once

#include <optional>

#include "app/sky/sky_picture.h"
#include "base/image.h"
#include "base/units.h"

namespace pleinair::app {

/// Maps luminance to the values of a PNG or a video.
struct SkyExposure {
  double exposure_scale = 0.0;  ///< Per luminance, 1/(cd/m²).

  /// Exposure value of a camera at ISO 100: exposure scale = 1 / (1.2 · 2^EV) (ISO 12232,
  /// saturation-based speed).
  double Ev100() const;
};

/// The exposure of an EV at ISO 100.
SkyExposure ExposureOf(double ev100);

/// Exposure for an eye adapted to a sky of this illuminance on level ground. The mean luminance L =
/// E / π maps to the key of Krawczyk, Myszkowski & Seidel 2005, "Perceptual effects in real-time
/// tone mapping":
/// α = 1.03 − 2 / (2 + log10(L + 1)), exposure scale = 0.7 α / L.
/// Night appears darker than day. The sky appears darker than a whole scene, because it is the
/// bright part of one. Below 0.005 cd/m² the exposure scale is constant: a moonless night is black
/// except for outlines.
SkyExposure AutomaticExposure(Lux sky_horizontal);

/// Converts to an sRGB image for a screen. Luminance uses the curve of Reinhard et al. 2002,
/// "Photographic tone reproduction for digital images", Eq. (4), with white at 8 times the exposure
/// scale's reciprocal:
/// v = exposure scale · L, displayed v (1 + v / 8²) / (1 + v).
/// The color is kept. It is desaturated only as far as a channel would exceed the screen's range.
/// is drawn towards white only as far as a channel would leave the screen's range.
RgbImage ToneMap(const LightImage& light, SkyExposure exposure);

}  // namespace pleinair::app
