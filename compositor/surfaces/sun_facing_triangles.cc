#include "compositor/surfaces/sun_facing_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kSortedPerBlock = 16'384;

}  // namespace

SunFacingTriangles::SunFacingTriangles(const LitMesh& object)
    : is_translucent_(object.IsTranslucent()),
      indices_(object.indices),
      ends_{static_cast<int>(object.indices.size()), static_cast<int>(object.indices.size())} {
  SetNormals(object);
  has_turned_ = false;
}

void SunFacingTriangles::SetNormals(const LitMesh& object) {
  normals_.clear();
  normals_.reserve(object.normals.size());
  for (const auto& [x, y, z] : object.normals) normals_.emplace_back(x, y, z);
  has_turned_ = true;
}

float SunFacingTriangles::NormalsTurned() const {
  const std::size_t count = normals_.size();
  std::vector<float> squares((count + kSortedPerBlock - 1) / kSortedPerBlock);
  ParallelForBlocks(count, kSortedPerBlock, [&](std::size_t begin, std::size_t end) {
    float square = 0.0F;
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3 turn = normals_[i] - sorted_normals_[i];
      square = std::max(square, glm::dot(turn, turn));
    }
    squares[begin / kSortedPerBlock] = square;
  });
  return squares.empty() ? 0.0F : std::sqrt(*std::ranges::max_element(squares));
}

bool SunFacingTriangles::Sort(const glm::vec3& to_sun) {
  const bool no_sun = to_sun == glm::vec3(0.0F);
  if (sorted_for_ && no_sun == (*sorted_for_ == glm::vec3(0.0F))) {
    // Without a sun, the order does not depend on the normals.
    const float moved = no_sun ? 0.0F : glm::distance(to_sun, *sorted_for_);
    const float turned = no_sun || !has_turned_ ? 0.0F : NormalsTurned();
    if (moved + turned < 0.9F * kMargin) return false;
  }
  if (has_turned_ || sorted_normals_.empty()) sorted_normals_ = normals_;
  has_turned_ = false;
  sorted_for_ = to_sun;
  const std::size_t triangles = indices_.size() / 3;
  is_away_.resize(triangles);
  ParallelForBlocks(triangles, kSortedPerBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = indices_.begin() + static_cast<std::ptrdiff_t>(3 * i);
      is_away_[i] = std::all_of(first, first + 3, [&](std::uint32_t vertex) {
        return no_sun || (!is_translucent_ && glm::dot(normals_[vertex], to_sun) < -kMargin);
      });
    }
  });
  turned_away_.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles; ++i) {
    if (is_away_[i] != 0) {
      const auto first = indices_.begin() + static_cast<std::ptrdiff_t>(3 * i);
      turned_away_.insert(turned_away_.end(), first, first + 3);
    } else {
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) indices_[kept++] = indices_[k];
    }
  }
  ends_[0] = static_cast<int>(kept);
  std::copy(turned_away_.begin(), turned_away_.end(),
            indices_.begin() + static_cast<std::ptrdiff_t>(kept));
  return true;
}

bool SunFacingTriangles::IncludeAll() {
  sorted_for_.reset();
  const int before = std::exchange(ends_[0], static_cast<int>(indices_.size()));
  return before != ends_[0];
}

}  // namespace pleinair::compositor
