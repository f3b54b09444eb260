#include "compositor/light/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>

#include "base/parallel_for.h"
#include "base/vector.h"
#include "compositor/light/object_distance.h"
#include "compositor/light/patch_interpolation.h"

namespace pleinair::compositor {
namespace {

// A surface is divided only if patches at least halve its number of samples.
constexpr double kWorthwhile = 0.5;
// An object with a larger share of vertices that were added for the light is not dense.
constexpr double kDenseAdded = 0.2;
// Patches widen by this factor per step until few enough remain. After `kMaxWidenings` steps, each
// surface is one patch.
constexpr double kWidening = 1.15;
constexpr int kMaxWidenings = 100;
// Separate pieces are joined if all cells use less than this share of the max. number of patches.
constexpr double kTooLoose = 0.25;
// Normals within about 25° of an axis, or of a cube's edge or corner, are similar.
constexpr double kAlikeNormals = 0.4;

using Float3 = std::array<float, 3>;

Vec3 ToVec3(const Float3& a) { return {a[0], a[1], a[2]}; }

/// Disjoint sets of vertices; the smallest vertex represents its set.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t Find(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

  void Join(std::uint32_t a, std::uint32_t b) {
    a = Find(a);
    b = Find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Index of one of 54 groups of normals: nine for each face of a cube.
std::uint32_t NormalGroup(const Float3& n) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(n[i]) > std::fabs(n[axis])) axis = i;
  }
  const float maximum = std::fabs(n[axis]);
  auto group = static_cast<std::uint32_t>(2 * axis + (n[axis] < 0.0F ? 1 : 0));
  for (const int side : {(axis + 1) % 3, (axis + 2) % 3}) {
    const double slope = maximum > 0.0F ? n[side] / maximum : 0.0;
    group = group * 3 + (slope < -kAlikeNormals ? 0 : slope > kAlikeNormals ? 2 : 1);
  }
  return group;
}

/// Divides one surface into patches.
class Divider {
 public:
  /// Patches of one width everywhere. Vertices from `single` on become patches of their own.
  Divider(const SurfaceMesh& mesh, double width_m, std::size_t single)
      : mesh_(mesh), near_edge_m_(width_m), single_(single), levels_(mesh.positions.size(), 0) {
    FindTwins();
  }
  /// Patches that grow with the distance from virtual objects.
  Divider(const SurfaceMesh& mesh, const TessellationOptions& spacing,
          const ObjectDistance& distance)
      : mesh_(mesh), near_edge_m_(spacing.near_edge_m), single_(mesh.positions.size()) {
    for (const Float3& position : mesh.positions) {
      const double growth = 1.0 + spacing.growth_per_m * distance(position) / near_edge_m_;
      levels_.push_back(static_cast<std::uint8_t>(std::min(30.0, std::log2(growth))));
    }
    FindTwins();
  }

