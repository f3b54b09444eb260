#include "compositor/light/foliage.h"

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

constexpr double kMaxLeaf_m = 0.5;
constexpr std::size_t kMinLeafCount = 50;
// Min. spread of the leaves in their narrowest direction, as a multiple of the median leaf size.
constexpr double kMinSpread = 0.5;
// Roof tiles and bricks around a corner face as their neighbours do. Pieces are tested against
// their nearest neighbour; foliage needs this share that is turned by more than 37°. For randomly
// oriented leaves the share is 0.8.
constexpr double kSameWay = 0.8, kMinTurnedShare = 0.4;
constexpr std::size_t kPiecesAsked = 200;

/// Disjoint-set forest of vertices that are connected by triangles or coincide.
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

  /// The representative vertex of a piece.
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

/// A piece's bounding box, and the area vector of its largest triangle.
struct Extent {
  std::array<double, 3> minimum, maximum;
  Vec3 twice_area;
  Extent() {
    minimum.fill(std::numeric_limits<double>::infinity());
    maximum.fill(-std::numeric_limits<double>::infinity());
  }
  void Include(const std::array<Vec3, 3>& triangle) {
    for (const Vec3 p : triangle) {
      const std::array<double, 3> point{p.x, p.y, p.z};
      for (int k = 0; k < 3; ++k) {
        minimum[k] = std::min(minimum[k], point[k]);
        maximum[k] = std::max(maximum[k], point[k]);
      }
    }
    const Vec3 area = Cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    if (Dot(area, area) > Dot(twice_area, twice_area)) twice_area = area;
  }
  double LongestSide() const {
    return std::max({maximum[0] - minimum[0], maximum[1] - minimum[1], maximum[2] - minimum[2]});
  }
  Vec3 Middle() const {
    return Vec3{minimum[0] + maximum[0], minimum[1] + maximum[1], minimum[2] + maximum[2]} * 0.5;
  }
};

/// Spread of points in their narrowest direction. It is the standard deviation there, or less, down
/// to 1/√3 of it if all directions are alike. 0 in a plane.
double MinSpread(const std::vector<Vec3>& points) {
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
  // 1 / sum of the inverse variances along the principal axes = determinant / sum of the principal
  // minors.
  const double minors = xx * yy - xy * xy + yy * zz - yz * yz + zz * xx - zx * zx;
  const double determinant =
      xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
  return minors > 0.0 ? std::sqrt(std::max(0.0, determinant / minors)) : 0.0;
}

/// Share of the pieces that are turned away from their nearest neighbour.
double ShareTurned(const std::vector<Vec3>& middles, const std::vector<Vec3>& areas) {
  const std::size_t asked = std::min(kPiecesAsked, middles.size());
  std::size_t turned = 0;
  for (std::size_t k = 0; k < asked; ++k) {
    const std::size_t i = k * middles.size() / asked;
    std::size_t nearest = i;
    double minimum = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < middles.size(); ++j) {
      const Vec3 apart = middles[j] - middles[i];
      if (j == i || Dot(apart, apart) >= minimum) continue;
      minimum = Dot(apart, apart);
      nearest = j;
    }
    const double both = Norm(areas[i]) * Norm(areas[nearest]);
    turned += std::fabs(Dot(areas[i], areas[nearest])) < kSameWay * both ? 1 : 0;
  }
  return static_cast<double>(turned) / static_cast<double>(asked);
}

/// Copies the triangles that `keep` selects, with their vertices.
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
        if (!surface.details.empty()) part.details.push_back(surface.details[vertex]);
      }
      part.indices.push_back(number[vertex]);
    }
  }
  return part;
}

}  // namespace

std::optional<SurfaceMesh> ExtractFoliage(SurfaceMesh* surface) {
  if (!surface->is_phantom || surface->closed || surface->indices.size() < 3 * kMinLeafCount) {
    return {};
  }
  Pieces pieces(*surface);
  std::map<std::uint32_t, Extent> extents;
  for (std::size_t i = 0; i + 2 < surface->indices.size(); i += 3) {
    std::array<Vec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [x, y, z] = surface->positions[surface->indices[i + k]];
      triangle[k] = {x, y, z};
    }
    extents[pieces.Of(surface->indices[i])].Include(triangle);
  }
  std::vector<std::uint8_t> small(surface->positions.size());
  std::vector<double> sizes;
  std::vector<Vec3> middles, areas;
  for (const auto& [piece, extent] : extents) {
    if (extent.LongestSide() > kMaxLeaf_m) continue;
    small[piece] = 1;
    sizes.push_back(extent.LongestSide());
    middles.push_back(extent.Middle());
    areas.push_back(extent.twice_area);
  }
  if (sizes.size() < kMinLeafCount || MinSpread(middles) < kMinSpread * Median(sizes) ||
      ShareTurned(middles, areas) < kMinTurnedShare) {
    return {};
  }
  SurfaceMesh leaves =
      PartOf(*surface, [&](std::uint32_t vertex) { return small[pieces.Of(vertex)] != 0; });
  *surface = PartOf(*surface, [&](std::uint32_t vertex) { return small[pieces.Of(vertex)] == 0; });
  return leaves;
}

}  // namespace pleinair::compositor
