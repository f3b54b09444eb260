#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "compositor/light/ray_scene.h"
#include "shadows/bench/bench_renderer.h"
#include "shadows/bench/bench_scene.h"

namespace pleinair::app {

/// The pixels of an image to trace.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The surface at each pixel's centre, for shading images.
struct SurfacePicture {
  Image<float> albedo;  ///< Linear, three channels; black where there is no surface.
  Image<float> cosine;  ///< Sun to normal; 0 where the surface faces away.
  Image<float> leaves;  ///< 1 on a tree's crown.
};

/// Ground-truth visibility for shadow methods: rays (Embree) to a uniform disc of 0.533°. The image
/// does not depend on the number of threads.
class ShadowTruth {
 public:
  /// `rays`: per pixel, a square number.
  static Result<ShadowTruth> Create(const shadows::BenchScene& scene, int rays);

  /// Mean over each pixel: √rays positions, with √rays rays from each. Positions on another surface
  /// than the pixel's centre (different depth or slope) are ignored. A renderer that shades once
  /// per pixel sees only the centre. Pixels outside `window` have depth 0.
  shadows::VisibilityPicture Render(const shadows::View& view, int width, int height,
                                    PixelWindow window) const;

  SurfacePicture Surfaces(const shadows::View& view, int width, int height) const;

  /// Visibility at a surface point with that unit normal.
  double At(const glm::dvec3& point, const glm::dvec3& normal) const;

 private:
  struct Hit {
    glm::dvec3 point{0.0}, normal{0.0};
    double depth_m = 0.0;  ///< 0: no hit.
    std::uint32_t mesh = 0;
  };
  ShadowTruth() = default;
  Hit Trace(const shadows::View& view, const glm::dvec3& eye, double x, double y, int width,
            int height) const;
  /// Share of unoccluded rays among the disc's rays first, first + step, …
  double FreeShare(const glm::dvec3& point, const glm::dvec3& normal, int first, int step) const;

  std::shared_ptr<const compositor::RayScene> rays_scene_;
  std::vector<std::vector<glm::dvec3>> triangle_normals_;  // One list per mesh.
  std::vector<glm::vec3> albedos_;                         // One per mesh.
  std::vector<bool> leaves_;                               // One per mesh.
  std::vector<Vec3> directions_;                           // Samples of the disc.
  glm::dvec3 to_sun_{0.0};
};

}  // namespace pleinair::app
