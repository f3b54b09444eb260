#include "tracker/surf_golay/border_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracker/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr double kMiddle = 0.5 * sg::kPrint;
/// Matches farther apart than this (of unit descriptors) say nothing.
constexpr double kFarthest = 0.75;
constexpr double kSmallest_px = 14.0, kLargestShare = 1.6;  ///< Of the picture's height.
/// Two matches agree when each is seen where the other expects it, in shares of the print's size.
constexpr float kPlaceTolerance = 0.13F, kScaleTolerance = 1.6F, kTurnTolerance_rad = 0.6F;
constexpr double kSamePlace = 0.12;  ///< Guesses closer than this, in shares of size, are one.

Vec2 ApplyAffine(const std::array<double, 6>& m, Vec2 p) {
  return {m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]};
}

bool Inside(const std::array<Vec2, 4>& quad, double x, double y) {
  int sides = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec2 a = quad[i], b = quad[(i + 1) % 4];
    sides += (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0.0 ? 1 : -1;
  }
  return sides == 4 || sides == -4;
}

}  // namespace

BorderSearch::BorderSearch(const LensGrid& lens, BorderTemplates templates,
                           const BorderSearchOptions& options)
    : lens_(lens), templates_(std::move(templates)), options_(options), surf_(options.surf) {
  matcher_.SetTemplates(templates_.descriptors);
}

void BorderSearch::Find(ImageView<const std::uint8_t> grey,
                        const std::vector<std::array<Vec2, 4>>& taken, Sizes sizes, bool refill,
                        std::vector<BorderGuess>* guesses) {
  guesses->clear();
  const auto known = [&](const SurfKeypoint& k) {
    return std::any_of(taken.begin(), taken.end(),
                       [&](const auto& quad) { return Inside(quad, k.x, k.y); });
  };
  const bool all_sizes = sizes == Sizes::kAll;
  if (refill) {
    surf_.Detect(grey, &keypoints_, all_sizes, known);
  } else {
    surf_.Detect(grey, &keypoints_, all_sizes);
    std::erase_if(keypoints_, known);
  }
  surf_.Describe(&keypoints_, &descriptors_);
  Quantise(keypoints_, descriptors_, &quantised_);
  matcher_.Match(quantised_, options_.neighbours, &templates_of_frame_, &frame_of_templates_);
  CastVotes();
  Gather(guesses);
}

void BorderSearch::CastVotes() {
  votes_.clear();
  const double largest = kLargestShare * lens_.camera().height;
  constexpr double kUnit2 =
      QuantisedDescriptor::kUnit * static_cast<double>(QuantisedDescriptor::kUnit);
  for (std::size_t n = 0; n < keypoints_.size(); ++n) {
    const SurfKeypoint& k = keypoints_[n];
    for (int i = 0; i < options_.neighbours; ++i) {
      const DescriptorMatch& match = templates_of_frame_[n * options_.neighbours + i];
      if (match.index == DescriptorMatch::kNone) break;
      const double distance = std::sqrt(match.squared_distance / kUnit2);
      if (distance > kFarthest) break;
      const BorderTemplate& model = templates_.keypoints[match.index];
      const auto& view = templates_.views[model.view_index].from_modules;
      Vote vote;
      vote.keypoint = static_cast<int>(n);
      vote.model = match.index;
      vote.rotation_rad = std::remainder(k.angle_rad - model.angle_rad, 2.0 * std::numbers::pi);
      const double zoom = k.scale / model.scale;
      const double c = zoom * std::cos(vote.rotation_rad), s = zoom * std::sin(vote.rotation_rad);
      const Vec2 here = lens_.Ideal(k.x, k.y);
      vote.from_modules = {c * view[0] - s * view[3],
                           c * view[1] - s * view[4],
                           c * (view[2] - model.view.x) - s * (view[5] - model.view.y) + here.x,
                           s * view[0] + c * view[3],
                           s * view[1] + c * view[4],
                           s * (view[2] - model.view.x) + c * (view[5] - model.view.y) + here.y};
      const auto& m = vote.from_modules;
      vote.size_px = sg::kEdge * std::sqrt(std::fabs(m[0] * m[4] - m[1] * m[3]));
      vote.centre = ApplyAffine(m, {kMiddle, kMiddle});
      vote.weight = 1.0 - distance / kFarthest;
      const double longest = sg::kEdge * std::max(std::hypot(m[0], m[3]), std::hypot(m[1], m[4]));
      if (!(longest > kSmallest_px && longest < largest)) continue;
      votes_.push_back(vote);
    }
  }
}

