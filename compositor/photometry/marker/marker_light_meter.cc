#include "compositor/photometry/marker/marker_light_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/quantile.h"
#include "compositor/photometry/linear_sampling.h"

namespace pleinair::compositor {
namespace {

constexpr int kPairsPerSide = 40;
// Sun visibility beyond which a point is not in a penumbra.
constexpr double kInSun = 0.98, kInShade = 0.02;
constexpr int kClippedCode = 252, kBlackClippedCode = 243;
// Minimum ratio of white to black on a marker that is not inverted. The reflectances' ratio is 20.
// Veiling glare that reduces it to this value leaves nothing to measure.
constexpr double kClearlyBrighter = 1.25;
// Minimum ratio of the light on the two sides of a shadow edge on the marker.
constexpr double kShadowContrast = 1.6;
constexpr double kShadowShare = 0.15;
// Relative spread of a marker's light at which leaves dapple it. Between the lower and the upper
// bound the weight of the brightest surface samples rises, so that consecutive frames differ
// little.
constexpr double kDappled = 0.10, kHardlyDappled = 0.08, kSurelyDappled = 0.12;
// Minimum number of sunlit pairs beside a shadow across the marker.
constexpr int kMinBrightPairs = 6;
// Share of the pairs that count as the brightest.
constexpr double kBrightest = 0.2;
// Maximum share of clipped whites for the use of the whites: their median is then known. The limit
// for the brightest pairs is lower, because the brightest unclipped ones are no longer the
// brightest.
constexpr double kMaxClippedShare = 0.45, kMaxClippedShareOfBrightest = 0.2;
// Share of darkest whites that show uneven light where other whites are clipped. Second: their
// distance below the mean of a normal distribution, in standard deviations.
constexpr double kDarkest = 0.05, kDarkestSigmas = 1.645;
// Pairs on either side over which blacks are averaged.
constexpr std::size_t kNeighbours = 2;
constexpr double kMinBand_px = 3.0;
// Standard error of a median over that of a mean, for a normal distribution: sqrt(π / 2).
constexpr double kMedianError = 1.2533;

// Sky radiance scale beside the sun that is allowed for in the shadow search: haze makes shadows
// shallower.
constexpr double kHaze = 2.0;
// Share of pairs that are white on neither side. From this share on, an object covers the marker.
constexpr double kCovered = 0.1;

using Rgb = std::array<double, 3>;

double Sum(const Rgb& value) { return value[0] + value[1] + value[2]; }

/// Threshold between a darker and a brighter group of values, if a shadow edge explains the groups;
/// otherwise nothing. Two-means on logarithms.
std::optional<double> ShadowThreshold(const std::vector<double>& values) {
  double low = std::log(Quantile(values, 0.05)), high = std::log(Quantile(values, 0.95));
  std::size_t dark = 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const double middle = (low + high) / 2;
    double sum_low = 0.0, sum_high = 0.0;
    dark = 0;
    for (const double value : values) {
      const double v = std::log(value);
      if (v < middle) {
        sum_low += v;
        ++dark;
      } else {
        sum_high += v;
      }
    }
    if (dark == 0 || dark == values.size()) return std::nullopt;
    low = sum_low / static_cast<double>(dark);
    high = sum_high / static_cast<double>(values.size() - dark);
  }
  const double dark_share = static_cast<double>(dark) / static_cast<double>(values.size());
  if (high - low < std::log(kShadowContrast) || dark_share < kShadowShare ||
      dark_share > 1 - kShadowShare) {
    return std::nullopt;
  }
  return std::exp((low + high) / 2);
}

}  // namespace