  /// Area in units of the local patch area.
  double Area() const {
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
      const std::uint32_t* v = &mesh_.indices[i];
      const Vec3 p = ToVec3(mesh_.positions[v[0]]);
      const Vec3 twice =
          Cross(ToVec3(mesh_.positions[v[1]]) - p, ToVec3(mesh_.positions[v[2]]) - p);
      const double width_m = WidthM(v[0], 1.0);
      area += 0.5 * Norm(twice) / (width_m * width_m);
    }
    return area;
  }

  std::size_t sides() const { return mesh_.closed ? 1 : 2; }

  /// Divides into patches `scale` times as wide as the tessellation's longest edge.
  void Divide(double scale, bool hang_together) {
    scale_ = scale;
    const std::size_t size = mesh_.positions.size();
    std::vector<std::uint64_t> keys(size);
    for (std::uint32_t v = 0; v < size; ++v) keys[v] = Key(v, scale);
    Sets sets(size);
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
      if (keys[a] == keys[b] && std::max(a, b) < single_) sets.Join(a, b);
    };
    if (hang_together) {
      std::vector<std::uint64_t> cells = keys;
      std::sort(cells.begin(), cells.end());
      cells_ = static_cast<std::size_t>(std::unique(cells.begin(), cells.end()) - cells.begin());
      for (const auto& [a, b] : twins_) join(a, b);
      for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
        for (int e = 0; e < 3; ++e) join(mesh_.indices[i + e], mesh_.indices[i + (e + 1) % 3]);
      }
    } else {
      std::vector<std::uint32_t> by_key(size);
      std::iota(by_key.begin(), by_key.end(), 0U);
      std::sort(by_key.begin(), by_key.end(), [&](std::uint32_t a, std::uint32_t b) {
        return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
      });
      for (std::size_t i = 1; i < size; ++i) join(by_key[i - 1], by_key[i]);
    }
    patch_of_.resize(size);
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < size; ++v) {
      const std::uint32_t first = sets.Find(v);  // At most v, so it already has a number.
      patch_of_[v] = first == v ? count++ : patch_of_[first];
    }
    count_ = count;
  }

  void MakeOne() {
    patch_of_.assign(mesh_.positions.size(), 0);
    count_ = 1;
    cells_ = 1;
  }

  /// Number of patches on all sides; the number of vertices where patches do not pay off.
  std::size_t Cost() const { return (Worthwhile() ? count_ : patch_of_.size()) * sides(); }
  /// The same if each cell were one patch.
  std::size_t LooseCost() const { return cells_ * sides(); }

  SurfacePatches Patches(int threads) const;

 private:
  bool Worthwhile() const {
    return count_ <= kWorthwhile * static_cast<double>(patch_of_.size()) || count_ == 1;
  }

  double WidthM(std::uint32_t v, double scale) const {
    return scale * near_edge_m_ * static_cast<double>(1U << levels_[v]);
  }

  std::uint64_t Key(std::uint32_t v, double scale) const {
    const double width_m = WidthM(v, scale);
    std::uint64_t key = NormalGroup(mesh_.normals[v]) * 64ULL + levels_[v];
    for (int c = 0; c < 3; ++c) {
      const auto cell = static_cast<std::int64_t>(std::floor(mesh_.positions[v][c] / width_m));
      // Multiplicative hashing, Knuth 6.4. Cells with equal keys by chance are usually not
      // connected and then do not share a patch.
      key = (key ^ static_cast<std::uint64_t>(cell)) * 0x9E3779B97F4A7C15ULL;
      key ^= key >> 29;
    }
    return key;
  }

  /// Pairs of vertices at one place. They connect the surface even if the corners differ in normal
  /// or texture coordinates.
  void FindTwins() {
    std::vector<std::uint32_t> order(mesh_.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto& p = mesh_.positions;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return p[a] != p[b] ? p[a] < p[b] : a < b; });
    // Each vertex is paired with the next few at its place; corners have few.
    constexpr std::size_t kReach = 8;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t k = i + 1; k < std::min(order.size(), i + kReach); ++k) {
        if (p[order[i]] != p[order[k]]) break;
        twins_.push_back({order[i], order[k]});
      }
    }
  }

  void SortMembers(SurfacePatches* patches) const;
  void FindLinks(SurfacePatches* patches) const;

  const SurfaceMesh& mesh_;
  double near_edge_m_;
  std::size_t single_;
  std::vector<std::uint8_t> levels_;  // Doublings of a patch's width with distance.
  std::vector<std::array<std::uint32_t, 2>> twins_;
  std::vector<std::uint32_t> patch_of_;
  double scale_ = 1.0;
  std::uint32_t count_ = 0;
  std::size_t cells_ = 0;
};

void Divider::SortMembers(SurfacePatches* patches) const {
  patches->member_ends.assign(count_, 0);
  for (const std::uint32_t patch : patch_of_) ++patches->member_ends[patch];
  std::vector<std::uint32_t> at(count_);
  std::uint32_t sum = 0;
  for (std::uint32_t patch = 0; patch < count_; ++patch) {
    at[patch] = sum;
    sum += patches->member_ends[patch];
    patches->member_ends[patch] = sum;
  }
  patches->members.resize(patch_of_.size());
  for (std::uint32_t v = 0; v < patch_of_.size(); ++v) patches->members[at[patch_of_[v]]++] = v;
}

