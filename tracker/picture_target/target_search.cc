#include "tracker/picture_target/target_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tracker/picture_target/target_views.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

constexpr SurfOptions kSurfOptions{.octaves = 3,
                                   .max_keypoints = 600,
                                   .double_size = true,
                                   .descriptor_window_scales = kTargetDescriptorWindow_scales};
constexpr int kNeighbours = 4;  ///< Candidates of each keypoint of the frame.
/// Maximum distance of unit descriptors that match; larger ones are no evidence.
constexpr double kMaxDistance = 0.7;
constexpr double kMin_px = 20.0, kMaxShare = 3.0;  ///< Shares of the image's height.
/// Two matches agree if each is observed where the other predicts it: tolerances of position in
/// shares of the target's size, of scale as a ratio, and of rotation.
constexpr double kPlaceTolerance = 0.12, kScaleTolerance = 1.6, kTurnTolerance_rad = 0.6;
constexpr double kBin_rad = 0.6;  ///< Width of the angle filter's bins, which overlap by half.
constexpr int kBins = static_cast<int>(2.0 * std::numbers::pi / (0.5 * kBin_rad)) + 1;
constexpr std::size_t kSeedsOfBin = 60;
constexpr std::size_t kMaxGuesses = 12;
constexpr int kMaxFits = 30;
constexpr int kMinKeypoints = 4;  ///< "each bin with ≥ 4 matches", Prochazka et al. 2012, §3.2.
constexpr double kSamePlace =
    0.12;  ///< Minimum distance of two distinct hypotheses, in shares of their size.
/// Looser tolerances for the matches of a fit: the seed's own map is only affine.
constexpr double kLooserPlace = 0.5, kLooserScale = 2.5, kLooserTurn_rad = 0.9;
constexpr int kFitRounds = 8;
/// Position error of a keypoint, as a share of its scale, and its minimum.
constexpr double kOffOfScale = 0.5, kMinOffset_px = 0.6;
/// Distance, in such standard deviations, at which a match loses half its weight: first and last
/// round.
constexpr double kFirstReach = 12.0, kLastReach = 1.5;
/// Prior standard deviation of the corners about their positions under the seed, in shares of size;
/// that of the perspective terms.
constexpr double kOffOfSeed = 0.15, kUsualPerspective = 0.15;
constexpr double kHalf = 0.5 * kTargetSide;

Vec2 ApplyAffine(const std::array<double, 6>& m, Vec2 p) {
  return {m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]};
}

/// The descriptor of the mirror image, left for right. The second axis of a mirrored keypoint is
/// reversed: subregions swap rows, and sums along that axis change sign.
QuantisedDescriptor Mirrored(const QuantisedDescriptor& of) {
  QuantisedDescriptor mirror;
  mirror.bright = of.bright;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const std::int8_t* from = &of.values[((3 - row) * 4 + column) * 4];
      std::int8_t* to = &mirror.values[(row * 4 + column) * 4];
      to[0] = from[0];
      to[1] = static_cast<std::int8_t>(-std::max<int>(from[1], -127));
      to[2] = from[2];
      to[3] = from[3];
    }
  }
  return mirror;
}

double Turned(double a, double b) {
  const double turn = std::fabs(a - b);
  return std::min(turn, 2.0 * std::numbers::pi - turn);
}

}  // namespace

TargetSearch::TargetSearch(const LensGrid& lens,
                           std::vector<std::shared_ptr<const PictureTarget>> targets)
    : lens_(lens), targets_(std::move(targets)), frame_(kSurfOptions), bins_(kBins) {
  std::vector<QuantisedDescriptor> all;
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    const PictureTarget& target = *targets_[t];
    for (std::size_t k = 0; k < target.keypoints.size(); ++k) {
      const TargetKeypoint& keypoint = target.keypoints[k];
      models_.push_back(
          {static_cast<int>(t), static_cast<int>(k), PlaceOnTarget(target, keypoint)});
      all.push_back(target.descriptors[k]);
    }
  }
  matcher_.SetTemplates(all);
}

void TargetSearch::Find(ImageView<const std::uint8_t> grey, const std::vector<bool>& wanted,
                        std::vector<TargetGuess>* guesses) {
  frame_.Find(grey);
  MatchAndGather(wanted, false, guesses);
}

void TargetSearch::FindMirrored(const std::vector<bool>& wanted,
                                std::vector<TargetGuess>* guesses) {
  MatchAndGather(wanted, true, guesses);
}