void BorderSearch::CallWitnesses(const std::vector<int>& bin) {
  Witnesses& w = witnesses_;
  for (auto* values : {&w.centre_x, &w.centre_y, &w.size_px, &w.rotation_rad, &w.keypoint_x,
                       &w.keypoint_y, &w.modules_x, &w.modules_y}) {
    values->resize(bin.size());
  }
  w.agrees.resize(bin.size());
  for (std::size_t i = 0; i < bin.size(); ++i) {
    const Vote& vote = votes_[bin[i]];
    const Vec2 modules = templates_.keypoints[vote.model].modules;
    w.centre_x[i] = static_cast<float>(vote.centre.x);
    w.centre_y[i] = static_cast<float>(vote.centre.y);
    w.size_px[i] = static_cast<float>(vote.size_px);
    w.rotation_rad[i] = static_cast<float>(vote.rotation_rad);
    w.keypoint_x[i] = keypoints_[vote.keypoint].x;
    w.keypoint_y[i] = keypoints_[vote.keypoint].y;
    w.modules_x[i] = static_cast<float>(modules.x);
    w.modules_y[i] = static_cast<float>(modules.y);
  }
}

double BorderSearch::Supporters(const std::vector<int>& bin, int at, std::vector<int>* members) {
  Witnesses& w = witnesses_;
  const Vote& seed = votes_[bin[at]];
  std::array<float, 6> m;
  std::ranges::copy(seed.from_modules, m.begin());
  const float size = w.size_px[at], centre_y = w.centre_y[at], rotation = w.rotation_rad[at];
  const float far = 0.5F * size, near = kPlaceTolerance * size;
  const float largest = kScaleTolerance * size, smallest = size / kScaleTolerance;
  constexpr float kWholeTurn = 2.0F * std::numbers::pi_v<float>;
  const auto x = w.centre_x.begin();
  const auto first = static_cast<int>(std::lower_bound(x, x + at, w.centre_x[at] - far) - x);
  const auto last =
      static_cast<int>(std::upper_bound(x + at, w.centre_x.end(), w.centre_x[at] + far) - x);
  // Without branches, so that the compiler takes several at a time.
  std::int32_t* agrees = w.agrees.data();
  for (int j = first; j < last; ++j) {
    const float turn = std::fabs(w.rotation_rad[j] - rotation);
    const float off_x = m[0] * w.modules_x[j] + m[1] * w.modules_y[j] + m[2] - w.keypoint_x[j];
    const float off_y = m[3] * w.modules_x[j] + m[4] * w.modules_y[j] + m[5] - w.keypoint_y[j];
    agrees[j] = (std::fabs(w.centre_y[j] - centre_y) <= far) & (w.size_px[j] <= largest) &
                (w.size_px[j] >= smallest) &
                (std::min(turn, kWholeTurn - turn) <= kTurnTolerance_rad) &
                (std::fabs(off_x) < near) & (std::fabs(off_y) < near);
  }
  double sum = 0.0;
  int last_keypoint = -1;
  const auto count = [&](int j) {
    if (agrees[j] == 0) return;
    const Vote& vote = votes_[bin[j]];
    if (members != nullptr) members->push_back(bin[j]);
    // Several templates of one keypoint are one witness.
    if (vote.keypoint != last_keypoint) sum += vote.weight;
    last_keypoint = vote.keypoint;
  };
  for (int j = at; j < last; ++j) count(j);
  for (int j = at; j-- > first;) count(j);
  return sum;
}