void Divider::FindLinks(SurfacePatches* patches) const {
  auto& links = patches->links;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from = patch_of_[a], to = patch_of_[b];
    if (from != to) links.push_back({std::min(from, to), std::max(from, to)});
  };
  for (const auto& [a, b] : twins_) add(a, b);
  for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
    for (int e = 0; e < 3; ++e) add(mesh_.indices[i + e], mesh_.indices[i + (e + 1) % 3]);
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
}

SurfacePatches Divider::Patches(int threads) const {
  SurfacePatches patches;
  if (!Worthwhile()) return patches;
  patches.count = count_;
  patches.patch_of = patch_of_;
  SortMembers(&patches);
  FindLinks(&patches);
  std::vector<double> widths_m;
  for (std::uint32_t v = 0; v < patch_of_.size(); ++v) widths_m.push_back(WidthM(v, scale_));
  ComputeInterpolationWeights(mesh_, widths_m, threads, &patches);
  return patches;
}

}  // namespace

std::vector<SurfacePatches> DividedWhereDense(const std::vector<SurfaceMesh>& surfaces,
                                              const std::vector<LightPlaces>& light_places,
                                              int threads) {
  std::vector<SurfacePatches> divided(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto& [fine_m, in_file] = light_places[i];
    const std::size_t added = surfaces[i].positions.size() - in_file;
    if (fine_m == 0.0 || static_cast<double>(added) > kDenseAdded * static_cast<double>(in_file)) {
      continue;
    }
    Divider divider(surfaces[i], fine_m, in_file);
    divider.Divide(1.0, true);
    divided[i] = divider.Patches(threads);
  }
  return divided;
}

std::size_t PatchCount(const std::vector<SurfaceMesh>& surfaces,
                       const std::vector<SurfacePatches>& divided) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const std::size_t of_side =
        divided[i].count > 0 ? divided[i].count : surfaces[i].positions.size();
    count += of_side * (surfaces[i].closed ? 1 : 2);
  }
  return count;
}

std::vector<SurfacePatches> DividedIntoPatches(const std::vector<SurfaceMesh>& surfaces,
                                               const TessellationOptions& spacing,
                                               std::size_t max_patches, int threads) {
  std::vector<SurfacePatches> divided(surfaces.size());
  std::size_t vertices = 0;
  for (const SurfaceMesh& mesh : surfaces) {
    vertices += mesh.positions.size() * (mesh.closed ? 1 : 2);
  }
  if (vertices <= max_patches) return divided;

  const ObjectDistance distance(surfaces);
  std::vector<Divider> dividers;
  double area = 0.0;
  for (const SurfaceMesh& mesh : surfaces) {
    dividers.emplace_back(mesh, spacing, distance);
    area += dividers.back().Area() * static_cast<double>(dividers.back().sides());
  }
  const auto divide_all = [&](double scale, bool hang_together) {
    ParallelFor(dividers.size(), threads,
                [&](std::size_t i) { dividers[i].Divide(scale, hang_together); });
    return std::transform_reduce(dividers.begin(), dividers.end(), std::size_t{0}, std::plus<>(),
                                 [](const Divider& divider) { return divider.Cost(); });
  };
  const auto loose_cost = [&] {
    return std::transform_reduce(dividers.begin(), dividers.end(), std::size_t{0}, std::plus<>(),
                                 [](const Divider& divider) { return divider.LooseCost(); });
  };
  // Slightly narrower than if patches were squares of one size.
  const double narrowest = 0.9 * std::sqrt(area / static_cast<double>(max_patches));
  bool fits = false;
  for (const bool hang_together : {true, false}) {
    double scale = std::max(narrowest, 1e-3);
    for (int i = 0; i < kMaxWidenings && !fits; ++i, scale *= kWidening) {
      fits = divide_all(scale, hang_together) <= max_patches;
      if (hang_together && loose_cost() < kTooLoose * static_cast<double>(max_patches)) break;
    }
    if (fits) break;
  }
  if (!fits) {
    for (Divider& divider : dividers) divider.MakeOne();
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) divided[i] = dividers[i].Patches(threads);
  return divided;
}

}  // namespace pleinair::compositor
