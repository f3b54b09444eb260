#include "compositor/loose_leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

constexpr double kLargestLeafM = 0.5;
constexpr std::size_t kFewestLeaves = 50;
// Of the leaves' size: how far they lie about at least in the direction in which they do least.
constexpr double kLeastSpread = 0.5;

/// Which vertices hang together by triangles or lie in one place, as a forest.
class Pieces {
 public:
  explicit Pieces(const SurfaceMesh& surface) : parent_(surface.positions.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::map<std::array<float, 3>, std::uint32_t> first_at;
    for (std::uint32_t v = 0; v < parent_.size(); ++v) {
      Join(v, first_at.try_emplace(surface.positions[v], v).first->second);
    }
    for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
      Join(surface.indices[i], surface.indices[i + 1]);
      Join(surface.indices[i], surface.indices[i + 2]);
    }
  }

  /// One vertex that stands for the whole piece.
  std::uint32_t Of(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) {
      parent_[vertex] = parent_[parent_[vertex]];
      vertex = parent_[vertex];
    }
    return vertex;
  }

 private:
  void Join(std::uint32_t a, std::uint32_t b) { parent_[Of(a)] = Of(b); }

  std::vector<std::uint32_t> parent_;
};

struct Box {
  std::array<double, 3> least, most;
  Box() {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
  void Include(const std::array<float, 3>& point) {
    for (int k = 0; k < 3; ++k) {
      least[k] = std::min<double>(least[k], point[k]);
      most[k] = std::max<double>(most[k], point[k]);
    }
  }
  double LongestSide() const {
    return std::max({most[0] - least[0], most[1] - least[1], most[2] - least[2]});
  }
  Vec3 Middle() const {
    return Vec3{least[0] + most[0], least[1] + most[1], least[2] + most[2]} * 0.5;
  }
};

/// How far points lie about in the direction in which they do least: its standard deviation, or
/// less, down to 1/√3 of it where all directions are alike. 0 in a plane.
double LeastSpread(const std::vector<Vec3>& points) {
  const double share = 1.0 / static_cast<double>(points.size());
  Vec3 mean;
  for (const Vec3 point : points) mean = mean + point * share;
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for (const Vec3 point : points) {
    const Vec3 d = point - mean;
    xx += share * d.x * d.x;
    yy += share * d.y * d.y;
    zz += share * d.z * d.z;
    xy += share * d.x * d.y;
    yz += share * d.y * d.z;
    zx += share * d.z * d.x;
  }
  // One over the sum of the variances' inverses along the principal axes: determinant over the sum
  // of the principal minors.
  const double minors = xx * yy - xy * xy + yy * zz - yz * yz + zz * xx - zx * zx;
  const double determinant =
      xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
  return minors > 0.0 ? std::sqrt(std::max(0.0, determinant / minors)) : 0.0;
}

/// The triangles that `keep` names, with the vertices that they use.
template <typename Keep>
SurfaceMesh PartOf(const SurfaceMesh& surface, const Keep& keep) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  SurfaceMesh part;
  part.is_phantom = surface.is_phantom;
  part.placed_model = surface.placed_model;
  part.material = surface.material;
  part.role = surface.role;
  part.closed = surface.closed;
  std::vector<std::uint32_t> number(surface.positions.size(), kUnused);
  for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3) {
    if (!keep(surface.indices[i])) continue;
    for (std::size_t k = i; k < i + 3; ++k) {
      const std::uint32_t vertex = surface.indices[k];
      if (number[vertex] == kUnused) {
        number[vertex] = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(surface.positions[vertex]);
        part.normals.push_back(surface.normals[vertex]);
        if (!surface.uvs.empty()) part.uvs.push_back(surface.uvs[vertex]);
      }
      part.indices.push_back(number[vertex]);
    }
  }
  return part;
}

}  // namespace

std::optional<SurfaceMesh> TakeLooseLeaves(SurfaceMesh* surface) {
  if (!surface->is_phantom || surface->closed || surface->indices.size() < 3 * kFewestLeaves) {
    return {};
  }
  Pieces pieces(*surface);
  std::map<std::uint32_t, Box> boxes;
  for (const std::uint32_t vertex : surface->indices) {
    boxes[pieces.Of(vertex)].Include(surface->positions[vertex]);
  }
  std::vector<std::uint8_t> small(surface->positions.size());
  std::vector<double> sizes;
  std::vector<Vec3> middles;
  for (const auto& [piece, box] : boxes) {
    if (box.LongestSide() > kLargestLeafM) continue;
    small[piece] = 1;
    sizes.push_back(box.LongestSide());
    middles.push_back(box.Middle());
  }
  if (sizes.size() < kFewestLeaves || LeastSpread(middles) < kLeastSpread * Median(sizes)) {
    return {};
  }
  SurfaceMesh leaves =
      PartOf(*surface, [&](std::uint32_t vertex) { return small[pieces.Of(vertex)] != 0; });
  *surface = PartOf(*surface, [&](std::uint32_t vertex) { return small[pieces.Of(vertex)] == 0; });
  return leaves;
}

}  // namespace pleinair::compositor