void BorderSearch::Gather(std::vector<BorderGuess>* guesses) {
  // The angle filter: bins of the turn between template and frame, each overlapping its neighbours
  // by half, so that every pair of matches of one marker meets in some bin.
  const int bins = std::max(
      4, static_cast<int>(std::ceil(2.0 * std::numbers::pi / (0.5 * options_.rotation_bin_rad))));
  bins_.resize(bins);
  for (auto& bin : bins_) bin.clear();
  for (std::size_t v = 0; v < votes_.size(); ++v) {
    const double turn = votes_[v].rotation_rad / (2.0 * std::numbers::pi) + 0.5;
    const int bin = std::clamp(static_cast<int>(turn * bins), 0, bins - 1);
    bins_[bin].push_back(static_cast<int>(v));
    bins_[(bin + 1) % bins].push_back(static_cast<int>(v));
  }
  ranked_.clear();
  for (int bin = 0; bin < bins; ++bin) {
    std::sort(bins_[bin].begin(), bins_[bin].end(), [&](int a, int b) {
      return votes_[a].centre.x < votes_[b].centre.x ||
             (votes_[a].centre.x == votes_[b].centre.x && a < b);
    });
    CallWitnesses(bins_[bin]);
    for (int i = 0; i < static_cast<int>(bins_[bin].size()); ++i) {
      const double votes = Supporters(bins_[bin], i, nullptr);
      if (votes >= options_.fewest_votes) ranked_.push_back({bin, i, votes});
    }
  }
  std::sort(ranked_.begin(), ranked_.end(), [](const Ranked& a, const Ranked& b) {
    if (a.votes != b.votes) return a.votes > b.votes;
    return a.bin < b.bin || (a.bin == b.bin && a.at < b.at);
  });
  for (const Ranked& candidate : ranked_) {
    if (static_cast<int>(guesses->size()) >= options_.most_guesses) break;
    const std::vector<int>& bin = bins_[candidate.bin];
    const Vote& seed = votes_[bin[candidate.at]];
    members_.clear();
    CallWitnesses(bin);
    Supporters(bin, candidate.at, &members_);
    BorderGuess guess;
    guess.votes = candidate.votes;
    guess.matches = static_cast<int>(members_.size());
    if (!FitGuess(members_, seed, &guess)) continue;
    const Mat3 inverse = Adjugate(guess.modules_from_ideal);
    const bool known = std::any_of(guesses->begin(), guesses->end(), [&](const BorderGuess& other) {
      const Mat3 other_inverse = Adjugate(other.modules_from_ideal);
      double farthest = 0.0;
      for (int corner = 0; corner < 4; ++corner) {
        const Vec2 modules{corner & 1 ? 44.0 : 4.0, corner & 2 ? 44.0 : 4.0};
        farthest =
            std::max(farthest, Norm(Apply(inverse, modules) - Apply(other_inverse, modules)));
      }
      return farthest < kSamePlace * seed.size_px;
    });
    if (!known) guesses->push_back(guess);
  }
}

bool BorderSearch::FitGuess(const std::vector<int>& members, const Vote& seed, BorderGuess* guess) {
  // Least squares of an affine picture on all that agree, held towards the seed's own shape: what a
  // match of one view implies is already near, and few matches tell little more.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  const auto add = [&](Vec2 modules, Vec2 ideal, double weight) {
    const Eigen::Vector3d row(modules.x - kMiddle, modules.y - kMiddle, 1.0);
    normal += weight * row * row.transpose();
    right += weight * row * Eigen::RowVector2d(ideal.x, ideal.y);
  };
  for (const int member : members) {
    const Vote& vote = votes_[member];
    const SurfKeypoint& k = keypoints_[vote.keypoint];
    add(templates_.keypoints[vote.model].modules, lens_.Ideal(k.x, k.y), vote.weight);
  }
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 modules{corner & 1 ? 44.0 : 4.0, corner & 2 ? 44.0 : 4.0};
    add(modules, ApplyAffine(seed.from_modules, modules), 0.15);
  }
  const Eigen::Matrix<double, 3, 2> affine = normal.ldlt().solve(right);
  if (!affine.allFinite()) return false;
  const double a = affine(0, 0), b = affine(1, 0), d = affine(0, 1), e = affine(1, 1);
  const double x0 = affine(2, 0) - (a + b) * kMiddle, y0 = affine(2, 1) - (d + e) * kMiddle;
  const double determinant = a * e - b * d;
  if (!(determinant > 1e-6)) return false;  // Mirrored or degenerate.
  guess->modules_from_ideal = {{e / determinant, -b / determinant, (b * y0 - e * x0) / determinant,
                                -d / determinant, a / determinant, (d * x0 - a * y0) / determinant,
                                0, 0, 1}};
  return true;
}

}  // namespace pleinair::tracker
