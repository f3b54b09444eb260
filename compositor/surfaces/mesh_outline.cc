#include "compositor/surfaces/mesh_outline.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace pleinair::compositor {
namespace {

// Cosine of vertex normals from which on a split vertex is a seam of texture coordinates alone.
constexpr float kSameNormal = 0.999F;

/// One vertex for each position, whichever was first.
std::vector<std::uint32_t> Welded(std::span<const glm::vec3> positions) {
  const auto key = [&](std::uint32_t i) {
    const glm::vec3 p = positions[i] + 0.0F;  // -0 becomes 0.
    return std::array{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                      std::bit_cast<std::uint32_t>(p.z)};
  };
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::tuple(key(i), i) < std::tuple(key(j), j);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// A side of a triangle, by the welded vertices at its ends.
struct Side {
  std::uint32_t low = 0, high = 0, index = 0;  // The latter: of its first corner.
  bool operator<(const Side& other) const {
    return std::tie(low, high, index) < std::tie(other.low, other.high, other.index);
  }
  bool Joins(const Side& other) const { return low == other.low && high == other.high; }
};

class OutlineSearch {
 public:
  OutlineSearch(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                std::span<const std::uint32_t> indices)
      : positions_(positions), normals_(normals), indices_(indices), welded_(Welded(positions)) {}

  std::vector<OutlineEdge> Find(bool all) const {
    const std::vector<Side> sides = Sides();
    std::vector<OutlineEdge> edges;
    edges.reserve(sides.size() / 2);
    for (std::size_t first = 0; first < sides.size();) {
      std::size_t last = first + 1;
      while (last < sides.size() && sides[last].Joins(sides[first])) ++last;
      const bool is_pair =
          last - first == 2 && Start(sides[first].index) == End(sides[first + 1].index);
      if (is_pair) {
        AddPair(sides[first].index, sides[first + 1].index, all, &edges);
      } else {
        for (std::size_t i = first; i < last; ++i) edges.push_back(EdgeAt(sides[i].index));
      }
      first = last;
    }
    return edges;
  }

 private:
  static std::size_t Next(std::size_t index) { return index % 3 == 2 ? index - 2 : index + 1; }
  std::uint32_t Start(std::size_t index) const { return welded_[indices_[index]]; }
  std::uint32_t End(std::size_t index) const { return welded_[indices_[Next(index)]]; }

  glm::dvec3 AcrossOf(std::size_t index) const {
    const glm::dvec3 a(positions_[indices_[index]]);
    return glm::cross(glm::dvec3(positions_[indices_[Next(index)]]) - a,
                      glm::dvec3(positions_[indices_[Next(Next(index))]]) - a);
  }

  std::vector<Side> Sides() const {
    std::vector<Side> sides;
    sides.reserve(indices_.size());
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      const glm::dvec3 across = AcrossOf(i - i % 3);
      if (!(glm::dot(across, across) > 0.0)) continue;
      sides.push_back(
          {std::min(Start(i), End(i)), std::max(Start(i), End(i)), static_cast<std::uint32_t>(i)});
    }
    std::sort(sides.begin(), sides.end());
    return sides;
  }

  OutlineEdge EdgeAt(std::size_t index) const {
    return {
        .a = indices_[index], .b = indices_[Next(index)], .corner = indices_[Next(Next(index))]};
  }

  bool HasOneNormal(std::uint32_t vertex, std::uint32_t other) const {
    return vertex == other || glm::dot(normals_[vertex], normals_[other]) > kSameNormal;
  }

  void AddPair(std::size_t index, std::size_t other, bool all,
               std::vector<OutlineEdge>* edges) const {
    OutlineEdge edge = EdgeAt(index);
    edge.other_corner = indices_[Next(Next(other))];
    const glm::dvec3 across = AcrossOf(index), other_across = AcrossOf(other);
    const double sizes = glm::length(across) * glm::length(other_across);
    edge.is_crease = glm::dot(across, other_across) < kAlike * sizes ||
                     !HasOneNormal(edge.a, indices_[Next(other)]) ||
                     !HasOneNormal(edge.b, indices_[other]);
    // Above the first triangle's plane the second one makes the edge concave: where one of the two
    // faces away, it lies behind the other.
    const glm::dvec3 along =
        glm::dvec3(positions_[edge.other_corner]) - glm::dvec3(positions_[edge.a]);
    const double above = glm::dot(along, across);
    const bool is_convex = above < -1e-6 * glm::length(along) * glm::length(across);
    if (all || edge.is_crease || is_convex) edges->push_back(edge);
  }

  std::span<const glm::vec3> positions_, normals_;
  std::span<const std::uint32_t> indices_;
  std::vector<std::uint32_t> welded_;
};

}  // namespace

std::vector<OutlineEdge> OutlineOf(std::span<const glm::vec3> positions,
                                   std::span<const glm::vec3> normals,
                                   std::span<const std::uint32_t> indices, bool all) {
  return OutlineSearch(positions, normals, indices).Find(all);
}

}  // namespace pleinair::compositor
