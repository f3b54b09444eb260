#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "scene/marker_reflectance.h"

namespace pleinair::compositor {

/// A point on a real surface with its brightness, averaged over the frames that show it.
struct SurfaceSample {
  Point<Marker> point;
  Vec3 normal;
  double footprint_m = 0.0;  ///< Edge of a pixel there, at the first observation.
  std::array<double, 3>
      log_rgb{};           ///< Mean logarithm of linear light over the frame's exposure scale.
  int surface = 0;         ///< As in PhantomSurface; below 0: the marker's white.
  int placed_model = -1;   ///< As in PhantomSurface; -1: the marker.
  LinearRgb albedo{};      ///< As described for the surface.
  std::uint32_t cell = 0;  ///< Samples of one cell are neighbours on one material and plane.
  int frames = 0;          ///< Frames that show it unclipped.
};

/// A plane of one material: surface and normal. The surface is that of PhantomSurface; all of the
/// marker's white is one surface. The normal is in thousandths, because normals on one plane differ
/// by rounding.
using SurfacePlane = std::pair<int, std::array<int, 3>>;

SurfacePlane PlaneOf(int surface, Vec3 normal);

/// Samples the phantoms' surfaces and the marker's white in frames. Samples are fixed to the
/// surfaces, so that several frames of a moving camera add up. Sun and weather must be the same in
/// all frames.
class SurfaceSamples {
 public:
  /// `phantoms` must outlive this object.
  SurfaceSamples(const PhantomRays& phantoms, const CameraModel& camera,
                 const scene::MarkerReflectance& marker, const CameraResponse& response = {});

  /// `exposure_scale` is the camera's in this frame. Only its change between frames matters. The
  /// first frame decides whether the marker's white counts as a surface: `shows_marker`.
  void AddFrame(CameraImageView image, const Transform<Camera, Marker>& pose,
                LinearRgb exposure_scale, bool shows_marker = true);

  const std::vector<SurfaceSample>& samples() const { return samples_; }
  const scene::MarkerReflectance& marker() const { return marker_; }
  std::uint32_t cells() const { return static_cast<std::uint32_t>(cells_.size()); }
  int frames() const { return frames_; }

 private:
  using CellKey = std::array<int, 8>;

  /// Returns true if the frame shows the sample at `pixel`, and adds its brightness.
  bool Observe(CameraImageView image, const Transform<Camera, Marker>& pose,
               LinearRgb exposure_scale, SurfaceSample* sample, Vec2* pixel) const;
  void AddSurfaceSample(const PhantomSurface& surface, double distance_m);
  void AddMarker(double distance_m);
  bool IsOnMargin(Point<Marker> point) const;

  const PhantomRays& phantoms_;
  CameraModel camera_;
  scene::MarkerReflectance marker_;
  CameraResponse response_;
  std::vector<SurfaceSample> samples_;
  std::map<CellKey, std::uint32_t> cells_;
  int frames_ = 0;
};

}  // namespace pleinair::compositor
