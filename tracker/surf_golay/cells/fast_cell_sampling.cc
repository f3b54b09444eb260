#include "tracker/surf_golay/cells/fast_cell_sampling.h"

#include <array>
#include <cmath>

#include "base/srgb.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr int kAlongSide = 8;  ///< Sample positions along each side of rim and quiet zone.
/// Maximum standard deviation of the quiet zone's light from a plane, as a share of it; the same of
/// the rim; maximum ratio of the rim's light to the quiet zone's that separates black and white.
constexpr float kUnevenWhite = 0.15F, kUnevenBlack = 0.12F, kBrightestBlack = 0.4F;
/// Maximum difference of a cell's share of white from black or white, and the log-likelihood ratio
/// of a plain cell (nats).
constexpr float kOffPlain = 0.36F, kPlain = 6.0F;

/// Samples linear light on the marker, bilinearly.
class Sampler {
 public:
  Sampler(ImageView<const std::uint8_t> grey, const LensGrid& lens,
          const Mat3& modules_from_undistorted)
      : grey_(grey), lens_(lens), undistorted_from_modules_(Adjugate(modules_from_undistorted)) {}

  /// False outside the image.
  bool At(double column, double row, float* light) const {
    const Vec2 pixel = lens_.PixelOfUndistorted(Apply(undistorted_from_modules_, {column, row}));
    if (!(pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < grey_.width() - 1.0 &&
          pixel.y < grey_.height() - 1.0)) {
      return false;
    }
    const std::array<float, 256>& linear = LinearFromSrgb8();
    const int x = static_cast<int>(pixel.x), y = static_cast<int>(pixel.y);
    const float fx = static_cast<float>(pixel.x - x), fy = static_cast<float>(pixel.y - y);
    const std::uint8_t* upper = grey_.row(y) + x;
    const std::uint8_t* lower = grey_.row(y + 1) + x;
    const float above = linear[upper[0]] + fx * (linear[upper[1]] - linear[upper[0]]);
    const float below = linear[lower[0]] + fx * (linear[lower[1]] - linear[lower[0]]);
    *light = above + fy * (below - above);
    return true;
  }

 private:
  ImageView<const std::uint8_t> grey_;
  const LensGrid& lens_;
  const Mat3 undistorted_from_modules_;
};

/// White light as a plane over the marker, and black as a share of it.
struct PlainLight {
  float middle = 0.0F, by_column = 0.0F, by_row = 0.0F, black_share = 0.0F;
  float White(double column, double row) const {
    constexpr double kMiddle = 0.5 * sg::kModules;
    return middle + by_column * static_cast<float>(column - kMiddle) +
           by_row * static_cast<float>(row - kMiddle);
  }
};

std::optional<PlainLight> LightOf(const Sampler& sampler) {
  constexpr int kSamples = 4 * kAlongSide;
  constexpr double kWhite = 0.5 * sg::kQuiet, kBlack = 1.5 * sg::kQuiet;  // Centres of the rings.
  struct Sample {
    double column, row;
    float light;
  };
  std::array<Sample, kSamples> white, black;
  const auto ring = [&](double first, std::array<Sample, kSamples>* samples) {
    constexpr double kMiddle = 0.5 * sg::kModules;
    for (int k = 0; k < kSamples; ++k) {
      // Rotated by a quarter turn from side to side: the samples are as symmetric as the marker.
      double along = ((k / 4 + 0.5) / kAlongSide - 0.5) * sg::kEdge, across = first - kMiddle;
      for (int turn = 0; turn < k % 4; ++turn) {
        const double before = along;
        along = -across;
        across = before;
      }
      Sample& sample = (*samples)[k];
      sample.column = kMiddle + along;
      sample.row = kMiddle + across;
      if (!sampler.At(sample.column, sample.row, &sample.light)) return false;
    }
    return true;
  };
  if (!ring(kWhite, &white) || !ring(kBlack, &black)) return std::nullopt;
  PlainLight light;
  double sum = 0.0, by_column = 0.0, by_row = 0.0, squares = 0.0;
  for (const Sample& s : white) {
    const double u = s.column - 0.5 * sg::kModules, v = s.row - 0.5 * sg::kModules;
    sum += s.light;
    by_column += u * s.light;
    by_row += v * s.light;
    squares += u * u;
  }
  light.middle = static_cast<float>(sum / kSamples);
  light.by_column = static_cast<float>(by_column / squares);
  light.by_row = static_cast<float>(by_row / squares);
  float off2 = 0.0F;
  for (const Sample& s : white) {
    const float ratio = s.light / light.White(s.column, s.row) - 1.0F;
    off2 += ratio * ratio / kSamples;
  }
  if (!(off2 < kUnevenWhite * kUnevenWhite)) return std::nullopt;
  float ratios = 0.0F, squared = 0.0F;
  for (const Sample& s : black) {
    const float ratio = s.light / light.White(s.column, s.row);
    ratios += ratio / kSamples;
    squared += ratio * ratio / kSamples;
  }
  light.black_share = ratios;
  if (!(ratios < kBrightestBlack && squared - ratios * ratios < kUnevenBlack * kUnevenBlack)) {
    return std::nullopt;
  }
  return light;
}

}  // namespace

std::optional<CellLikelihoods> SampleCellsFast(ImageView<const std::uint8_t> grey,
                                               const LensGrid& lens,
                                               const Mat3& modules_from_undistorted) {
  const Sampler sampler(grey, lens, modules_from_undistorted);
  const std::optional<PlainLight> light = LightOf(sampler);
  if (!light) return std::nullopt;
  CellLikelihoods likelihoods{};
  for (int row = 0; row < sg::kCells; ++row) {
    for (int column = 0; column < sg::kCells; ++column) {
      // The centre of the cell and the centres of its quarters.
      constexpr std::array<Vec2, 5> kPlaces{{{2, 2}, {1, 1}, {3, 1}, {1, 3}, {3, 3}}};
      float share = 0.0F;
      for (const Vec2& place : kPlaces) {
        const double c = sg::kQuiet + sg::kContent + sg::kCell * (column + 0.25 * place.x);
        const double r = sg::kQuiet + sg::kContent + sg::kCell * (row + 0.25 * place.y);
        float observed = 0.0F;
        if (!sampler.At(c, r, &observed)) return std::nullopt;
        share += (observed / light->White(c, r) - light->black_share) /
                 ((1.0F - light->black_share) * static_cast<float>(kPlaces.size()));
      }
      const float nearest = share > 0.5F ? 1.0F : 0.0F;
      if (!(std::fabs(share - nearest) < kOffPlain)) return std::nullopt;
      const int cell = sg::CodeCell(column, row);
      if (cell < 0) {
        if (nearest == 0.0F) return std::nullopt;  // The central cell is always white.
        continue;
      }
      likelihoods[cell] = kPlain * (2.0F * nearest - 1.0F);
    }
  }
  return likelihoods;
}

}  // namespace pleinair::tracker
