#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "shadows/shadow_uniforms.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Fog along a line of sight, accumulated up to each split between the view's partitions (Kolivand
/// & Sunar 2014, step 7 of Z-GaF). shaders/aerial_fog.glsl interpolates between the splits, so that
/// the fog is continuous.
struct FogSplits {
  static constexpr int kMax = shadows::kMaxPartitions + 1;
  std::array<float, kMax> distance_m{};  ///< Ascending; the last is repeated to the end.
  std::array<glm::vec3, kMax> optical_depth{};
  std::array<glm::vec3, kMax> inscattered{};  ///< cd/m².

  /// Maximum light that a metre of air adds, anywhere along the line of sight.
  glm::vec3 MaxLightPerMetre() const;
};

/// The sky's aerial perspective, tabulated by direction and distance so that it outlives the sky
/// model.
///
/// L(s) = L₀ τ(s) + L_in(s), Preetham, Shirley & Smits 1999, §4, with τ and L_in of
/// sky::SkyModel::AirTo.
///
/// Deviation from Kolivand & Sunar, who set start, end and density of OpenGL's fog by hand for each
/// partition. Here the sky model determines the air, and each partition may scale its density.
class AerialFog {
 public:
  AerialFog() = default;
  /// `marker_from_world` as Composer::SetLight.
  AerialFog(const sky::SkyModel& day, const Mat3& marker_from_world);

  /// Evaluates the fog along `towards`, in marker coordinates. `splits` are ascending distances,
  /// 2…kMax of them. `densities` scale the air of each partition, the first from the eye on: 1 as
  /// in the sky model, 0 none. The extra air of a denser partition also counts for everything
  /// behind it, which keeps the fog continuous.
  FogSplits Along(const glm::dvec3& towards, std::span<const double> splits,
                  std::span<const double> densities) const;

 private:
  struct Air {
    glm::dvec3 extinction{0.0}, inscattered{0.0};  // Mean per metre up to a distance.
  };
  Air At(const glm::dvec3& towards, double distance_m) const;

  std::vector<Air> table_;  // Distances within elevations within azimuths; empty: no air.
  Mat3 world_from_marker_;
};

}  // namespace pleinair::compositor
