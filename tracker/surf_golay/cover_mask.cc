#include "tracker/surf_golay/cover_mask.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

/// Limits of the predicted share of white well inside a shape, and of the observed one that is of
/// the other color there.
constexpr float kWhite = 0.95F, kBlack = 0.05F, kDark = 0.6F, kDarkest = 0.2F;
/// The same on edges that are reliable.
constexpr float kEdgeWhite = 0.35F, kEdgeBlack = 0.5F, kEdgeNoise = 0.1F;
/// Limits of the share of white on black. Ink is as dark in shadow as in light: what is lighter by
/// more than noise is no ink.
constexpr float kMinLight = 0.15F, kMaxLight = 0.4F, kNoises = 5.0F;
/// Standard deviation of a pixel's own square, beside the blur; reach of an edge, in standard
/// deviations.
constexpr double kPixelSigma_px = 0.29, kReachSigmas = 2.0;

}  // namespace

void CoverMask::TakeShares(const MarkerPattern& pattern, const BlockFit& fit,
                           const MarkerLight& light, ObservedPatch* observed) {
  value_ = observed->value;
  inverse_variance_ = observed->inverse_variance;
  const double middle = 0.5 * pattern.modules, per_half = 2.0 / pattern.edge_modules;
  const PlaneMap& map = fit.map();
  for (std::size_t n = 0; n < value_.size(); ++n) {
    const double white =
        light.White((map.column[n] - middle) * per_half, (map.row[n] - middle) * per_half);
    observed->value[n] =
        static_cast<float>((value_[n] / white - light.black_share) / (1.0 - light.black_share));
  }
  share_ = observed->value;
  noisy_dark_ = std::clamp(1.0F - kNoises * static_cast<float>(light.white_noise), kDarkest, kDark);
  min_light_ = std::clamp(kNoises * static_cast<float>(light.black_noise), kMinLight, kMaxLight);
}

void CoverMask::Lay(const BlockFit& fit, double blur_px, Edges edges, ObservedPatch* observed,
                    Dark darkness) {
  const float dark = darkness == Dark::kBeyondNoise ? noisy_dark_ : kDark;
  const int width = observed->rays.window.width, height = observed->rays.window.height;
  const int reach =
      1 + static_cast<int>(std::ceil(kReachSigmas * std::hypot(kPixelSigma_px, blur_px)));
  covered_.resize(share_.size());
  beside_.resize(share_.size());
  for (std::size_t n = 0; n < share_.size(); ++n) {
    const float predicted = fit.image().white[n];
    const float share = share_[n];
    covered_[n] =
        edges == Edges::kReliable
            ? (predicted > kEdgeWhite && share < dark * predicted - kEdgeNoise) ||
                  (predicted < kEdgeBlack && share > predicted + min_light_)
            : (predicted > kWhite && share < dark) || (predicted < kBlack && share > min_light_);
  }
  // Along rows, then along columns, each occluded pixel excludes those within reach.
  const auto spread = [&](const std::vector<unsigned char>& from, int count, int step, int lines,
                          int line_step, std::vector<unsigned char>* to) {
    for (int line = 0; line < lines; ++line) {
      const int first = line * line_step;
      int last = -reach - 1;
      for (int at = 0; at < count; ++at) {
        if (from[first + at * step] != 0) last = at;
        (*to)[first + at * step] = at - last <= reach;
      }
      last = count + reach;
      for (int at = count - 1; at >= 0; --at) {
        if (from[first + at * step] != 0) last = at;
        (*to)[first + at * step] |= last - at <= reach;
      }
    }
  };
  spread(covered_, width, 1, height, width, &beside_);
  spread(beside_, height, width, width, 1, &covered_);
  for (std::size_t n = 0; n < share_.size(); ++n) {
    observed->inverse_variance[n] = covered_[n] != 0 ? 0.0F : inverse_variance_[n];
  }
}

}  // namespace pleinair::tracker