MarkerLightMeter::MarkerLightMeter(const scene::MarkerReflectance& marker,
                                   const PhantomRays& phantoms, const sky::SkyModel& day,
                                   const Mat3& marker_from_world, const CameraResponse& response)
    : marker_(marker), response_(response) {
  const Vec3 to_sun = marker_from_world * day.ToSun().xyz;
  const Vec3 normal{0, 0, 1};
  const LinearRgb sun = day.SunNormalIrradiance();
  const double cosine = std::max(0.0, Dot(normal, to_sun));
  const double half = marker.size_m / 2;
  // The middle of each band. Without a known white margin there is still a quiet zone around every
  // marker.
  const double margin_m = (marker.board_size_m - marker.size_m) / 2;
  const double white_m = (margin_m > 0.0 ? margin_m : marker.black_band_m) / 2;
  const double black_m = marker.black_band_m / 2;
  int lit = 0;
  std::vector<Point<Marker>> edges;
  for (int side = 0; side < 4; ++side) {
    const double c = std::array{1.0, 0.0, -1.0, 0.0}[side];
    const double s = std::array{0.0, 1.0, 0.0, -1.0}[side];
    const auto on_side = [&](double along, double outwards) {
      const double x = along, y = half + outwards;
      return Point<Marker>{{c * x - s * y, s * x + c * y, 0.0}};
    };
    // Away from the corners, where the neighbouring side's bands are near.
    const double reach = half - marker.black_band_m;
    for (int i = 0; i < kPairsPerSide; ++i) {
      const double along = reach * (2.0 * (i + 0.5) / kPairsPerSide - 1.0);
      Pair pair{on_side(along, white_m), on_side(along, -black_m), {}, 0.0};
      const double v_white = phantoms.SunVisibility(pair.white, to_sun);
      const double v_black = phantoms.SunVisibility(pair.black, to_sun);
      const bool in_sun = v_white > kInSun && v_black > kInSun;
      if (!in_sun && !(v_white < kInShade && v_black < kInShade)) continue;
      pair.sun_visibility = in_sun ? 1.0 : 0.0;
      lit += in_sun;
      edges.push_back(on_side(along, 0.0));
      pairs_.push_back(pair);
    }
  }
  const std::vector<LinearRgb> ambient = phantoms.Ambient(edges, normal, day, marker_from_world);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    pairs_[i].irradiance = ambient[i] + sun * (cosine * pairs_[i].sun_visibility);
  }
  in_sun_ = lit >= kMinimumPairs;
  if (!ambient.empty() && cosine > kGrazingMarkerCosine) {
    const LinearRgb needs_airlight = ambient[ambient.size() / 2] * kHaze;
    const auto depth = [&](double of_sun, double of_ambient) {
      return of_ambient > 0.0 ? std::log1p(of_sun * cosine / of_ambient) : 0.0;
    };
    shadow_depth_ = {depth(sun.r, needs_airlight.r), depth(sun.g, needs_airlight.g),
                     depth(sun.b, needs_airlight.b)};
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (in_sun_ && pairs_[i].sun_visibility < 0.5) continue;
    places_.push_back(edges[i]);
    light_on_marker_ = light_on_marker_ + pairs_[i].irradiance;
  }
  if (!places_.empty())
    light_on_marker_ = light_on_marker_ * (1.0 / static_cast<double>(places_.size()));
  sunlit_share_ =
      pairs_.empty() ? 0.0 : static_cast<double>(lit) / static_cast<double>(pairs_.size());
}