void TargetSearch::MatchAndGather(const std::vector<bool>& wanted, bool mirrored,
                                  std::vector<TargetGuess>* guesses) {
  guesses->clear();
  shown_.keypoints = frame_.keypoints();
  shown_.undistorted.clear();
  for (SurfKeypoint& k : shown_.keypoints) {
    Vec2 undistorted = lens_.Undistort(k.x, k.y);
    if (mirrored) {
      undistorted.x = -undistorted.x;
      k.angle_rad = std::numbers::pi_v<float> - k.angle_rad;
    }
    shown_.undistorted.push_back(undistorted);
  }
  if (mirrored) {
    shown_.mirrored.clear();
    for (const QuantisedDescriptor& descriptor : frame_.descriptors()) {
      shown_.mirrored.push_back(Mirrored(descriptor));
    }
  }
  matcher_.Match(mirrored ? shown_.mirrored : frame_.descriptors(), kNeighbours,
                 &templates_of_frame_, nullptr);
  witnesses_.Start(shown_.keypoints.size());
  CastVotes(wanted);
  Rank();
  Gather(mirrored, guesses);
}

void TargetSearch::CastVotes(const std::vector<bool>& wanted) {
  votes_.clear();
  const double largest = kMaxShare * lens_.camera().height;
  constexpr double kUnit2 =
      QuantisedDescriptor::kUnit * static_cast<double>(QuantisedDescriptor::kUnit);
  for (std::size_t n = 0; n < shown_.keypoints.size(); ++n) {
    const SurfKeypoint& k = shown_.keypoints[n];
    const Vec2 here = shown_.undistorted[n];
    if (!std::isfinite(here.x) || !std::isfinite(here.y)) continue;
    for (int i = 0; i < kNeighbours; ++i) {
      const DescriptorMatch& match = templates_of_frame_[n * kNeighbours + i];
      if (match.index == DescriptorMatch::kNone) break;
      const double distance = std::sqrt(match.squared_distance / kUnit2);
      if (distance > kMaxDistance) break;
      const Model& model = models_[match.index];
      if (!wanted[model.target]) continue;
      const PictureTarget& target = *targets_[model.target];
      const TargetKeypoint& as = target.keypoints[model.index];
      const auto& view = target.views[as.view].from_target;
      Vote vote;
      vote.keypoint = static_cast<int>(n);
      vote.model = match.index;
      vote.rotation_rad = std::remainder(k.angle_rad - as.angle_rad, 2.0 * std::numbers::pi);
      const double zoom = k.scale / as.scale;
      const double c = zoom * std::cos(vote.rotation_rad), s = zoom * std::sin(vote.rotation_rad);
      vote.from_target = {c * view[0] - s * view[3],
                          c * view[1] - s * view[4],
                          c * (view[2] - as.x) - s * (view[5] - as.y) + here.x,
                          s * view[0] + c * view[3],
                          s * view[1] + c * view[4],
                          s * (view[2] - as.x) + c * (view[5] - as.y) + here.y};
      const auto& m = vote.from_target;
      vote.size_px = kTargetSide * std::sqrt(std::fabs(m[0] * m[4] - m[1] * m[3]));
      vote.centre = ApplyAffine(m, {kHalf, kHalf});
      vote.weight = 1.0 - distance / kMaxDistance;
      const double longest = kTargetSide * std::max(std::hypot(m[0], m[3]), std::hypot(m[1], m[4]));
      if (longest > kMin_px && longest < largest) votes_.push_back(vote);
    }
  }
}

Vec2 TargetSearch::Here(const Vote& vote) const { return shown_.undistorted[vote.keypoint]; }

bool TargetSearch::Agrees(const Vote& hypothesis, const Vote& vote) const {
  if (models_[vote.model].target != models_[hypothesis.model].target) return false;
  const double ratio = vote.size_px / hypothesis.size_px;
  if (ratio > kScaleTolerance || ratio < 1.0 / kScaleTolerance) return false;
  if (Turned(vote.rotation_rad, hypothesis.rotation_rad) > kTurnTolerance_rad) return false;
  const Vec2 expected = ApplyAffine(hypothesis.from_target, models_[vote.model].place);
  const Vec2 here = Here(vote);
  const double reach = kPlaceTolerance * hypothesis.size_px;
  return std::fabs(expected.x - here.x) < reach && std::fabs(expected.y - here.y) < reach;
}

