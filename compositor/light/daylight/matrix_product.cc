#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "compositor/light/daylight/coefficient_matrix.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compositor/light/daylight/matrix_product.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::compositor {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
constexpr int kP = CoefficientMatrix::kPatches, kL = CoefficientMatrix::kLanes;

/// Multiplies one block of vertices. `weights`: radiances of the patches, ordered by chunk, then by
/// plane. The direct plane has three weights, one per channel. `dark`: chunks whose weights are all
/// 0.
void MultiplyBlock(const std::uint8_t* codes, const float* scales, const float* weights,
                   const std::uint8_t* dark, int chunks, float* out) {
  const hn::CappedTag<float, CoefficientMatrix::kLanes> floats;
  const hn::Rebind<std::int32_t, decltype(floats)> ints;
  const hn::Rebind<std::uint8_t, decltype(floats)> bytes;
  const int lanes = static_cast<int>(hn::Lanes(floats));
  for (int lane = 0; lane < kL; lane += lanes) {
    const auto load = [&](const std::uint8_t* tile, int patch) {
      return hn::ConvertTo(floats, hn::PromoteTo(ints, hn::LoadU(bytes, tile + patch * kL + lane)));
    };
    auto red = hn::Zero(floats), green = hn::Zero(floats), blue = hn::Zero(floats);
    const std::uint8_t* tile = codes;
    const float* scale = scales + lane;
    const float* weight = weights;
    for (int chunk = 0; chunk < chunks; ++chunk, tile += CoefficientMatrix::kPlanes * kP * kL,
             scale += CoefficientMatrix::kPlanes * kL, weight += 6 * kP) {
      if (dark[chunk] != 0) continue;
      auto r = hn::Zero(floats), g = r, b = r;
      for (int patch = 0; patch < kP; ++patch) {
        const auto value = load(tile, patch);
        r = hn::MulAdd(value, hn::Set(floats, weight[patch]), r);
        g = hn::MulAdd(value, hn::Set(floats, weight[kP + patch]), g);
        b = hn::MulAdd(value, hn::Set(floats, weight[2 * kP + patch]), b);
      }
      const auto straight = hn::LoadU(floats, scale);
      red = hn::MulAdd(r, straight, red);
      green = hn::MulAdd(g, straight, green);
      blue = hn::MulAdd(b, straight, blue);
      const auto reflected = [&](int plane) {
        const std::uint8_t* at = tile + plane * kP * kL;
        const float* w = weight + (2 + plane) * kP;
        auto even = hn::Zero(floats), odd = even;
        for (int patch = 0; patch < kP; patch += 2) {
          even = hn::MulAdd(load(at, patch), hn::Set(floats, w[patch]), even);
          odd = hn::MulAdd(load(at, patch + 1), hn::Set(floats, w[patch + 1]), odd);
        }
        return hn::Mul(hn::Add(even, odd), hn::LoadU(floats, scale + plane * kL));
      };
      red = hn::Add(red, reflected(1));
      green = hn::Add(green, reflected(2));
      blue = hn::Add(blue, reflected(3));
    }
    hn::StoreU(red, floats, out + lane);
    hn::StoreU(green, floats, out + kL + lane);
    hn::StoreU(blue, floats, out + 2 * kL + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::compositor
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::compositor {
namespace {

constexpr int kWeightPlanes = 6;

/// Radiances in the order of the product: direct red, green, blue of the sky, then reflected red,
/// green, blue of sky and sun.
std::vector<float> Weights(std::span<const LinearRgb> sky, std::span<const LinearRgb> sun,
                           int chunks) {
  constexpr int kP = CoefficientMatrix::kPatches;
  std::vector<float> weights(static_cast<std::size_t>(chunks) * kWeightPlanes * kP);
  for (std::size_t i = 0; i < sky.size(); ++i) {
    float* at = weights.data() + i / kP * kWeightPlanes * kP + i % kP;
    const LinearRgb both = sky[i] + sun[i];
    const double values[] = {sky[i].r, sky[i].g, sky[i].b, both.r, both.g, both.b};
    for (int plane = 0; plane < kWeightPlanes; ++plane) {
      at[plane * kP] = static_cast<float>(values[plane]);
    }
  }
  return weights;
}

}  // namespace

HWY_EXPORT(MultiplyBlock);

CoefficientMatrix::CoefficientMatrix(std::size_t vertices, int patches)
    : vertices_(vertices), patches_(patches) {
  const std::size_t tiles = blocks() * static_cast<std::size_t>(chunks()) * kPlanes;
  codes_.resize(tiles * kPatches * kLanes);
  scales_.resize(tiles * kLanes);
}

void CoefficientMatrix::Set(std::size_t vertex, int chunk, int plane,
                            std::span<const float, kPatches> values) {
  const std::size_t tile = Tile(vertex / kLanes, chunk, plane), lane = vertex % kLanes;
  const float largest = *std::max_element(values.begin(), values.end());
  const float scale = largest / 255.0F;
  scales_[tile * kLanes + lane] = scale;
  for (int i = 0; i < kPatches; ++i) {
    codes_[(tile * kPatches + static_cast<std::size_t>(i)) * kLanes + lane] =
        scale > 0.0F ? static_cast<std::uint8_t>(std::lround(std::max(0.0F, values[i]) / scale))
                     : std::uint8_t{0};
  }
}

float CoefficientMatrix::At(std::size_t vertex, int patch, int plane) const {
  const std::size_t tile = Tile(vertex / kLanes, patch / kPatches, plane);
  const std::size_t lane = vertex % kLanes;
  const auto row = static_cast<std::size_t>(patch % kPatches);
  return scales_[tile * kLanes + lane] * codes_[(tile * kPatches + row) * kLanes + lane];
}

void CoefficientMatrix::Multiply(std::span<const LinearRgb> sky, std::span<const LinearRgb> sun,
                                 std::span<std::array<float, 3>> irradiance,
                                 std::size_t first) const {
  CHECK_EQ(sky.size(), static_cast<std::size_t>(patches_));
  CHECK_EQ(sun.size(), sky.size());
  const std::size_t end = first + irradiance.size();
  CHECK_LE(end, vertices_);
  const std::vector<float> weights = Weights(sky, sun, chunks());
  // The sun lies in few patches. A chunk without light needs no reading.
  std::vector<std::uint8_t> dark(static_cast<std::size_t>(chunks()));
  for (std::size_t chunk = 0; chunk < dark.size(); ++chunk) {
    const auto first_weight =
        weights.begin() + static_cast<std::ptrdiff_t>(chunk * kWeightPlanes * kPatches);
    dark[chunk] = std::all_of(first_weight, first_weight + kWeightPlanes * kPatches,
                              [](float weight) { return weight == 0.0F; })
                      ? 1
                      : 0;
  }
  std::array<float, 3 * kLanes> sums;
  for (std::size_t block = first / kLanes; block * kLanes < end; ++block) {
    const std::size_t tile = Tile(block, 0, 0);
    HWY_DYNAMIC_DISPATCH(MultiplyBlock)
    (codes_.data() + tile * kPatches * kLanes, scales_.data() + tile * kLanes, weights.data(),
     dark.data(), chunks(), sums.data());
    const std::size_t last = std::min(end, (block + 1) * kLanes);
    for (std::size_t vertex = std::max(first, block * kLanes); vertex < last; ++vertex) {
      const std::size_t lane = vertex % kLanes;
      irradiance[vertex - first] = {sums[lane], sums[kLanes + lane], sums[2 * kLanes + lane]};
    }
  }
}

void CoefficientMatrix::MultiplyScalar(std::span<const LinearRgb> sky,
                                       std::span<const LinearRgb> sun,
                                       std::span<std::array<float, 3>> irradiance) const {
  for (std::size_t vertex = 0; vertex < vertices_; ++vertex) {
    LinearRgb sum;
    for (int patch = 0; patch < patches_; ++patch) {
      const auto index = static_cast<std::size_t>(patch);
      const LinearRgb reflected{At(vertex, patch, 1), At(vertex, patch, 2), At(vertex, patch, 3)};
      sum = sum + sky[index] * At(vertex, patch, 0) + (sky[index] + sun[index]) * reflected;
    }
    irradiance[vertex] = {static_cast<float>(sum.r), static_cast<float>(sum.g),
                          static_cast<float>(sum.b)};
  }
}

}  // namespace pleinair::compositor
#endif  // HWY_ONCE
