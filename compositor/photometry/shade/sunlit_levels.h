#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Share of a shadow's depth. A surface sample that the model has in the sun is shaded if it is
/// darker than the sunlit ones by this share.
inline constexpr double kShadowDepthShare = 0.5;

/// Light on surfaces in direct sunlight, with the phantoms around them. Unit: cd/m² times
/// steradian. Frame of reference: marker coordinates.
class SunlitIrradiance {
 public:
  SunlitIrradiance(const PhantomRays& phantoms, const MarkerLightMeter& meter,
                   const sky::SkyModel& day, const Mat3& marker_from_world,
                   LinearRgb sky_radiance_scale);

  Vec3 to_sun() const { return to_sun_; }
  LinearRgb sky() const { return day_.SkyHorizontalIrradiance(); }
  /// Mean logarithm of the predicted light on the marker, which is the unit of the surface samples.
  double log_unit() const { return log_unit_; }
  LinearRgb sun_on_marker() const { return sun_on_marker_; }
  LinearRgb ambient_on_marker() const { return ambient_on_marker_; }

  LinearRgb SunOn(Vec3 normal) const;
  /// Mean over the places, which face `normal`. Only a few of them are evaluated.
  LinearRgb Ambient(const std::vector<Point<Marker>>& places, Vec3 normal) const;

 private:
  const PhantomRays& phantoms_;
  ScaledSky day_;
  Mat3 marker_from_world_;
  Vec3 to_sun_;
  double log_unit_;
  LinearRgb sun_on_marker_, ambient_on_marker_;
};

/// A plane of one material, as far as the model has it in the sun. Brightness is the mean of the
/// logarithms of linear red, green and blue.
struct SunlitSurface {
  Vec3 normal;
  std::vector<double> medians;  ///< One per cell.
  std::vector<double> tops;     ///< Upper quartile of the surface samples, one per cell.
  double depth = 0.0;           ///< Depth of a shadow there, logarithmic.
  double level = 0.0;           ///< Brightness in direct sunlight.
  /// True if none of it lies in direct sunlight. Then the level comes from other surfaces.
  bool all_in_shadow = false;
  /// True if the marker lies on a darker part of it, in the same shade as that part.
  bool shades_marker = false;

  /// Medians of the sunlit cells: those that are not darker than most by a shadow's depth.
  std::vector<double> SunlitCells() const;
  /// Sunlit reference brightness by the brightest places, even if there are few.
  double BrightLevel() const;
  /// Reference brightness for the decision whether cells are shaded.
  double SunlitLevel() const;
};

using SunlitSurfaces = std::map<SurfacePlane, SunlitSurface>;

/// Exposure scale by surfaces in direct sunlight.
struct SunlitScale {
  /// Logarithm of the ratio to the frames' own exposure scale. Above 0 where the marker has less
  /// than the sun.
  double log = 0.0;
  /// True if surfaces of two described colors agree nearly, because one color may be wrong. Also
  /// true for one color that can hardly be so wrong.
  bool agreed = false;
  /// True if the surface below the marker shows that the marker lies in shade
  /// (SunlitSurface::shades_marker).
  bool shown_by_surroundings = false;
};

/// Estimates the sunlit reference brightness of each surface, and the exposure scale by these. The
/// exposure scale is a median over cells, because described colors are rough and grass reflects
/// less than its blades.
///
/// Use it where unmodelled geometry shades a part of the view. A surface may lie wholly in shade.
/// The marker lies in shade if some surfaces are much brighter beside it than their colors allow.
/// Those surfaces must have a twentieth of the cells near their surfaces' levels. The exposure
/// scale is then theirs. Surfaces that are darker by more than the error of described colors lie
/// wholly in shade. A wrong color rarely explains a surface that is too bright, but may explain one
/// that is too dark.
///
/// A surface that shows both sun and shade contradicts this conclusion, with one exception. The
/// exception is a surface that is darker around the marker than elsewhere by a shadow's depth. Its
/// brightness there must match its color in the marker's own light. Its bright places then have the
/// sun that the marker lacks.
///
/// `sun_visible` has one flag per sample: the model has it in the sun.
SunlitScale FindSunlitLevels(const SunlitIrradiance& light,
                             const std::vector<std::uint8_t>& sun_visible,
                             const SurfaceSamples& samples, SunlitSurfaces* surfaces);

/// Minimum number of cells for a surface's level.
inline constexpr std::size_t kMinCells = 4;

}  // namespace pleinair::compositor
