#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"
#include "content/draping/surface_index.h"

namespace pleinair::content {

/// What a pinhole camera sees of a surface: for each pixel the depth of the nearest triangle. The
/// distortion of the lens is left out. The processor's twin of a G-buffer.
class SurfaceView {
 public:
  /// A point on the first visible surface.
  struct Sight {
    Vec3 at;  ///< East, north, up, metres.
    std::uint32_t triangle = 0;
  };

  /// Draws all triangles. Nearer than kNear_m nothing is drawn.
  SurfaceView(const SurfaceIndex& surface, const CameraModel& camera,
              const Transform<World, Camera>& world_from_camera);

  Vec3 InCamera(const Vec3& point) const { return (camera_from_world_ * Point<World>{point}).xyz; }
  /// Pixel of a point in front of the camera; unset: it is nearer than kNear_m along the axis.
  std::optional<Vec2> PixelOf(const Vec3& point) const;
  /// True if a pixel, whole or not, lies in the picture.
  bool InPicture(Vec2 pixel) const;
  /// The surface at a place of the picture: the plane of the triangle that the nearest pixel sees,
  /// within the depths of that triangle. Unset: the sky, or outside the picture.
  ///
  /// Deviation from Trapp and Döllner 2019, who average positions of pixels: at a silhouette an
  /// average lies on no surface, and hidden places would be found there.
  std::optional<Sight> At(Vec2 pixel) const;

  Vec3 centre() const { return world_from_camera_.translation_m; }
  const CameraModel& camera() const { return camera_; }

  static constexpr double kNear_m = 0.05;

 private:
  struct Corner {
    Vec2 pixel;
    double inverse_depth = 0.0;
  };
  void Draw(std::uint32_t triangle);
  void Fill(const Corner& a, const Corner& b, const Corner& c, std::uint32_t triangle);
  Vec3 AtDepth(Vec2 pixel, double depth_m) const;

  const SurfaceIndex& surface_;
  CameraModel camera_;
  Transform<World, Camera> world_from_camera_;
  Transform<Camera, World> camera_from_world_;
  Image<float> inverse_depth_;  // 0: sky.
  std::vector<std::uint32_t> triangles_;
};

/// True if the surface stands between the camera and a point, nearer to the camera than the point
/// by more than 1 cm. By rays: exact.
bool IsHiddenFrom(const SurfaceIndex& surface, const Vec3& camera, const Vec3& point);

}  // namespace pleinair::content
