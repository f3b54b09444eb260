#include "compositor/surfaces/draw_reduction.h"

#include <algorithm>
#include <cstdint>

#include "base/parallel_for.h"

namespace pleinair::compositor {

namespace {

// Two pixels of the coarse grid (passes/coarse_ratio.h). Some pixels of the grid show what only
// fine tiles draw: interpolation beside such a tile must not read them.
constexpr int kCoarseReach_px = 8;
// Pixels whose ratio and blur take the software renderer about as long as drawing a triangle once
// more. They decide on speed alone.
constexpr int kPixelsPerTriangle = 6, kBlurredPixelsPerTriangle = 2;
constexpr std::size_t kMovedVerticesPerBlock = 16'384;

}  // namespace

bool SunOnPhantoms::IsAsGoodAs(const SunOnPhantoms& other) const {
  // Relative. The objects' effect on skylight hardly depends on the sun.
  constexpr float kSameSun = 0.02F;
  return window == other.window && whole == other.whole &&
         glm::all(glm::lessThanEqual(glm::abs(normal_lux - other.normal_lux),
                                     kSameSun * other.normal_lux));
}

void DrawReduction::Use(const DrawReductions& reductions) {
  if (reductions == reductions_) return;
  reductions_ = reductions;
  Invalidate();
}

void DrawReduction::Clear() {
  phantoms_.clear();
  objects_.clear();
  object_positions_.clear();
}

void DrawReduction::AddPhantom(const LitMesh& phantom) { phantoms_.emplace_back(phantom); }

void DrawReduction::AddObject(const LitMesh& object) {
  objects_.emplace_back(object);
  object_positions_.emplace_back();
  SetShape(objects_.size() - 1, object);
}

void DrawReduction::SetShape(std::size_t object, const LitMesh& mesh) {
  objects_[object].SetNormals(mesh);
  auto& positions = object_positions_[object];
  positions.clear();
  positions.reserve(mesh.positions.size());
  for (const auto& [x, y, z] : mesh.positions) positions.emplace_back(x, y, z);
}

SunFootprint DrawReduction::FootprintOf(const SunWindow& window,
                                        std::span<const glm::mat4> objects_moved) const {
  if (window.side == 0.0F) return {};
  SunFootprint footprint(window);
  std::vector<glm::vec2> at;
  for (std::size_t object = 0; object < objects_.size(); ++object) {
    const std::vector<glm::vec3>& positions = object_positions_[object];
    at.resize(positions.size());
    ParallelForBlocks(at.size(), kMovedVerticesPerBlock, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        at[i] = window.At(glm::vec3(objects_moved[object] * glm::vec4(positions[i], 1.0F)));
      }
    });
    footprint.Include(at, objects_[object].indices());
  }
  return footprint;
}

void DrawReduction::SortPhantoms(const SunOnPhantoms& sun,
                                 std::span<const glm::mat4> objects_moved) {
  const bool whole = sun.whole || !reductions_.sun_footprint;
  const SunFootprint footprint = whole ? SunFootprint() : FootprintOf(sun.window, objects_moved);
  for (AffectedTriangles& phantom : phantoms_) {
    phantom.Sort(sun.window, footprint, sun.normal_lux, reductions_);
  }
  sorted_for_ = sun;
}

AffectedTiles DrawReduction::TilesOf(const SceneProjection& image,
                                     std::span<const glm::mat4> objects_moved) const {
  AffectedTiles tiles{ImageTiles(image), ImageTiles(image), ImageTiles(image)};
  if (!reductions_.affected_tiles) {
    tiles.objects.IncludeAll();
    tiles.fine.IncludeAll();
    tiles.all.IncludeAll();
    return tiles;
  }
  for (std::size_t object = 0; object < objects_.size(); ++object) {
    SceneProjection moved = image;
    moved.clip_from_position *= objects_moved[object];
    tiles.objects.Include(moved, object_positions_[object], objects_[object].indices());
  }
  tiles.all.Include(tiles.objects);
  tiles.fine.Include(tiles.objects);
  SceneProjection fine = image;
  fine.spread_px += kCoarseReach_px;
  int triangles = 0;
  for (const AffectedTriangles& phantom : phantoms_) {
    const auto resolved = static_cast<std::size_t>(
        phantom.ends()[image.resolves_sunlit_sky ? AffectedTriangles::kSunlitSky
                                                 : AffectedTriangles::kSun]);
    const auto affected = static_cast<std::size_t>(phantom.ends()[AffectedTriangles::kLinearSky]);
    tiles.all.Include(image, phantom.positions(), phantom.indices().first(affected));
    tiles.fine.Include(fine, phantom.positions(), phantom.indices().first(resolved));
    triangles += phantom.ends()[AffectedTriangles::kNothing] / 3;
  }
  const int per_triangle = image.spread_px > 0 ? kBlurredPixelsPerTriangle : kPixelsPerTriangle;
  const int saved_px =
      tiles.all.Without(tiles.fine).Count() * ImageTiles::kSide_px * ImageTiles::kSide_px;
  if (!reductions_.coarse_sky_ratio || saved_px < per_triangle * triangles) {
    tiles.fine.Include(tiles.all);
  }
  return tiles;
}

bool DrawReduction::SortObject(std::size_t object, const glm::vec3& to_sun) {
  // Without a sun, Sort() is right with or without the reduction.
  if (!reductions_.sun_facing_triangles && to_sun != glm::vec3(0.0F)) {
    return objects_[object].IncludeAll();
  }
  return objects_[object].Sort(to_sun);
}

float DrawReduction::MaxLinearChangeFarFrom(const glm::vec3& eye_m) const {
  float maximum = 0.0F;
  for (const AffectedTriangles& phantom : phantoms_) {
    maximum = std::max(maximum, phantom.MaxLinearChangeFarFrom(eye_m));
  }
  return maximum;
}

}  // namespace pleinair::compositor
