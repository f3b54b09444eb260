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

/// Which pixels of a picture to trace.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

/// What is seen through each pixel's centre, to shade pictures with.
struct SurfacePicture {
  Image<float> albedo;  ///< Linear, three channels; black where nothing is seen.
  Image<float> cosine;  ///< Of the angle between sun and surface; 0 where it is turned away.
  Image<float> leaves;  ///< 1 where a tree's crown is seen.
};

/// The visibility that shadow methods are measured against: rays (Embree) to a uniform disc of
/// 0.533°. Renders the same picture for any number of threads.
class ShadowTruth {
 public:
  /// `rays` a pixel, a square number.
  static Result<ShadowTruth> Create(const shadows::BenchScene& scene, int rays);

  /// Mean over each pixel: √rays places in the pixel, √rays rays from each. Places whose surface is
  /// not the one at the pixel's centre (another depth or slope) are left out, because a renderer
  /// that shades once a pixel sees the centre's. Pixels outside `window` hold depth 0.
  shadows::VisibilityPicture Render(const shadows::View& view, int width, int height,
                                    PixelWindow window) const;

  SurfacePicture Surfaces(const shadows::View& view, int width, int height) const;

  /// At a point of a surface with that unit normal.
  double At(const glm::dvec3& point, const glm::dvec3& normal) const;

 private:
  struct Hit {
    glm::dvec3 point{0.0}, normal{0.0};
    double depth_m = 0.0;  ///< 0: nothing hit.
    std::uint32_t mesh = 0;
  };
  ShadowTruth() = default;
  Hit Trace(const shadows::View& view, const glm::dvec3& eye, double x, double y, int width,
            int height) const;
  /// Free ones among the disc's rays first, first + step, …
  double FreeShare(const glm::dvec3& point, const glm::dvec3& normal, int first, int step) const;

  std::shared_ptr<const compositor::RayScene> rays_scene_;
  std::vector<std::vector<glm::dvec3>> triangle_normals_;  // A list a mesh.
  std::vector<glm::vec3> albedos_;                         // One a mesh.
  std::vector<bool> leaves_;                               // One a mesh.
  std::vector<Vec3> directions_;                           // Over the disc.
  glm::dvec3 to_sun_{0.0};
};

}  // namespace pleinair::app
