#pragma once

#include <array>
#include <glm/glm.hpp>
#include <list>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/vertex_array.h"
#include "shadows/fading_shadow_maps.h"
#include "shadows/shadow_maps.h"
#include "tests/gl/gl_fixture.h"

namespace pleinair::shadows {

/// A rectangular grid of points, marker coordinates: origin + (column + ½) du + (row + ½) dv.
struct ProbePlane {
  glm::dvec3 origin{0.0};
  glm::dvec3 du{0.0}, dv{0.0};
  int width = 0, height = 0;
  glm::dvec3 normal{0.0, 0.0, 1.0};

  glm::dvec3 At(int x, int y) const { return origin + du * (x + 0.5) + dv * (y + 0.5); }
};

/// Scenes of axis-aligned boxes and parallelograms. Computes the visibility from the maps and the
/// true one by rays to the sun's disc.
class ShadowScene : public gl::GlTest {
 protected:
  /// Adds a solid box, or a parallelogram (which never shades itself).
  void AddBox(const glm::dvec3& low, const glm::dvec3& high);
  void AddQuad(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b);
  void AddMesh(const std::vector<glm::vec3>& positions, const std::vector<unsigned>& indices);
  /// A ground of 16 m × 16 m centred at the origin.
  void AddGround() { AddQuad({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}); }
  std::vector<ShadowCaster> Casters() const;
  Box Bounds() const;
  void ClearScene() {
    meshes_.clear();
    triangles_.clear();
  }

  /// Draws the maps of the scene for `focus` and a sun direction.
  ShadowMaps Region(const glm::dvec3& to_sun, const Box& focus,
                    const ShadowMapOptions& options = {}) const;
  /// Visibility from the maps at each point of the grid.
  std::vector<float> Visibility(const ShadowMaps& maps, const ProbePlane& plane);
  std::vector<float> Visibility(const FadingShadowMaps& maps, const ProbePlane& plane);
  /// The same with `rays` rays to a uniform disc.
  std::vector<float> Truth(const ProbePlane& plane, const glm::dvec3& to_sun, int rays = 256) const;

 private:
  struct Mesh {
    gl::GlBuffer positions, indices;
    gl::GlVertexArray vertices;
    ShadowCaster caster;
  };
  struct Triangle {
    glm::dvec3 a, ab, ac;
  };
  static std::vector<float> Probe(const std::vector<std::string>& defines, const ProbePlane& plane);

  std::list<Mesh> meshes_;
  std::vector<Triangle> triangles_;
};

/// Direction to the sun from azimuth (from +y, towards +x) and elevation.
glm::dvec3 SunAt(double azimuth_deg, double elevation_deg);
Direction<Marker> AsDirection(const glm::dvec3& v);

struct Errors {
  double rmse = 0.0;           ///< Over all points.
  double penumbra_rmse = 0.0;  ///< Where 0.01 < truth < 0.99.
  double bias = 0.0;           ///< Mean of result − truth.
  double leak = 0.0;           ///< Mean result where truth < 0.001.
  double darkening = 0.0;      ///< Mean 1 − result where truth > 0.999.
  int penumbra_points = 0;
};
Errors Compare(const std::vector<float>& result, const std::vector<float>& truth);

}  // namespace pleinair::shadows
