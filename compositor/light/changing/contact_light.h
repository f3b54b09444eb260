#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/light/changing/surroundings.h"
#include "compositor/light/lit_mesh.h"

namespace pleinair::compositor {

/// Estimates how bodies that change alter the indirect illumination of still surfaces near them.
/// The bodies occlude light and reflect light. N rays fill the cone that holds the bodies, of solid
/// angle Ω. At a vertex of normal n, the irradiance changes by
///
///     ΔE = Ω/N Σ max(n · ω, 0) (L_body(ω) − L_behind(ω)).
///
/// The sum is over the rays that end at a body. L_behind is the sky's radiance where only the sky
/// is behind the body. Elsewhere it is the mean of what the vertex receives.
///
/// Beside bodies at rest, other rays find the sunlight that still surfaces no longer reflect to the
/// vertex, because a body shades them. It fades in: few rays of so strong a light would flicker.
/// Where a body moves again, it fades out: to 7 % in half a second at 25 frames a second.
class ContactLight {
 public:
  /// `still`: the surfaces in their light without the bodies. It must outlive this object.
  explicit ContactLight(std::span<const LitMesh> still);

  /// Measures the sphere around the bodies. `moved_m`: how far the vertex that moved most has
  /// moved.
  void FollowBodies(std::span<const LitMesh> bodies, double moved_m);
  /// Traces rays from the next `vertices` vertices that are near the bodies; two of three are those
  /// next to them.
  void Refresh(const Surroundings& surroundings, std::size_t vertices);
  /// Number of vertices near the bodies.
  std::size_t size() const { return near_.size(); }
  /// Forgets all rays: the next ones count alone.
  void Forget();
  /// Lets the missing sunlight that fades out go on by a frame.
  void FadeOut();
  /// Sets the light of `drawn`, copies of the still surfaces, to that with the bodies.
  void Light(std::span<LitMesh> drawn);

  static constexpr double kReach_m = 3.0;
  static constexpr std::uint32_t kRays = 16;

 private:
  struct Sphere {
    Vec3 centre;
    double radius_m = 0.0;
  };
  struct Place {
    std::uint32_t mesh = 0, vertex = 0;
  };
  struct Change {
    std::array<float, 3> light{}, sunlight{};
    std::array<float, 3> shaded{};  ///< Reflected sunlight that is missing.
    std::array<float, 3> fading{};  ///< The same of the bodies' last rest.
    float rays = 0.0F, shaded_rays = 0.0F;
    std::uint32_t round = 0;
    double path_m = 0.0;  ///< ContactLight::path_m_ at the last refresh.
  };
  /// A part of `near_`, whose vertices take turns.
  struct Turns {
    std::size_t begin = 0, size = 0, next = 0;
  };
  void Refresh(const Surroundings& surroundings, std::size_t vertices, Turns* turns);
  void Trace(const Surroundings& surroundings, std::size_t index);
  /// Starts to fade the missing sunlight where the bodies have moved since a vertex' last refresh.
  void FadeShaded();
  /// Traces `change.shaded` at a vertex.
  static void TraceShaded(const Surroundings& surroundings, Vec3 origin, Vec3 normal,
                          std::uint32_t seed, Change* change);

  std::span<const LitMesh> still_;
  std::vector<std::vector<Change>> changes_;  // By mesh and vertex.
  std::vector<Place> near_, left_;            // Those that are near, and those that were.
  std::array<Turns, 2> turns_;                // Next to the bodies, and farther off.
  Sphere bodies_, near_of_;
  double path_m_ = 0.0;  // How far the bodies have moved.
};

}  // namespace pleinair::compositor
