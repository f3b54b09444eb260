#include "compositor/light/patch_interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "base/parallel_for.h"
#include "base/vector.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;
using InterpolationWeight = SurfacePatches::InterpolationWeight;

Vec3 ToVec3(const Float3& a) { return {a[0], a[1], a[2]}; }

/// Solves for the first unknown's row of the inverse of a symmetric, positive definite matrix.
template <std::size_t N>
std::array<double, N> FirstRowOfInverse(std::array<std::array<double, N>, N> a) {
  // Cholesky, a = L Lᵀ.
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      double sum = a[i][k];
      for (std::size_t m = 0; m < k; ++m) sum -= a[i][m] * a[k][m];
      a[i][k] = sum / a[k][k];
    }
    double sum = a[i][i];
    for (std::size_t m = 0; m < i; ++m) sum -= a[i][m] * a[i][m];
    a[i][i] = std::sqrt(std::max(sum, 1e-12));
  }
  std::array<double, N> x{};
  for (std::size_t i = 0; i < N; ++i) {
    double sum = i == 0 ? 1.0 : 0.0;
    for (std::size_t m = 0; m < i; ++m) sum -= a[i][m] * x[m];
    x[i] = sum / a[i][i];
  }
  for (std::size_t i = N; i-- > 0;) {
    for (std::size_t m = i + 1; m < N; ++m) x[i] -= a[m][i] * x[m];
    x[i] /= a[i][i];
  }
  return x;
}

/// Computes the interpolation weights of each vertex.
class Sharer {
 public:
  /// `widths_m`: nominal patch width at each vertex.
  Sharer(const SurfaceMesh& mesh, const SurfacePatches& patches,
         const std::vector<double>& widths_m)
      : mesh_(mesh), patches_(patches) {
    FindMeans();
    FindReaches(widths_m);
    FindNear();
  }

  void Add(std::uint32_t vertex, std::vector<InterpolationWeight>* interpolation_weights) const {
    const std::uint32_t own = patches_.patch_of[vertex];
    const Vec3 position = ToVec3(mesh_.positions[vertex]), normal = ToVec3(mesh_.normals[vertex]);
    const TangentFrame frame(Normalized(normal));
    std::array<std::array<double, kUnknowns>, kMax> rows{};
    std::array<double, kMax> weights{};
    std::array<std::uint32_t, kMax> chosen{};
    std::size_t size = 0;
    double sum = 0.0;
    const auto add = [&](std::uint32_t patch) {
      const Vec3 aside = means_[patch].position - position, turn = means_[patch].normal - normal;
      const double reach = reaches_[patch];
      const double far = Dot(aside, aside) / (reach * reach) + Dot(turn, turn) / kReachOfNormals;
      if (far >= 1.0 || size == kMax) return;
      // Decreases smoothly to zero at the patch's reach.
      weights[size] = (1.0 - far) * (1.0 - far);
      sum += weights[size];
      rows[size] = {1.0,
                    Dot(aside, frame.tangent) / reach,
                    Dot(aside, frame.bitangent) / reach,
                    turn.x,
                    turn.y,
                    turn.z};
      chosen[size++] = patch;
    };
    for (std::uint32_t i = first_near_[own]; i < first_near_[own + 1]; ++i) add(near_[i]);
    if (sum < 1e-6) {
      interpolation_weights->push_back({own, 1.0F});
      return;
    }
    std::array<std::array<double, kUnknowns>, kUnknowns> normal_matrix{};
    for (std::size_t k = 0; k < size; ++k) {
      for (std::size_t i = 0; i < kUnknowns; ++i) {
        for (std::size_t m = 0; m < kUnknowns; ++m) {
          normal_matrix[i][m] += weights[k] * rows[k][i] * rows[k][m];
        }
      }
    }
    for (std::size_t i = 1; i < kUnknowns; ++i) {
      normal_matrix[i][i] += sum * (i < 3 ? kDoubtInPlace : kDoubtInNormal);
    }
    const auto fit = FirstRowOfInverse(normal_matrix);
    for (std::size_t k = 0; k < size; ++k) {
      const double value = std::inner_product(fit.begin(), fit.end(), rows[k].begin(), 0.0);
      interpolation_weights->push_back({chosen[k], static_cast<float>(weights[k] * value)});
    }
  }

 private:
  static constexpr std::size_t kUnknowns = 6, kMax = 48;
  // Patches whose mean normals differ by more than 60° from a vertex' get no weight (chord² = 1).
  static constexpr double kReachOfNormals = 1.0;
  // In patch widths: a smaller reach makes the fit unstable, a larger one blurs.
  static constexpr double kReach = 1.7;
  // Regularisation against slopes caused by noise. The gathered light has 3 % noise. It changes by
  // about a third from patch to patch, and by about all of it with the normal.
  static constexpr double kDoubtInPlace = 0.005, kDoubtInNormal = 0.002;