MarkerLightMeter::Samples MarkerLightMeter::SamplesIn(
    CameraImageView image, const CameraModel& camera,
    const Transform<Camera, Marker>& camera_from_marker) const {
  Samples samples;
  samples.pairs.reserve(pairs_.size());
  const double albedo_step = marker_.albedo_white - marker_.albedo_black;
  for (const Pair& pair : pairs_) {
    const Point<Camera> white_in_camera = camera_from_marker * pair.white;
    const Point<Camera> black_in_camera = camera_from_marker * pair.black;
    if (white_in_camera.xyz.z <= 0.0 || black_in_camera.xyz.z <= 0.0) continue;
    const Vec2 white_px = ProjectToPixel(camera, white_in_camera);
    const Vec2 black_px = ProjectToPixel(camera, black_in_camera);
    if (Norm(white_px - black_px) < kMinBand_px) continue;
    const auto white = SampleLinear(image, white_px, response_);
    const auto black = SampleLinear(image, black_px, response_);
    if (!white || !black) continue;
    const auto clipped_at = [&](int c, int code) {
      return static_cast<double>(response_.Linear(c)[code]);
    };
    const Rgb irradiance{pair.irradiance.r, pair.irradiance.g, pair.irradiance.b};
    const double all_clipped =
        clipped_at(0, kClippedCode) + clipped_at(1, kClippedCode) + clipped_at(2, kClippedCode);
    if (Sum(*white) < kClearlyBrighter * Sum(*black) && Sum(*white) < all_clipped) {
      ++samples.contrary;
      continue;
    }
    Sample sample{};
    sample.in_sun = pair.sun_visibility > 0.5;
    sample.seen = {
        pair.white,
        {(*white)[0] - (*black)[0], (*white)[1] - (*black)[1], (*white)[2] - (*black)[2]},
        Sum(*black)};
    for (int c = 0; c < 3; ++c) {
      const double per_albedo = irradiance[c] / std::numbers::pi;
      const double difference = (*white)[c] - (*black)[c];
      const bool clipped = (*white)[c] >= clipped_at(c, kClippedCode);
      const bool black_counts = (*black)[c] < clipped_at(c, kBlackClippedCode) && (*black)[c] > 0.0;
      if (clipped) {
        sample.white_scale[c] = std::numeric_limits<double>::infinity();
      } else {
        sample.white_scale[c] = difference > 0.0 ? difference / (albedo_step * per_albedo) : NAN;
      }
      sample.black_scale[c] =
          black_counts ? (*black)[c] / (marker_.albedo_black * per_albedo) : NAN;
      sample.level += (*white)[c] / per_albedo;
    }
    if (sample.level > 0.0) samples.pairs.push_back(sample);
  }
  return samples;
}

std::optional<MarkerShadowEdge> MarkerLightMeter::FindShadow(
    CameraImageView image, const CameraModel& camera,
    const Transform<Camera, Marker>& camera_from_marker) const {
  const Samples samples = SamplesIn(image, camera, camera_from_marker);
  if (static_cast<double>(samples.contrary) >=
      kCovered * static_cast<double>(samples.pairs.size())) {
    return std::nullopt;
  }
  std::vector<MarkerPair> usable;
  usable.reserve(samples.pairs.size());
  for (const Sample& sample : samples.pairs) {
    if (std::isfinite(Sum(sample.white_scale))) usable.push_back(sample.seen);
  }
  return FindMarkerShadowEdge(usable, shadow_depth_,
                              marker_.albedo_black / (marker_.albedo_white - marker_.albedo_black));
}

