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

/// Shadows in view that no phantom explains: a tree's, a neighbouring house's, or the phantoms' own
/// where the sun does not stand where it is thought to.
struct UnmodelledShadows {
  /// Places on the sunny side of the phantoms' own shadows.
  struct SunnySides {
    int places = 0;
    double shaded = 0.0;  ///< Share of them that lie in shade all the same.
  };
  /// What the phantoms' sunlit places show of the camera (SunlitScale).
  struct ExposureScale {
    /// Over that of the frames: above 1 where the marker, or the brightest of it, has less than the
    /// open sun.
    double ratio = 1.0;
    bool agreed = false;
    bool shown_by_surroundings = false;
  };
  /// The sun's light on the marker in the open and all other, as phantoms leave it.
  struct LightOnMarker {
    LinearRgb sun, ambient;
  };

  int places = 0;          ///< Small cells of one material that face the sun.
  int boundary_cells = 0;  ///< Of them, those that a shadow's edge crosses.
  double edges = 0.0;      ///< Their share.
  int sunlit = 0;          ///< Cells that the model has wholly in the sun.
  double shaded = 0.0;     ///< Share of them that lie in shade.
  double dim = 0.0;        ///< The same beside their surfaces' open levels, which few may reach.
  SunnySides sunny_sides;
  ExposureScale sunlit_scale;
  LightOnMarker on_marker;                ///< Where Matters().
  SunTransmittanceMap sun_transmittance;  ///< Where Matters().
  std::vector<ShadowCrossing> crossings;
  /// The darkest of the cells that the model has wholly in the sun, beside the light in the open:
  /// where no edge shows how deep the shade is. Where something shades what is in view.
  std::vector<ShadowCrossing> deepest;

  /// Whether the edges are more than chance and things that no phantom stands for bring about: a
  /// sun must cast them.
  bool CastBySun() const;
  /// Whether so much is so dark that hardly anything but a sun's shade makes it so, though a crown
  /// leaves no sharp edge.
  bool IsWide() const;
  /// Whether the marker is so much darker than what lies in the open that it must lie in shade,
  /// even if evenly: no stated color is believed to be so far off. Less will do where the surface
  /// that it lies on shows that.
  bool ShadesMarker() const;
  /// Whether what casts them keeps the sun from the phantoms' own shadows, too, which then show no
  /// edge under whatever sun; where the sun is thought to stand elsewhere than it does, most of
  /// these places lie in the open.
  bool HidesEdges() const;
  /// Whether so much lies in shade that the model has in the sun that pictures must be asked where.
  bool Matters() const;
};

/// Looks for shadows of about the depth that `daylight` gives them where the sky is
/// `sky_radiance_scale` times as strong beside its sun; `marker_from_world` with the heading in
/// use. `meter`: by which the samples' gains were read.
UnmodelledShadows FindUnmodelledShadows(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                        const MarkerLightMeter& meter,
                                        const sky::SkyModel& daylight,
                                        const Mat3& marker_from_world,
                                        LinearRgb sky_radiance_scale);

}  // namespace pleinair::compositor
