#pragma once

#include <vector>

#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// The hemisphere in patches of nearly equal solid angle, after Tregenza 1987, "Subdivision of the
/// sky hemisphere for luminance measurements". It has seven bands of 12° with 30, 30, 24, 24, 18,
/// 12 and 6 patches, and a cap of 6°. With `division` m, every patch of a band becomes m × m
/// patches (Reinhart's subdivision): 144 m² + 1. The land below the horizon is one more patch, the
/// last.
class SkyPatches {
 public:
  /// `up`: unit, marker coordinates. `division` 1…4.
  SkyPatches(Vec3 up, int division);

  int count() const { return count_; }  ///< Sky patches, without the land.
  int land() const { return count_; }   ///< Index of the land.
  int total() const { return count_ + 1; }
  int division() const { return division_; }

  /// Index of the patch that contains a unit direction (marker coordinates).
  int At(Vec3 direction) const;
  double SolidAngle(int patch) const;
  /// A direction within a patch of the sky. Equal steps of either coordinate, 0…1, are equal steps
  /// of solid angle.
  Vec3 Within(int patch, double across, double up) const;

  /// Mean radiance of every sky patch, and of the land in full sun and skylight, cd/m².
  std::vector<LinearRgb> Radiances(const sky::SkyModel& day, const Mat3& marker_from_world,
                                   double land_albedo) const;

  /// The sun as patches: radiances that together give the sun's irradiance. The four patches whose
  /// centres surround the sun share it, so that the light changes continuously with its position.
  std::vector<LinearRgb> Sun(const sky::SkyModel& day, const Mat3& marker_from_world) const;

 private:
  struct Band {
    double low = 0.0, high = 0.0;  ///< Elevations.
    int first = 0, patches = 0;
  };
  /// Elevation, and azimuth as 0…1 from a fixed direction of the horizon.
  std::pair<double, double> Angles(Vec3 direction) const;
  Vec3 Direction(double elevation, double turn) const;
  int BandAt(double elevation) const;

  Vec3 up_, east_, north_;
  int division_ = 1;
  std::vector<Band> bands_;
  int count_ = 0;
};

}  // namespace pleinair::compositor
