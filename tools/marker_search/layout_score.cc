#include "tools/marker_search/layout_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "tracker/golay/golay_code.h"
#include "tracker/pose/homography.h"

namespace pleinair::marker_search {
namespace {

using tracker::DescriptorMatch;
using tracker::DescriptorMatcher;
using tracker::sg::kEdge;
using tracker::sg::kModules;

constexpr double kPi = std::numbers::pi;
constexpr float kThreshold = 0.0002F;
/// Keypoints between these distances from the centre belong to the border. Nearer ones belong to
/// the content, farther ones to the surroundings. In modules: max(|x|, |y|).
constexpr double kInnermost = 9.0, kOutermost = 21.0;
/// Two keypoints are at the same place within the larger of these distances.
constexpr double kSamePlace = 2.0;        ///< Modules.
constexpr double kSamePlaceScales = 0.8;  ///< Relative to the keypoint's scale.
constexpr double kSameScale = 1.6, kSameTurn_rad = 0.45;
constexpr double kOtherPlace = 4.0;    ///< Modules: certainly a different place.
constexpr double kMaxDistance = 0.75;  ///< Greater descriptor distances count as no match.
/// Width of the transition between a right and a wrong match, in descriptor distance.
constexpr double kConfusion = 0.05;
constexpr double kWeakResponse = 0.0005;
/// Uncovered radius that a keypoint's description needs, in scales. The descriptor's Gaussian
/// has σ = 3.3 scales.
constexpr double kClearScales = 4.5;
/// Sum of the keypoints' worths at which half of a border is found with probability ½.
constexpr double kEnough = 2.0;
constexpr int kHalves = 8;
/// Descriptors per texture. A few suffice: a descriptor close to one texture is close to many.
constexpr int kPerTexture = 60;
constexpr double kUnit2 =
    static_cast<double>(tracker::QuantisedDescriptor::kUnit) * tracker::QuantisedDescriptor::kUnit;

double Distance(const DescriptorMatch& match) {
  return match.index == DescriptorMatch::kNone ? 2.0 : std::sqrt(match.squared_distance / kUnit2);
}

/// Halton sequence: evenly spread for any number of samples (Halton 1960).
double Halton(int index, int base) {
  double value = 0.0, digit = 1.0;
  for (int i = index; i > 0; i /= base) {
    digit /= base;
    value += digit * (i % base);
  }
  return value;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

int ImageSide(const MarkerView& view) {
  return static_cast<int>(1.4 * view.edge_px * kModules / kEdge) + 40;
}

}  // namespace

LayoutScorer::LayoutScorer(const std::vector<GreyImage>& textures, int views, std::uint64_t seed,
                           float descriptor_window_scales)
    : renderer_(textures),
      surf_({.threshold = kThreshold,
             .max_keypoints = 300,
             .bucket_px = 0,
             .descriptor_window_scales = descriptor_window_scales}) {
  RandomDraws draws(seed);
  const int begin = 20 + draws.Below(4000);
  for (int i = 0; i < views; ++i) {
    Pair pair;
    MarkerView& sought = pair.sought;
    sought.DrawConditions(static_cast<int>(textures.size()), &draws);
    sought.edge_px = 30.0 * std::pow(200.0 / 30.0, Halton(begin + i, 2));
    sought.tilt_rad = 75.0 * kRadiansPerDegree * Halton(begin + i, 3);
    sought.direction_rad = 2.0 * kPi * Halton(begin + i, 5);
    sought.roll_rad = 2.0 * kPi * Halton(begin + i, 7);
    // The template differs slightly from the query view. Templates exist at two sizes.
    MarkerView& known = pair.known;
    known.edge_px = sought.edge_px > 95.0 ? 150.0 : 60.0;
    known.tilt_rad =
        std::clamp(sought.tilt_rad + kRadiansPerDegree * draws.Uniform(-9.0, 9.0), 0.0, 1.4);
    known.direction_rad = sought.direction_rad + kRadiansPerDegree * draws.Uniform(-12.0, 12.0);
    known.word = tracker::CodewordOfNumber(draws.Below(tracker::kGolayNumbers));
    pairs_.push_back(pair);
  }
  std::vector<tracker::QuantisedDescriptor> all;
  tracker::Surf of_texture({.threshold = kThreshold,
                            .max_keypoints = kPerTexture,
                            .descriptor_window_scales = descriptor_window_scales});
  for (const GreyImage& texture : textures) {
    of_texture.Detect(texture.view(), &keypoints_);
    of_texture.Describe(&keypoints_, &descriptors_);
    std::vector<tracker::QuantisedDescriptor> some;
    tracker::Quantise(keypoints_, descriptors_, &some);
    all.insert(all.end(), some.begin(), some.end());
  }
  of_textures_.SetTemplates(all);
}

void LayoutScorer::See(const MarkerView& view, const tracker::sg::Border& border, int pair,
                       Points* points) {
  const int side = ImageSide(view);
  const Mat3 pixels = view.PixelsFromModules({0.5 * (side - 1), 0.5 * (side - 1)});
  const Mat3 modules = tracker::Adjugate(pixels);
  renderer_.Render(view, border, pixels, side, side, &picture_);
  surf_.Detect(picture_.view(), &keypoints_);
  std::erase_if(keypoints_, [&](const tracker::SurfKeypoint& k) {
    const Vec2 at = tracker::Apply(modules, {k.x, k.y});
    const double away =
        std::max(std::fabs(at.x - 0.5 * kModules), std::fabs(at.y - 0.5 * kModules));
    return away < kInnermost || away > kOutermost;
  });
  surf_.Describe(&keypoints_, &descriptors_);
  for (std::size_t i = 0; i < keypoints_.size(); ++i) {
    const tracker::SurfKeypoint& k = keypoints_[i];
    const double step = 0.25;
    const Vec2 at = tracker::Apply(modules, {k.x, k.y});
    const Vec2 right = tracker::Apply(modules, {k.x + step, k.y}) - at;
    const Vec2 down = tracker::Apply(modules, {k.x, k.y + step}) - at;
    const double c = std::cos(k.angle_rad), s = std::sin(k.angle_rad);
    BorderPoint point;
    point.modules = at;
    point.scale_modules =
        k.scale * std::sqrt(std::fabs(right.x * down.y - right.y * down.x)) / step;
    point.angle_rad = std::atan2(c * right.y + s * down.y, c * right.x + s * down.x);
    point.response = k.response;
    point.pair = pair;
    points->points.push_back(point);
    points->descriptors.push_back(tracker::Quantise(descriptors_[i], k.bright));
  }
}

void LayoutScorer::Compare() {
  constexpr int kMax = DescriptorMatcher::kMaxNeighbours;
  of_textures_.Match(sought_.descriptors, 1, &nearest_, &back_);
  for (std::size_t i = 0; i < sought_.points.size(); ++i) {
    sought_.points[i].texture = Distance(nearest_[i]);
  }
  of_border_.SetTemplates(known_.descriptors);
  of_border_.Match(sought_.descriptors, kMax, &nearest_, &back_);
  for (std::size_t i = 0; i < sought_.points.size(); ++i) {
    BorderPoint& point = sought_.points[i];
    const auto same = [&](const BorderPoint& other) {
      const double ratio = point.scale_modules / other.scale_modules;
      return ratio < kSameScale && ratio > 1.0 / kSameScale &&
             Norm(point.modules - other.modules) <
                 std::max(kSamePlace, kSamePlaceScales * point.scale_modules) &&
             std::fabs(std::remainder(point.angle_rad - other.angle_rad, 2.0 * kPi)) <
                 kSameTurn_rad;
    };
    // The distance beyond the last neighbour is unknown; the last one is its lower bound.
    point.own = 2.0;
    point.other = Distance(nearest_[i * kMax + kMax - 1]);
    for (int k = kMax; k-- > 0;) {
      const DescriptorMatch& match = nearest_[i * kMax + k];
      if (match.index == DescriptorMatch::kNone) continue;
      const BorderPoint& other = known_.points[match.index];
      if (same(other)) {
        point.own = Distance(match);
      } else if (Norm(point.modules - other.modules) > kOtherPlace) {
        point.other = Distance(match);
      }
    }
    point.repeated = std::any_of(
        known_.points.begin(), known_.points.end(),
        [&](const BorderPoint& other) { return other.pair == point.pair && same(other); });
  }
}

double LayoutScorer::Worth(const BorderPoint& point) const {
  if (point.own >= kMaxDistance) return 0.0;
  const double rival = std::min(point.other, point.texture);
  return (1.0 - point.own / kMaxDistance) / (1.0 + std::exp((point.own - rival) / kConfusion)) *
         point.response / (point.response + kWeakResponse);
}

LayoutScore LayoutScorer::Score(const tracker::sg::Border& border, int views) {
  for (Points* points : {&known_, &sought_}) {
    points->points.clear();
    points->descriptors.clear();
  }
  for (int i = 0; i < views; ++i) {
    See(pairs_[i].known, border, i, &known_);
    See(pairs_[i].sought, border, i, &sought_);
  }
  Compare();

  LayoutScore score;
  std::array<int, LayoutScore::kSizes> of_size{};
  std::array<int, LayoutScore::kTilts> of_tilt{};
  std::vector<double> responses, own, other, texture;
  int repeated = 0;
  std::size_t at = 0;
  for (int i = 0; i < views; ++i) {
    std::array<double, kHalves> halves{};
    std::array<int, 4> quadrants{};
    for (; at < sought_.points.size() && sought_.points[at].pair == i; ++at) {
      const BorderPoint& point = sought_.points[at];
      const Vec2 away = point.modules - Vec2{0.5 * kModules, 0.5 * kModules};
      if (point.repeated) {
        ++repeated;
        ++quadrants[(away.x > 0.0 ? 1 : 0) + (away.y > 0.0 ? 2 : 0)];
        responses.push_back(point.response);
        own.push_back(point.own);
        other.push_back(point.other);
        texture.push_back(point.texture);
      }
      const double worth = Worth(point);
      for (int half = 0; half < kHalves; ++half) {
        const double angle = 2.0 * kPi * half / kHalves;
        const double clear = away.x * std::cos(angle) + away.y * std::sin(angle);
        if (clear > kClearScales * point.scale_modules) halves[half] += worth;
      }
    }
    double mean = 0.0, worst = 1.0;
    for (const double sum : halves) {
      const double chance = sum * sum / (sum * sum + kEnough * kEnough);
      mean += chance / kHalves;
      worst = std::min(worst, chance);
    }
    const double total = 0.5 * (mean + worst);
    const MarkerView& view = pairs_[i].sought;
    const int size = view.edge_px < 60.0 ? 0 : view.edge_px < 100.0 ? 1 : 2;
    const int tilt = view.tilt_rad < 40.0 * kRadiansPerDegree   ? 0
                     : view.tilt_rad < 60.0 * kRadiansPerDegree ? 1
                                                                : 2;
    score.total += total / views;
    score.average_half += mean / views;
    score.worst_half += worst / views;
    score.by_size[size] += total;
    ++of_size[size];
    score.by_tilt[tilt] += total;
    ++of_tilt[tilt];
    score.worst_quadrant +=
        static_cast<double>(*std::min_element(quadrants.begin(), quadrants.end())) / views;
  }
  for (std::size_t i = 0; i < of_size.size(); ++i) score.by_size[i] /= std::max(1, of_size[i]);
  for (std::size_t i = 0; i < of_tilt.size(); ++i) score.by_tilt[i] /= std::max(1, of_tilt[i]);
  const double sought = static_cast<double>(sought_.points.size());
  score.keypoints = sought / views;
  score.repeatability = sought > 0.0 ? repeated / sought : 0.0;
  score.response = Median(responses);
  score.own_distance = Median(own);
  score.other_distance = Median(other);
  score.texture_distance = Median(texture);
  return score;
}

}  // namespace pleinair::marker_search