std::vector<double> MarkerLightMeter::ScalesBy(const std::vector<Sample>& pairs, Rgb Sample::*by,
                                               std::size_t channel) {
  std::vector<double> values;
  values.reserve(pairs.size());
  for (const Sample& pair : pairs) {
    const double value = (pair.*by)[channel];
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

std::optional<MarkerLightMeter::ChannelScale> MarkerLightMeter::MedianOf(
    const std::vector<double>& values, int min_count) {
  if (static_cast<int>(values.size()) < min_count) return std::nullopt;
  const double exposure_scale = Median(values);
  if (!(exposure_scale > 0.0) || !std::isfinite(exposure_scale)) return std::nullopt;
  const double low = Quantile(values, 0.25), high = Quantile(values, 0.75);
  // Clipped whites are only known to be brighter than the rest. They are assumed to be as far from
  // the median as the darker ones.
  const double between = std::isfinite(high) ? high - low : 2.0 * (exposure_scale - low);
  // Interquartile range of a normal distribution: 1.349 standard deviations.
  const double spread = between / 1.349 / exposure_scale;
  return ChannelScale{exposure_scale,
                      kMedianError * spread / std::sqrt(static_cast<double>(values.size())),
                      spread};
}

double MarkerLightMeter::ClippedShare(const std::vector<Sample>& pairs, std::size_t channel) {
  const auto clipped = std::count_if(pairs.begin(), pairs.end(), [&](const Sample& pair) {
    return std::isinf(pair.white_scale[channel]);
  });
  return static_cast<double>(clipped) / static_cast<double>(pairs.size());
}

std::optional<MarkerLightMeter::ChannelScale> MarkerLightMeter::BlackScaleOf(
    const std::vector<Sample>& pairs, std::size_t channel, int min_count) {
  auto exposure_scale = MedianOf(ScalesBy(pairs, &Sample::black_scale, channel), min_count);
  if (!exposure_scale) return std::nullopt;
  // The noise of blacks resembles dappled light. Unclipped whites measure the spread better: in
  // even light they all lie near the clipping limit.
  std::vector<double> whites = ScalesBy(pairs, &Sample::white_scale, channel);
  const double low = whites.empty() ? INFINITY : Quantile(whites, kDarkest);
  std::erase_if(whites, [](double white) { return std::isinf(white); });
  if (std::isfinite(low)) {
    const double clips = *std::max_element(whites.begin(), whites.end());
    exposure_scale->spread = (clips - low) / kDarkestSigmas / clips;
  }
  return exposure_scale;
}

std::optional<std::array<MarkerLightMeter::ChannelScale, 3>> MarkerLightMeter::ScalesOf(
    const std::vector<Sample>& pairs, int min_count) {
  std::array<std::optional<ChannelScale>, 3> channels;
  std::array<bool, 3> by_black{};
  // Veiling glare makes blacks too bright. Channels with both measurements show by how much.
  double log_glare = 0.0;
  int with_both = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto black = BlackScaleOf(pairs, c, min_count);
    if (ClippedShare(pairs, c) <= kMaxClippedShare) {
      channels[c] = MedianOf(ScalesBy(pairs, &Sample::white_scale, c), min_count);
    }
    by_black[c] = !channels[c];
    if (by_black[c]) {
      channels[c] = black;
    } else if (black) {
      log_glare += std::log(black->exposure_scale / channels[c]->exposure_scale);
      ++with_both;
    }
    if (!channels[c]) return std::nullopt;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (by_black[c] && with_both > 0)
      channels[c]->exposure_scale /= std::exp(log_glare / with_both);
  }
  return std::array{*channels[0], *channels[1], *channels[2]};
}

std::array<std::optional<MarkerLightMeter::ChannelScale>, 3> MarkerLightMeter::BrightestOf(
    std::vector<Sample> pairs, int min_count) {
  const auto count = static_cast<std::size_t>(kBrightest * static_cast<double>(pairs.size()));
  const std::size_t kept =
      std::min(pairs.size(), std::max(count, static_cast<std::size_t>(min_count)));
  const auto take_brightest = [&] {
    std::sort(pairs.begin(), pairs.end(),
              [](const Sample& a, const Sample& b) { return a.level > b.level; });
    pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(std::min(kept, pairs.size())),
                pairs.end());
  };
  std::vector<Sample> blacks = pairs;
  take_brightest();
  Rgb Sample::*by = &Sample::white_scale;
  if (std::max({ClippedShare(pairs, 0), ClippedShare(pairs, 1), ClippedShare(pairs, 2)}) >
      kMaxClippedShareOfBrightest) {
    // The brightest white is unknown, and the brightest of the unclipped ones may be half-lit.
    std::erase_if(blacks, [](const Sample& pair) { return std::isnan(Sum(pair.black_scale)); });
    pairs = blacks;
    // The mean of some neighbours, so that noise does not choose the brightest.
    for (std::size_t i = 0; i < blacks.size(); ++i) {
      const std::size_t first = i < kNeighbours ? 0 : i - kNeighbours;
      const std::size_t end = std::min(blacks.size(), i + kNeighbours + 1);
      pairs[i].level = 0.0;
      for (std::size_t k = first; k < end; ++k) {
        pairs[i].level += Sum(blacks[k].black_scale) / static_cast<double>(end - first);
      }
    }
    take_brightest();
    by = &Sample::black_scale;
  }
  std::array<std::optional<ChannelScale>, 3> exposure_scales;
  for (std::size_t c = 0; c < 3; ++c)
    exposure_scales[c] = MedianOf(ScalesBy(pairs, by, c), min_count);
  return exposure_scales;
}

