#include "compositor/lens/disc_scatter.h"

#include <algorithm>
#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compositor/lens/disc_scatter.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::compositor::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kSide = BlockLayers::kSide_px, kValues = BlockLayers::kValues;

/// Adds the steps of each piece's kernel to the rows of its layer. `sums`: by layer.
void AddSteps(const SurfacePiece* pieces, std::size_t count, const DiscKernels& kernels,
              float* const* sums) {
  const hn::CappedTag<float, kValues> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePiece& piece = pieces[i];
    const DiscKernel& kernel = kernels.Of(piece.kernel);
    for (const DiscKernel::Row& row : kernel.rows) {
      const int y = piece.y + row.y;
      if (y < 0 || y >= kSide) continue;
      float* const line = sums[piece.layer] + static_cast<std::ptrdiff_t>(y) * kSide * kValues;
      for (int s = row.first; s < row.first + row.count; ++s) {
        const DiscKernel::Step& step = kernel.steps[static_cast<std::size_t>(s)];
        const int x = piece.x + step.x;
        if (x >= kSide) break;
        // What rises beside the block has risen at its first column.
        float* const at = line + static_cast<std::ptrdiff_t>(std::max(x, 0)) * kValues;
        const auto rise = hn::Set(d, step.rise);
        for (int value = 0; value < kValues; value += lanes) {
          hn::StoreU(hn::MulAdd(rise, hn::LoadU(d, piece.values + value), hn::LoadU(d, at + value)),
                     d, at + value);
        }
      }
    }
  }
}

/// Sums along each row.
void SumRows(float* sums) {
  const hn::CappedTag<float, kValues> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int y = 0; y < kSide; ++y) {
    float* const line = sums + static_cast<std::ptrdiff_t>(y) * kSide * kValues;
    for (int value = 0; value < kValues; value += lanes) {
      auto sum = hn::Zero(d);
      for (int x = 0; x < kSide; ++x) {
        float* const at = line + static_cast<std::ptrdiff_t>(x) * kValues + value;
        sum = hn::Add(sum, hn::LoadU(d, at));
        hn::StoreU(sum, d, at);
      }
    }
  }
}

}  // namespace
}  // namespace pleinair::compositor::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::compositor {

namespace {
HWY_EXPORT(AddSteps);
HWY_EXPORT(SumRows);
}  // namespace

BlockLayers::BlockLayers(std::span<const SurfacePiece> pieces, const DiscKernels& kernels) {
  std::array<float*, kLensLayers> sums{};
  for (const SurfacePiece& piece : pieces) {
    const auto layer = static_cast<std::size_t>(piece.layer);
    if (sums[layer] != nullptr) continue;
    sums_[layer].resize(static_cast<std::size_t>(kSide_px) * kSide_px * kValues);
    sums[layer] = sums_[layer].data();
  }
  HWY_DYNAMIC_DISPATCH(AddSteps)(pieces.data(), pieces.size(), kernels, sums.data());
  for (std::size_t layer = 0; layer < sums.size(); ++layer) {
    if (sums[layer] == nullptr) continue;
    layers_.push_back(static_cast<int>(layer));
    HWY_DYNAMIC_DISPATCH(SumRows)(sums[layer]);
  }
}

}  // namespace pleinair::compositor
#endif
