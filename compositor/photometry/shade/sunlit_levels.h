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

/// Of a surface's places that the model has in the sun, a surface sample is taken for shaded where
/// it is darker than the open ones by this share of a shadow's depth.
inline constexpr double kShadowDepthShare = 0.5;

/// The light on surfaces in the open sun, phantoms about them as they are. cd/m² times steradian;
/// marker coordinates.
class SunlitIrradiance {
 public:
  SunlitIrradiance(const PhantomRays& phantoms, const MarkerLightMeter& meter,
                   const sky::SkyModel& day, const Mat3& marker_from_world,
                   LinearRgb sky_radiance_scale);

  Vec3 to_sun() const { return to_sun_; }
  LinearRgb sky() const { return day_.SkyHorizontalIrradiance(); }
  /// Mean logarithm of the light that the meter takes to be on the marker, the samples' unit.
  double log_unit() const { return log_unit_; }
  LinearRgb sun_on_marker() const { return sun_on_marker_; }
  LinearRgb ambient_on_marker() const { return ambient_on_marker_; }

  LinearRgb SunOn(Vec3 normal) const;
  /// Mean over places that face `normal`, of which a few are asked.
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
  std::vector<double> medians;  ///< Of its cells.
  std::vector<double> tops;     ///< Of each cell, what a quarter of its surface samples exceeds.
  double depth = 0.0;           ///< Of a shadow there, logarithmic.
  double level = 0.0;           ///< In the open sun.
  /// Whether none of it lies there: the level is then what other surfaces tell.
  bool all_in_shadow = false;
  /// Whether the marker lies on a darker part of it, in the same shade as that part.
  bool shades_marker = false;

  /// Medians of those that are no darker than most by a shadow's depth.
  std::vector<double> SunlitCells() const;
  /// What its brightest places tell of the open sun, few though they may be.
  double BrightLevel() const;
  /// What cells are compared with to tell whether they are shaded.
  double SunlitLevel() const;
};

using SunlitSurfaces = std::map<SurfacePlane, SunlitSurface>;

/// What surfaces in the open sun tell of the camera's exposure scale.
struct SunlitScale {
  double log = 0.0;  ///< Over the frames' own exposure scale; above 0 where the marker has less
                     ///< than the sun.
  /// Whether surfaces of two stated colors tell nearly that, for one may be wrong, or one does of
  /// which that can hardly be.
  bool agreed = false;
  /// Whether the surface that the marker lies on shows that it lies in shade
  /// (SunlitSurface::shades_marker).
  bool shown_by_surroundings = false;
};

/// Finds how bright each surface is in the open sun, and what exposure scale that tells of: a
/// median over cells, since colors are stated roughly and grass reflects less than its blades.
///
/// To be asked where something that no phantom stands for keeps the sun from a part of what is in
/// view; surfaces need not have a part in the open. Where some are much brighter than their color
/// allows beside the marker, and have a twentieth of the cells near their surfaces' levels, the
/// marker lies in shade: the exposure scale is theirs, and surfaces that are darker than that by
/// more than colors are misjudged lie in shade as a whole. The cause of a surface that is too
/// bright can hardly be its stated color; of one that is too dark it can.
///
/// A surface that shows sun and shade of its own speaks against that, but not where it is darker
/// around the marker than elsewhere by a shadow's depth and about as bright there as its color
/// makes it in the marker's own light: its bright places are then what the marker has not.
///
/// `reached`, of each sample: whether the model has it in the sun.
SunlitScale FindSunlitLevels(const SunlitIrradiance& light,
                             const std::vector<std::uint8_t>& sun_visible,
                             const SurfaceSamples& samples, SunlitSurfaces* surfaces);

/// Cells that a surface's level needs.
inline constexpr std::size_t kMinCells = 4;

}  // namespace pleinair::compositor