std::optional<ExposureEstimate> MarkerLightMeter::Measure(
    CameraImageView image, const CameraModel& camera,
    const Transform<Camera, Marker>& camera_from_marker) const {
  auto [samples, contrary] = SamplesIn(image, camera, camera_from_marker);
  // An inverted marker, or a wrong pose. The exposure scale from its white, taken for black, would
  // be twenty times too high.
  if (contrary > samples.size()) return std::nullopt;
  // Where the sun reaches the marker, only the sunlit part counts. The uncertainty of the modelled
  // sky matters least there.
  const auto lit = std::count_if(samples.begin(), samples.end(),
                                 [](const Sample& sample) { return sample.in_sun; });
  bool few_bright = false;
  if (lit >= kMinimumPairs) {
    std::erase_if(samples, [](const Sample& sample) { return !sample.in_sun; });
    std::vector<double> levels;
    levels.reserve(samples.size());
    for (const Sample& sample : samples) levels.push_back(sample.level);
    const double threshold = ShadowThreshold(levels).value_or(0.0);
    const auto bright = std::count_if(levels.begin(), levels.end(),
                                      [&](double level) { return level >= threshold; });
    if (bright < kMinBrightPairs)
      return std::nullopt;  // The others would take the shade for the sun.
    std::erase_if(samples, [&](const Sample& sample) { return sample.level < threshold; });
    few_bright = bright < kMinimumPairs;
  }
  const int min_count = few_bright ? kMinBrightPairs : kMinimumPairs;
  if (static_cast<int>(samples.size()) < min_count) return std::nullopt;

  ExposureEstimate estimate;
  estimate.sunlit_share = sunlit_share_;
  estimate.pairs = static_cast<int>(samples.size());
  const auto exposure_scales = ScalesOf(samples, min_count);
  if (!exposure_scales) return std::nullopt;
  std::array<ChannelScale, 3> channels = *exposure_scales;
  // Under leaves no edge divides light from shade, and the brightest surface samples come nearest
  // to the sun. They are the same in each channel, although blue, the sky's color, may hardly show
  // it.
  const double spread = std::max({channels[0].spread, channels[1].spread, channels[2].spread});
  if (lit >= kMinimumPairs && spread > kHardlyDappled) {
    estimate.dappled = spread > kDappled;
    const double part =
        std::min(1.0, (spread - kHardlyDappled) / (kSurelyDappled - kHardlyDappled));
    const auto bright = BrightestOf(std::move(samples), min_count);
    const bool whole = bright[0] && bright[1] && bright[2];
    for (std::size_t c = 0; c < 3; ++c) {
      ChannelScale& channel = channels[c];
      if (whole)
        channel.exposure_scale *=
            std::pow(bright[c]->exposure_scale / channel.exposure_scale, part);
      // The remaining distance to full sun is unknown, for any number of pairs.
      channel.error += part * (channel.spread - channel.error);
    }
  }
  estimate.error = {channels[0].error, channels[1].error, channels[2].error};
  estimate.exposure_scale = {channels[0].exposure_scale, channels[1].exposure_scale,
                             channels[2].exposure_scale};
  return estimate;
}

}  // namespace pleinair::compositor
