#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/light/changing/changing_mesh.h"
#include "compositor/light/changing/sky_harmonics.h"
#include "compositor/light/changing/surroundings.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/surface_patches.h"

namespace pleinair::compositor {

/// Light on bodies that change their shape, without direct sunlight. A probe, one per vertex or per
/// patch of vertices (surface_patches.h), keeps a visibility cone and the light that surfaces
/// reflect to it. Rays refresh a few probes at a time; older rays count less the more the probe has
/// moved. The result depends on the sequence of shapes alone, not on time or threads.
class BodyProbes {
 public:
  /// `bodies` must outlive this object.
  explicit BodyProbes(std::span<const ChangingMesh> bodies);

  /// Traces kRays rays from each of the next `probes` probes, in turn; all of them where there are
  /// fewer.
  void Refresh(const Surroundings& surroundings, std::size_t probes);
  std::size_t size() const { return probes_.size(); }
  /// Forgets all rays: the next ones count alone.
  void Forget();
  /// Takes the light of the nearest of other probes that face the same way, as that of few rays.
  void StartFrom(const BodyProbes& others);

  /// One triangle per three patches that meet, for rays. Empty for a mesh of
  /// ChangingMesh::DrawnMeshes() with few triangles.
  Surroundings::Coarse CoarseTriangles(std::size_t drawn) const;

  /// Sets the light of the meshes of ChangingMesh::DrawnMeshes(), of all bodies in order.
  void Light(const SkyHarmonics& sky, std::span<LitMesh> drawn) const;

  static constexpr std::uint32_t kRays = 16;

 private:
  /// One side of a surface.
  struct Side {
    const SurfaceMesh* surface = nullptr;
    bool back = false;
    std::shared_ptr<const SurfacePatches> groups;  // Null: each vertex is a probe.
    // By vertex: index of the first corner of one of its triangles.
    std::shared_ptr<const std::vector<std::uint32_t>> first_corners;
    std::size_t first_probe = 0;
  };
  struct Probe {
    std::array<float, 3> bent{};  // Mean direction of rays to the sky; its length is below 1.
    float open = 0.0F;            // Share of rays to the sky.
    std::array<float, 3> reflected{}, sunlight{};  // Irradiance, and its part from the sun.
    std::array<float, 3> sky{};                    // Irradiance by the rays to the sky.
    float rays = 0.0F;                             // Effective number; 0: none outside of bodies.
    std::array<float, 3> place{}, normal{};        // At the last refresh.
    std::uint32_t side = 0, round = 0;
  };
  /// Irradiance, and its part from the sun.
  struct Received {
    std::array<float, 3> light{}, sunlight{};
  };

  void AddSide(Side side, std::size_t probes);
  void Trace(const Surroundings& surroundings, std::size_t index);
  void FillBuried();
  static Received LightOf(const SkyHarmonics& sky, const Probe& probe);
  static Received LightAt(const Side& side, std::size_t vertex, std::span<const Received> probes);

  std::vector<Side> sides_;
  std::vector<Probe> probes_;
  std::size_t next_ = 0;
};

}  // namespace pleinair::compositor
