#include "tracker/picture_target/target_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tracker/picture_target/picture_pyramid.h"
#include "tracker/picture_target/target_views.h"

namespace pleinair::tracker {
namespace {

constexpr int kCoverageCells = 6, kContrastCells = 8;
/// Keypoints are similar if they are at most this near, in unit descriptors, and at least this far
/// apart, in target units.
constexpr double kSameDescriptor = 0.13, kElsewhere = 4.0;
constexpr double kMinContrast = 0.03;  ///< Standard deviation, in shares of white.
constexpr int kManyFeatures = 100;     ///< Number of features beyond which a target gains nothing.
constexpr double kNearlySquare = 1.15;
constexpr double kDoubtfulTurn = 0.8;
constexpr int kThumbnail = 48;

using Thumbnail = std::array<double, kThumbnail * kThumbnail>;

/// Reduces the image to a thumbnail, without keeping its shape.
Thumbnail ThumbnailOf(const Image<float>& picture) {
  Thumbnail thumbnail{};
  std::array<int, kThumbnail * kThumbnail> counts{};
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const int at =
          y * kThumbnail / picture.height() * kThumbnail + x * kThumbnail / picture.width();
      thumbnail[at] += picture(x, y);
      ++counts[at];
    }
  }
  for (std::size_t i = 0; i < thumbnail.size(); ++i) thumbnail[i] /= std::max(1, counts[i]);
  return thumbnail;
}

double Correlation(const Thumbnail& a, const Thumbnail& b) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i];
    sb += b[i];
    saa += a[i] * a[i];
    sbb += b[i] * b[i];
    sab += a[i] * b[i];
  }
  const double n = static_cast<double>(a.size());
  const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  return va > 1e-9 && vb > 1e-9 ? (sab - sa * sb / n) / std::sqrt(va * vb) : 0.0;
}

double TurnedLikeness(const PictureTarget& target, const PicturePyramid& pyramid) {
  const Thumbnail upright = ThumbnailOf(pyramid.level(0));
  Thumbnail turned{};
  double likeness = -1.0;
  for (int quarter = 1; quarter < 4; ++quarter) {
    const double aspect = target.width_m / target.height_m;
    if (quarter != 2 && std::max(aspect, 1.0 / aspect) > kNearlySquare) continue;
    for (int y = 0; y < kThumbnail; ++y) {
      for (int x = 0; x < kThumbnail; ++x) {
        const int last = kThumbnail - 1;
        const int from_x = quarter == 1 ? y : quarter == 2 ? last - x : last - y;
        const int from_y = quarter == 1 ? last - x : quarter == 2 ? last - y : x;
        turned[y * kThumbnail + x] = upright[from_y * kThumbnail + from_x];
      }
    }
    likeness = std::max(likeness, Correlation(upright, turned));
  }
  return likeness;
}

/// Share of cells with enough contrast.
double ContrastShare(const Image<float>& picture) {
  int telling = 0;
  for (int row = 0; row < kContrastCells; ++row) {
    for (int column = 0; column < kContrastCells; ++column) {
      double sum = 0.0, squares = 0.0, count = 0.0;
      for (int y = picture.height() * row / kContrastCells;
           y < picture.height() * (row + 1) / kContrastCells; ++y) {
        for (int x = picture.width() * column / kContrastCells;
             x < picture.width() * (column + 1) / kContrastCells; ++x) {
          sum += picture(x, y);
          squares += picture(x, y) * picture(x, y);
          count += 1.0;
        }
      }
      const double mean = sum / count;
      telling += squares / count - mean * mean > kMinContrast * kMinContrast ? 1 : 0;
    }
  }
  return static_cast<double>(telling) / (kContrastCells * kContrastCells);
}

/// Rates the frontal view's keypoints: their number, their distribution and how many are similar.
void RateFeatures(const PictureTarget& target, TargetQuality* quality) {
  std::vector<Vec2> places;
  std::vector<const QuantisedDescriptor*> descriptors;
  std::array<bool, kCoverageCells * kCoverageCells> covered{};
  for (std::size_t k = 0; k < target.keypoints.size(); ++k) {
    const TargetKeypoint& keypoint = target.keypoints[k];
    if (keypoint.view != kFrontalView) continue;
    places.push_back(PlaceOnTarget(target, keypoint));
    descriptors.push_back(&target.descriptors[k]);
    const auto cell = [](double at) {
      return std::clamp(static_cast<int>(at * kCoverageCells / kTargetSide), 0, kCoverageCells - 1);
    };
    covered[cell(places.back().y) * kCoverageCells + cell(places.back().x)] = true;
  }
  quality->features = static_cast<int>(places.size());
  quality->coverage =
      static_cast<double>(std::count(covered.begin(), covered.end(), true)) / covered.size();
  const double near = kSameDescriptor * QuantisedDescriptor::kUnit;
  int repeated = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (descriptors[i]->bright != descriptors[j]->bright ||
          Norm(places[i] - places[j]) < kElsewhere) {
        continue;
      }
      double square = 0.0;
      for (int k = 0; k < 64; ++k) {
        const double difference = descriptors[i]->values[k] - descriptors[j]->values[k];
        square += difference * difference;
      }
      if (square > near * near) continue;
      ++repeated;
      break;
    }
  }
  quality->repetition =
      places.empty() ? 0.0 : static_cast<double>(repeated) / static_cast<double>(places.size());
}

}  // namespace

TargetQuality RateTarget(const PictureTarget& target) {
  TargetQuality quality;
  RateFeatures(target, &quality);
  const PicturePyramid pyramid(target.picture.view());
  quality.contrast = ContrastShare(pyramid.level(0));
  quality.turned_likeness = TurnedLikeness(target, pyramid);
  // The factors multiply: none compensates for another.
  struct Factor {
    double good;  ///< 0…1.
    const char* advice;
  };
  const double turn = std::clamp((1.0 - quality.turned_likeness) / (1.0 - kDoubtfulTurn), 0.0, 1.0);
  std::array<Factor, 5> factors{
      {{std::min(1.0, quality.features / static_cast<double>(kManyFeatures)),
        "it has few features: choose a picture with more fine detail and sharp edges"},
       {std::min(1.0, quality.coverage / 0.75),
        "large parts of it are even: crop them away, or choose a picture that has detail "
        "everywhere, so that it is found when a part is covered"},
       {std::min(1.0, quality.contrast / 0.6),
        "large parts of it have little contrast: raise it before printing"},
       {std::clamp((1.0 - quality.repetition) / 0.6, 0.0, 1.0),
        "its features look alike: choose a picture without a pattern that repeats"},
       {turn, "it looks nearly the same turned round: add something that shows which way is up"}}};
  std::stable_sort(factors.begin(), factors.end(),
                   [](const Factor& a, const Factor& b) { return a.good < b.good; });
  double product = 1.0;
  for (const Factor& factor : factors) {
    product *= factor.good;
    if (factor.good < 0.8) quality.advice.emplace_back(factor.advice);
  }
  quality.score = static_cast<int>(std::lround(100.0 * product));
  return quality;
}

}  // namespace pleinair::tracker
