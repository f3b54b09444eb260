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

/// Fog along a line of sight, by the partitions that the view is cut into (Kolivand & Sunar 2014,
/// step 7 of Z-GaF): what the air does up to each split. shaders/aerial_fog.glsl goes evenly from
/// one split to the next, so that nothing jumps there.
struct FogSplits {
  static constexpr int kMax = shadows::kMaxPartitions + 1;
  std::array<float, kMax> distance_m{};  ///< Ascending; the last is repeated to the end.
  std::array<glm::vec3, kMax> optical_depth{};
  std::array<glm::vec3, kMax> inscattered{};  ///< cd/m².

  /// What a metre of air adds at the most, wherever it lies on the way.
  glm::vec3 MaxLightPerMetre() const;
};

/// The sky's aerial perspective, kept by direction and distance so that it outlives the sky model:
/// L(s) = L₀ τ(s) + L_in(s), Preetham, Shirley & Smits 1999, §4, with τ and L_in of
/// sky::SkyModel::AirTo. Deviation from the paper, which sets start, end and density of OpenGL's
/// fog by hand for each partition: here the day's air decides, and a partition may have more or
/// less.
class AerialFog {
 public:
  AerialFog() = default;
  /// `marker_from_world` as Composer::SetLight.
  AerialFog(const sky::SkyModel& day, const Mat3& marker_from_world);

  /// `towards` in marker coordinates; `splits` ascending distances, 2…kMax of them. `densities`
  /// scale the air of each partition (the first from the eye on): 1 as the sky has it, 0 none. What
  /// lies behind thicker air is seen as through so much more of the same, which keeps it
  /// continuous.
  FogSplits Along(const glm::dvec3& towards, std::span<const double> splits,
                  std::span<const double> densities) const;

 private:
  struct Air {
    glm::dvec3 extinction{0.0}, inscattered{0.0};  // Mean a metre up to a distance.
  };
  Air At(const glm::dvec3& towards, double distance_m) const;

  std::vector<Air> table_;  // Distances within elevations within azimuths; empty: no air.
  Mat3 world_from_marker_;
};

}  // namespace pleinair::compositor
