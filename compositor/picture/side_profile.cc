#include "compositor/picture/side_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/lens/weighted_fit.h"
#include "compositor/picture/edge_profile.h"
#include "compositor/picture/edge_stripe.h"

namespace pleinair::compositor {
namespace {

constexpr double kAlongSide = 0.8;  // Away from the corners, where two edges meet.
constexpr int kMostStripes = 128, kFewestStripes = 12;
constexpr StripeReach kHalfBand{0.5, 40.0};
constexpr double kBin_px = 0.25;
constexpr double kLargestResidual = 0.06;  // RMS, relative to the step from black to white.
constexpr double kNarrowestBlur_px = 0.1;

/// Stripes along a side, no closer than a pixel: a pixel counts once.
int StripesOf(const MarkerInImage& marker, int side) {
  EdgeStripe first, last;
  if (!ReadEdgeStripe(marker, side, -kAlongSide, kHalfBand, &first) ||
      !ReadEdgeStripe(marker, side, kAlongSide, kHalfBand, &last)) {
    // Some part of the side may be seen in spite of it.
    return kFewestStripes;
  }
  return std::clamp(static_cast<int>(Norm(last.edge_px - first.edge_px)), kFewestStripes,
                    kMostStripes);
}

/// Speed of a place on the marker across the edge, px/s.
double SpeedAcross(const MarkerInImage& marker, const EdgeStripe& stripe,
                   const MarkerMotion& motion) {
  const auto pixel = [&](const Transform<Camera, Marker>& camera_from_marker) {
    const Point<Camera> p =
        camera_from_marker * Point<Marker>{{stripe.on_marker.x, stripe.on_marker.y, 0.0}};
    return p.xyz.z > 0.0 ? ProjectToPixel(marker.camera(), p) : stripe.edge_px;
  };
  const Vec2 moved = pixel(motion.after) - pixel(motion.before);
  return (moved.x * stripe.outward.x + moved.y * stripe.outward.y) / motion.seconds;
}

std::vector<ProfileBin> BinsOf(const std::vector<EdgePixel>& pixels, double reach_px) {
  const auto count = static_cast<std::size_t>(std::ceil(2.0 * reach_px / kBin_px));
  std::vector<ProfileBin> bins(count);
  for (const EdgePixel& pixel : pixels) {
    const double at = (pixel.distance_px + reach_px) / kBin_px;
    if (at < 0.0 || at >= static_cast<double>(count)) continue;
    ProfileBin& bin = bins[static_cast<std::size_t>(at)];
    bin.distance_px += pixel.distance_px;
    bin.value += pixel.value;
    bin.pixels += 1.0;
  }
  std::erase_if(bins, [](const ProfileBin& bin) { return bin.pixels == 0.0; });
  for (ProfileBin& bin : bins) {
    bin.distance_px /= bin.pixels;
    bin.value /= bin.pixels;
  }
  return bins;
}

/// An edge whose second moment is `blur_px`².
EdgeProfile EdgeOfBlur(double distance_px, double blur_px, double own_blur_px) {
  if (blur_px <= own_blur_px) return DefocusedEdge(distance_px, 0.0, blur_px);
  const double circle_px = 4.0 * std::sqrt(blur_px * blur_px - own_blur_px * own_blur_px);
  return DefocusedEdge(distance_px, circle_px, own_blur_px);
}

/// black + step · edge((d − shift), blur).
struct FittedEdge {
  double black = 0.0, step = 1.0, shift = 0.0, blur = 0.0;

