#pragma once

#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/shade/shadow_crossing.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Shadows in view that no phantom explains. Trees or neighbouring houses may cast them, or the
/// phantoms themselves if the assumed sun position is wrong.
struct UnmodelledShadows {
  /// Places on the sunny side of the phantoms' own shadows.
  struct SunnySides {
    int places = 0;
    double shaded = 0.0;  ///< Share of them that is shaded all the same.
  };
  /// Exposure scale by the phantoms' sunlit places (SunlitScale).
  struct ExposureScale {
    /// Ratio to the frames' exposure scale. Above 1 where the marker, or its brightest part, has
    /// less than direct sunlight.
    double ratio = 1.0;
    bool agreed = false;
    bool shown_by_surroundings = false;
  };
  /// Light of the sun and all other light on the unshaded marker, with the phantoms around it.
  struct LightOnMarker {
    LinearRgb sun, ambient;
  };

  int places = 0;          ///< Cells of one material that face the sun.
  int boundary_cells = 0;  ///< Cells that contain a shadow boundary.
  double edges = 0.0;      ///< Share of boundary_cells in places.
  int sunlit = 0;          ///< Cells that the model has wholly in the sun.
  double shaded = 0.0;     ///< Share of them that is shaded.
  /// The same by the sunlit reference brightness of their surfaces, which few cells may reach.
  double dim = 0.0;
  SunnySides sunny_sides;
  ExposureScale sunlit_scale;
  LightOnMarker on_marker;                ///< Where Matters().
  SunTransmittanceMap sun_transmittance;  ///< Where Matters().
  std::vector<ShadowCrossing> crossings;
  /// Darkest of the cells that the model has wholly in the sun, relative to the light in direct
  /// sunlight. They serve where no edge shows the shade's depth. Filled where unmodelled geometry
  /// shades the view.
  std::vector<ShadowCrossing> deepest;

  /// True if there are more edges than chance and unmodelled objects cause: a sun must cast them.
  bool CastBySun() const;
  /// True if so large an area is so dark that only sun shade explains it, although a crown leaves
  /// no sharp edge.
  bool IsWide() const;
  /// True if the marker must lie in shade, even if evenly, because it is much darker than sunlit
  /// surfaces. No described color is expected to be so wrong. A smaller difference suffices where
  /// the surface below the marker shows the shade.
  bool ShadesMarker() const;
  /// True if the unmodelled geometry also hides the sun from the phantoms' own shadows, which then
  /// show no edge. If the assumed sun position is wrong, most of these places are sunlit instead.
  bool HidesEdges() const;
  /// True if so much of the modelled sunlit area is shaded that each image must be tested for
  /// shade.
  bool Matters() const;
};

/// Finds shadows of about the depth that `daylight` predicts with its sky scaled by
/// `sky_radiance_scale` beside its sun. `marker_from_world` has the heading in use. `meter` is the
/// one that estimated the samples' exposure scales.
UnmodelledShadows FindUnmodelledShadows(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                        const MarkerLightMeter& meter,
                                        const sky::SkyModel& daylight,
                                        const Mat3& marker_from_world,
                                        LinearRgb sky_radiance_scale);

}  // namespace pleinair::compositor
