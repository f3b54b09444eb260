#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// Logarithms of linear red, green and blue.
using LogRgb = std::array<double, 3>;

/// Mean over the channels: the brightness in which surfaces are compared.
inline double Brightness(const LogRgb& log_rgb) {
  return (log_rgb[0] + log_rgb[1] + log_rgb[2]) / 3;
}

/// Light on a small surface from each source, as the models of the day have it: lux, linear
/// Rec.709. Interreflection between the phantoms is included.
struct CellLight {
  LinearRgb sky;        ///< From the sky beside the sun.
  LinearRgb reflected;  ///< Sunlight that other surfaces reflect.
  LinearRgb overcast;   ///< From an overcast sky.
};

/// Those samples of a cell that phantoms leave in the sun, or those that they shade.
struct CellPart {
  Point<Marker> place;    ///< The sample nearest to their middle.
  LogRgb log_rgb{};       ///< Median, as in SurfaceSample.
  double variance = 0.0;  ///< Variance of the median of the brightness.
  CellLight light;
};

/// Two levels of brightness within one part, logarithms of the bright level over the dark one.
struct CellStep {
  LogRgb contrast{};
  double bright = 0.0;  ///< Brightness of the bright level.
};

/// The evidence of one cell of SurfaceSamples: a small place on one material and plane.
struct LightCell {
  int surface = 0;     ///< As in PhantomSurface; below 0: the marker's white.
  int plane = 0;       ///< Cells of one surface that face about the same way have one number.
  Vec3 normal;         ///< Unit, marker coordinates.
  LinearRgb albedo{};  ///< As described.
  LinearRgb sun;       ///< The unshaded sun on it: lux; black where it faces away.
  std::optional<CellPart> sunny, shaded;  ///< Both where a phantom's shadow ends here.
  std::optional<CellStep> step;           ///< Only where there is one part.
};

}  // namespace pleinair::compositor