void TargetSearch::Rank() {
  // The angle filter: bins of the rotation between target and frame. Each overlaps its neighbours
  // by half, so every pair of matches of one target shares a bin.
  for (auto& bin : bins_) bin.clear();
  for (std::size_t v = 0; v < votes_.size(); ++v) {
    const double turn = votes_[v].rotation_rad / (2.0 * std::numbers::pi) + 0.5;
    const int bin = std::clamp(static_cast<int>(turn * kBins), 0, kBins - 1);
    bins_[bin].push_back(static_cast<int>(v));
    bins_[(bin + 1) % kBins].push_back(static_cast<int>(v));
  }
  ranked_.clear();
  for (auto& bin : bins_) {
    std::sort(bin.begin(), bin.end(), [&](int a, int b) {
      return votes_[a].weight > votes_[b].weight || (votes_[a].weight == votes_[b].weight && a < b);
    });
    // The most likely matches are seeds of positions; all matches of the bin count as votes.
    for (std::size_t i = 0; i < std::min(bin.size(), kSeedsOfBin); ++i) {
      const Vote& seed = votes_[bin[i]];
      witnesses_.StartCount();
      Ranked ranked{bin[i], 0, 0.0};
      for (const int other : bin) {
        const Vote& vote = votes_[other];
        // Several candidates of one keypoint count as one witness; the most likely comes first.
        if (witnesses_.IsCounted(vote.keypoint) || !Agrees(seed, vote)) continue;
        witnesses_.Count(vote.keypoint);
        ranked.votes += vote.weight;
        ++ranked.keypoints;
      }
      if (ranked.keypoints >= kMinKeypoints) ranked_.push_back(ranked);
    }
  }
  std::sort(ranked_.begin(), ranked_.end(), [](const Ranked& a, const Ranked& b) {
    return a.votes > b.votes || (a.votes == b.votes && a.seed < b.seed);
  });
}

void TargetSearch::Gather(bool mirrored, std::vector<TargetGuess>* guesses) {
  constexpr std::array<Vec2, 4> kCorners{
      {{0, 0}, {kTargetSide, 0}, {kTargetSide, kTargetSide}, {0, kTargetSide}}};
  int fits = 0;
  for (const Ranked& candidate : ranked_) {
    if (guesses->size() >= kMaxGuesses || fits >= kMaxFits) break;
    const Vote& seed = votes_[candidate.seed];
    // The seed adds nothing if a hypothesis predicts the same.
    const bool known = std::any_of(guesses->begin(), guesses->end(), [&](const TargetGuess& other) {
      if (other.target != models_[seed.model].target) return false;
      const Mat3 undistorted_from_target = Adjugate(other.target_from_undistorted);
      double farthest = 0.0;
      for (const Vec2 corner : kCorners) {
        const Vec2 there = Apply(undistorted_from_target, corner);
        farthest = std::max(farthest, Norm(there - ApplyAffine(seed.from_target, corner)));
      }
      return farthest < 2.0 * kSamePlace * seed.size_px;
    });
    if (known) continue;
    TargetGuess guess;
    guess.target = models_[seed.model].target;
    guess.votes = candidate.votes;
    ++fits;
    if (!FitGuess(seed, &guess) || guess.keypoints < kMinKeypoints) continue;
    const Mat3 undistorted_from_target = Adjugate(guess.target_from_undistorted);
    const bool again = std::any_of(guesses->begin(), guesses->end(), [&](const TargetGuess& other) {
      if (other.target != guess.target) return false;
      const Mat3 other_undistorted_from_target = Adjugate(other.target_from_undistorted);
      double farthest = 0.0;
      for (const Vec2 corner : kCorners) {
        farthest = std::max(farthest, Norm(Apply(undistorted_from_target, corner) -
                                           Apply(other_undistorted_from_target, corner)));
      }
      return farthest < kSamePlace * seed.size_px;
    });
    if (again) continue;
    guesses->push_back(guess);
  }
  if (!mirrored) return;
  // Undoes the mirroring.
  constexpr Mat3 kMirror{{-1, 0, 0, 0, 1, 0, 0, 0, 1}};
  for (TargetGuess& guess : *guesses)
    guess.target_from_undistorted = guess.target_from_undistorted * kMirror;
}

