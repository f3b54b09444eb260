#pragma once

#include <optional>

#include "app/sky/sky_picture.h"
#include "base/image.h"
#include "base/units.h"

namespace pleinair::app {

/// How light becomes the values of a PNG or a video.
struct SkyExposure {
  double exposure_scale = 0.0;  ///< Of luminance, 1/(cd/m²).

  /// What a camera of ISO 100 would be set to: exposure scale = 1 / (1.2 · 2^EV) (ISO 12232,
  /// saturation-based speed).
  double Ev100() const;
};

/// The exposure of an EV at ISO 100.
SkyExposure ExposureOf(double ev100);

/// As an eye would adapt to a sky of this illuminance on level ground: the mean luminance
/// L = E / π is shown at the key of Krawczyk, Myszkowski & Seidel 2005, "Perceptual effects in
/// real-time tone mapping", α = 1.03 − 2 / (2 + log10(L + 1)), exposure scale = 0.7 α / L: by night
/// darker than by day, and darker than a whole scene would be shown, whose bright part the sky is.
/// Below 0.005 cd/m² the exposure scale grows no more: a moonless night is black but for its
/// outlines.
SkyExposure AutomaticExposure(Lux sky_horizontal);

/// The picture for a screen, sRGB. Luminance goes through the curve of Reinhard et al. 2002,
/// "Photographic tone reproduction for digital images", Eq. (4), with white at 8 times the exposure
/// scale's reciprocal: v = exposure scale · L, shown v (1 + v / 8²) / (1 + v). The color stays, and
/// is drawn towards white only as far as a channel would leave the screen's range.
RgbImage ToneMap(const LightImage& light, SkyExposure exposure);

}  // namespace pleinair::app