  struct Mean {
    Vec3 position, normal;
  };

  void FindMeans() {
    means_.resize(patches_.count);
    std::uint32_t first = 0;
    for (std::uint32_t patch = 0; patch < patches_.count; ++patch) {
      const std::uint32_t last = patches_.member_ends[patch];
      for (std::uint32_t i = first; i < last; ++i) {
        const std::uint32_t v = patches_.members[i];
        means_[patch].position = means_[patch].position + ToVec3(mesh_.positions[v]);
        means_[patch].normal = means_[patch].normal + ToVec3(mesh_.normals[v]);
      }
      const double share = 1.0 / (last - first);
      means_[patch] = {means_[patch].position * share, means_[patch].normal * share};
      first = last;
    }
  }

  /// Computes each patch's reach from its nominal width, because some patches are slivers.
  void FindReaches(const std::vector<double>& widths_m) {
    spans_.assign(patches_.count, 0.0);
    reaches_.assign(patches_.count, 0.0);
    for (std::uint32_t v = 0; v < patches_.patch_of.size(); ++v) {
      const std::uint32_t patch = patches_.patch_of[v];
      spans_[patch] =
          std::max(spans_[patch], Norm(ToVec3(mesh_.positions[v]) - means_[patch].position));
      reaches_[patch] = std::max(kReach * widths_m[v], 1.2 * spans_[patch]);
    }
  }

  /// Finds the connected patches that reach a vertex of each patch, itself first.
  void FindNear() {
    std::vector<std::vector<std::uint32_t>> beside(patches_.count);
    for (const auto& [a, b] : patches_.links) {
      beside[a].push_back(b);
      beside[b].push_back(a);
    }
    first_near_.push_back(0);
    std::vector<std::uint32_t> seen_for(patches_.count, ~0U);
    for (std::uint32_t patch = 0; patch < patches_.count; ++patch) {
      const std::size_t first = near_.size();
      near_.push_back(patch);
      seen_for[patch] = patch;
      for (std::size_t at = first; at < near_.size(); ++at) {
        for (const std::uint32_t other : beside[near_[at]]) {
          if (seen_for[other] == patch) continue;
          seen_for[other] = patch;
          const double apart_m = Norm(means_[other].position - means_[patch].position);
          if (apart_m < reaches_[other] + spans_[patch]) near_.push_back(other);
        }
      }
      first_near_.push_back(static_cast<std::uint32_t>(near_.size()));
    }
  }

  const SurfaceMesh& mesh_;
  const SurfacePatches& patches_;
  std::vector<Mean> means_;
  std::vector<double> reaches_, spans_;
  std::vector<std::uint32_t> near_, first_near_;
};

}  // namespace

void ComputeInterpolationWeights(const SurfaceMesh& mesh, const std::vector<double>& widths_m,
                                 int threads, SurfacePatches* patches) {
  const std::size_t vertices = patches->patch_of.size();
  const Sharer sharer(mesh, *patches, widths_m);
  constexpr std::size_t kBlock = 4096;
  struct Block {
    std::vector<InterpolationWeight> interpolation_weights;
    std::vector<std::uint32_t> ends;
  };
  std::vector<Block> blocks((vertices + kBlock - 1) / kBlock);
  ParallelFor(blocks.size(), threads, [&](std::size_t b) {
    const std::size_t last = std::min(vertices, (b + 1) * kBlock);
    for (std::size_t v = b * kBlock; v < last; ++v) {
      sharer.Add(static_cast<std::uint32_t>(v), &blocks[b].interpolation_weights);
      blocks[b].ends.push_back(static_cast<std::uint32_t>(blocks[b].interpolation_weights.size()));
    }
  });
  for (Block& block : blocks) {
    const auto base = static_cast<std::uint32_t>(patches->interpolation_weights.size());
    for (const std::uint32_t end : block.ends) patches->interpolation_ends.push_back(base + end);
    patches->interpolation_weights.insert(patches->interpolation_weights.end(),
                                          block.interpolation_weights.begin(),
                                          block.interpolation_weights.end());
    block = {};
  }
}

std::vector<Float3> SurfacePatches::Interpolate(std::span<const Float3> light) const {
  std::vector<Float3> values(interpolation_ends.size());
  std::uint32_t at = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    Float3 sum{};
    for (; at < interpolation_ends[v]; ++at) {
      for (int c = 0; c < 3; ++c)
        sum[c] += interpolation_weights[at].weight * light[interpolation_weights[at].patch][c];
    }
    for (int c = 0; c < 3; ++c) values[v][c] = std::max(0.0F, sum[c]);
  }
  return values;
}

}  // namespace pleinair::compositor