bool TargetSearch::FitGuess(const Vote& seed, TargetGuess* guess) {
  // Gauss–Newton on a homography of the target's square (±1) with Cauchy's weights, from the seed's
  // affine map. The reach shrinks, so that the best-agreeing matches decide in the end.
  const auto& m = seed.from_target;
  const Vec2 middle = ApplyAffine(m, {kHalf, kHalf});
  const double size = seed.size_px;
  // x = (h0 u + h1 v + h2) / (h6 u + h7 v + 1) in shares of size from the seed's centre.
  std::array<double, 8> h{kHalf * m[0] / size,
                          kHalf * m[1] / size,
                          0,
                          kHalf * m[3] / size,
                          kHalf * m[4] / size,
                          0,
                          0,
                          0};
  const std::array<double, 8> start = h;
  members_.clear();
  for (const Vote& vote : votes_) {
    const Model& model = models_[vote.model];
    if (model.target != guess->target) continue;
    if (Turned(vote.rotation_rad, seed.rotation_rad) > kLooserTurn_rad) continue;
    const double ratio = vote.size_px / size;
    if (ratio > kLooserScale || ratio < 1.0 / kLooserScale) continue;
    // Skips matches far from where the seed predicts them.
    const Vec2 expected = ApplyAffine(m, model.place), here = Here(vote);
    if (Norm(here - expected) > kLooserPlace * size) continue;
    members_.push_back(
        {vote.keypoint,
         {model.place.x / kHalf - 1.0, model.place.y / kHalf - 1.0},
         (here - middle) * (1.0 / size),
         vote.weight,
         std::max(kMinOffset_px, kOffOfScale * shown_.keypoints[vote.keypoint].scale) / size});
  }
  for (int round = 0; round < kFitRounds; ++round) {
    const double share = static_cast<double>(round) / (kFitRounds - 1);
    const double reach = kFirstReach * std::pow(kLastReach / kFirstReach, share);
    Eigen::Matrix<double, 8, 8> normal = Eigen::Matrix<double, 8, 8>::Zero();
    Eigen::Matrix<double, 8, 1> right = Eigen::Matrix<double, 8, 1>::Zero();
    const auto add = [&](Vec2 unit, Vec2 to, double like, double sigma, bool robust) {
      const double w = 1.0 + h[6] * unit.x + h[7] * unit.y;
      if (!(w > 0.1)) return false;
      const double x = (h[0] * unit.x + h[1] * unit.y + h[2]) / w;
      const double y = (h[3] * unit.x + h[4] * unit.y + h[5]) / w;
      const Vec2 off = to - Vec2{x, y};
      const double square = (off.x * off.x + off.y * off.y) / (sigma * sigma);
      double weight = like / (sigma * sigma);
      if (robust) weight /= 1.0 + square / (reach * reach);
      Eigen::Matrix<double, 8, 1> jx, jy;
      jx << unit.x / w, unit.y / w, 1 / w, 0, 0, 0, -x * unit.x / w, -x * unit.y / w;
      jy << 0, 0, 0, unit.x / w, unit.y / w, 1 / w, -y * unit.x / w, -y * unit.y / w;
      normal += weight * (jx * jx.transpose() + jy * jy.transpose());
      right += weight * (jx * off.x + jy * off.y);
      return square < 4.0 * reach * reach;
    };
    witnesses_.StartCount();
    guess->keypoints = 0;
    for (const Member& member : members_) {
      if (witnesses_.IsCounted(member.keypoint)) continue;
      if (!add(member.unit, member.shares, member.weight, member.sigma, true)) continue;
      witnesses_.Count(member.keypoint);
      ++guess->keypoints;
    }
    for (const Vec2 corner : kSquareCorners) {
      const Vec2 to{start[0] * corner.x + start[1] * corner.y,
                    start[3] * corner.x + start[4] * corner.y};
      add(corner, to, 1.0, kOffOfSeed, false);
    }
    for (const int k : {6, 7}) {
      constexpr double kHeld = 1.0 / (kUsualPerspective * kUsualPerspective);
      normal(k, k) += kHeld;
      right[k] -= kHeld * h[k];
    }
    const Eigen::Matrix<double, 8, 1> move = normal.ldlt().solve(right);
    if (!move.allFinite()) return false;
    for (int k = 0; k < 8; ++k) h[k] += move[k];
  }
  // The target must be in front of the camera and not mirrored, at all its points.
  if (std::fabs(h[6]) + std::fabs(h[7]) > 0.8) return false;
  const Mat3 shares_from_unit{{h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1}};
  if (!(h[0] * (h[4] - h[5] * h[7]) - h[1] * (h[3] - h[5] * h[6]) +
            h[2] * (h[3] * h[7] - h[4] * h[6]) >
        1e-6)) {
    return false;
  }
  const Mat3 undistorted_from_shares{{size, 0, middle.x, 0, size, middle.y, 0, 0, 1}};
  constexpr Mat3 kTargetFromUnit{{kHalf, 0, kHalf, 0, kHalf, kHalf, 0, 0, 1}};
  guess->target_from_undistorted =
      kTargetFromUnit * Adjugate(undistorted_from_shares * shares_from_unit);
  for (double& entry : guess->target_from_undistorted.m)
    entry /= guess->target_from_undistorted.m[8];
  return std::all_of(guess->target_from_undistorted.m.begin(),
                     guess->target_from_undistorted.m.end(),
                     [](double entry) { return std::isfinite(entry); });
}

}  // namespace pleinair::tracker