  double At(double distance_px, double own_blur_px) const {
    return black + step * EdgeOfBlur(distance_px - shift, blur, own_blur_px).value;
  }
};

double CostOf(const FittedEdge& edge, const SideProfile& profile, double own_blur_px) {
  double cost = 0.0;
  for (const ProfileBin& bin : profile.bins) {
    const double off = bin.value - edge.At(bin.distance_px, own_blur_px);
    cost += bin.pixels * off * off;
  }
  return cost;
}

/// The equations of a step of Gauss and Newton.
WeightedFit<4> EquationsOf(const FittedEdge& edge, const SideProfile& profile, double own_blur_px) {
  constexpr double kDifference_px = 1e-3;
  WeightedFit<4> equations;
  for (const ProfileBin& bin : profile.bins) {
    const double at = bin.distance_px - edge.shift;
    const EdgeProfile here = EdgeOfBlur(at, edge.blur, own_blur_px);
    const EdgeProfile wider = EdgeOfBlur(at, edge.blur + kDifference_px, own_blur_px);
    const double by_blur = (wider.value - here.value) / kDifference_px;
    equations.Add({1.0, here.value, -edge.step * here.slope, edge.step * by_blur},
                  bin.value - edge.black - edge.step * here.value, bin.pixels);
  }
  return equations;
}

}  // namespace

std::vector<SideProfile> ReadSideProfiles(const MarkerInImage& marker,
                                          const std::optional<MarkerMotion>& motion) {
  std::vector<SideProfile> profiles;
  profiles.reserve(4);
  EdgeStripe stripe;
  std::vector<EdgePixel> pixels;
  for (int side = 0; side < 4; ++side) {
    const int stripes = StripesOf(marker, side);
    SideProfile profile;
    profile.place.side = side;
    profile.reach_px = kHalfBand.largest_px;
    pixels.clear();
    int read = 0;
    for (int i = 0; i < stripes; ++i) {
      const double along = kAlongSide * (2.0 * (i + 0.5) / stripes - 1.0);
      if (!ReadEdgeStripe(marker, side, along, kHalfBand, &stripe)) continue;
      ++read;
      pixels.insert(pixels.end(), stripe.pixels.begin(), stripe.pixels.end());
      profile.reach_px = std::min(profile.reach_px, stripe.reach_px);
      const Point<Camera> at = marker.camera_from_marker() *
                               Point<Marker>{{stripe.on_marker.x, stripe.on_marker.y, 0.0}};
      const double dioptres = 1.0 / at.xyz.z;
      profile.place.dioptres += dioptres;
      profile.place.dioptres_squared += dioptres * dioptres;
      if (motion) profile.place.squared_speed += std::pow(SpeedAcross(marker, stripe, *motion), 2);
    }
    // Half of a side that is hidden has its own mean distance, so that it counts all the same.
    if (read < std::max(kFewestStripes / 2, stripes / 3)) continue;
    profile.place.dioptres /= read;
    profile.place.dioptres_squared /= read;
    profile.place.squared_speed /= read;
    profile.bins = BinsOf(pixels, profile.reach_px);
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

std::optional<BlurReading> ReadBlur(const SideProfile& profile, double own_blur_px) {
  constexpr std::size_t kFewestBins = 8;
  if (profile.bins.size() < kFewestBins) return std::nullopt;
  FittedEdge edge{0.0, 1.0, 0.0, std::max(0.5, 1.2 * own_blur_px)};
  double cost = CostOf(edge, profile, own_blur_px);
  std::optional<WeightedFit<4>::Solution> solved;
  for (int iteration = 0; iteration < 20; ++iteration) {
    solved = EquationsOf(edge, profile, own_blur_px).Solve();
    if (!solved) return std::nullopt;
    double length = 1.0;
    FittedEdge next;
    double next_cost = 0.0;
    constexpr int kHalvings = 10;
    for (int halving = 0; halving < kHalvings; ++halving, length *= 0.5) {
      next = {
          edge.black + length * solved->value[0], edge.step + length * solved->value[1],
          edge.shift + length * solved->value[2],
          std::clamp(edge.blur + length * solved->value[3], kNarrowestBlur_px, profile.reach_px)};
      next_cost = CostOf(next, profile, own_blur_px);
      if (next_cost <= cost) break;
    }
    if (!(next_cost <= cost)) break;
    const double moved = std::fabs(next.blur - edge.blur) + std::fabs(next.shift - edge.shift);
    edge = next;
    cost = next_cost;
    if (moved < 1e-5) break;
  }
  double pixels = 0.0;
  for (const ProfileBin& bin : profile.bins) pixels += bin.pixels;
  // The whole disc has to be seen, so that its width and the levels are not mistaken for one
  // another.
  const double disc_px =
      2.0 * std::sqrt(std::max(0.0, edge.blur * edge.blur - own_blur_px * own_blur_px));
  if (std::sqrt(cost / pixels) > kLargestResidual * edge.step ||
      disc_px + own_blur_px + std::fabs(edge.shift) > profile.reach_px) {
    return std::nullopt;
  }
  const double variance = cost / static_cast<double>(profile.bins.size() - 4);
  BlurReading reading = profile.place;
  reading.blur_px = edge.blur;
  reading.error_px = std::sqrt(std::max(0.0, solved->covariance[3][3]) * variance);
  return reading;
}

namespace {

// For the search for the own blur of a lens.
constexpr int kRepetitions = 5;
constexpr double kUsualBlur_px = 0.4, kSettled_px = 0.003;

std::vector<BlurReading> ReadAll(const std::vector<SideProfile>& profiles, double own_blur_px) {
  std::vector<std::optional<BlurReading>> tried(profiles.size());
  ParallelFor(profiles.size(), 0,
              [&](std::size_t i) { tried[i] = ReadBlur(profiles[i], own_blur_px); });
  std::vector<BlurReading> read;
  read.reserve(tried.size());
  for (const auto& reading : tried) {
    if (reading) read.push_back(*reading);
  }
  return read;
}

}  // namespace

FocusFit MeasureFocus(const std::vector<SideProfile>& profiles, double fx, const KnownLens& known,
                      std::vector<BlurReading>* readings) {
  double own_blur_px = kUsualBlur_px;
  FocusFit fit;
  std::vector<BlurReading> read;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    read = ReadAll(profiles, own_blur_px);
    fit = FitFocus(read, fx, known);
    if (!(fit.in_focus_blur_px > 0.0)) break;
    const double change = fit.in_focus_blur_px - own_blur_px;
    own_blur_px = fit.in_focus_blur_px;
    if (std::fabs(change) < kSettled_px) break;
  }
  if (readings != nullptr) *readings = std::move(read);
  return fit;
}

ExposureFit MeasureExposure(const std::vector<SideProfile>& profiles, double own_blur_px,
                            double frame_interval_s) {
  const bool is_known = own_blur_px > 0.0;
  double blur_px = is_known ? own_blur_px : kUsualBlur_px;
  ExposureFit fit;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    fit = FitExposure(ReadAll(profiles, blur_px), frame_interval_s);
    const double change_px = fit.still_blur_px - blur_px;
    if (is_known || !(fit.still_blur_px > 0.0) || std::fabs(change_px) < kSettled_px) break;
    blur_px = fit.still_blur_px;
  }
  return fit;
}

}  // namespace pleinair::compositor
