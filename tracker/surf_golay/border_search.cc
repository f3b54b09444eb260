#include "tracker/surf_golay/border_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr double kMiddle = 0.5 * sg::kModules;
/// Maximum distance of unit descriptors that match; larger ones are no evidence.
constexpr double kMaxDistance = 0.75;
constexpr double kMin_px = 14.0, kMaxShare = 1.6;  ///< Of the image's height.
constexpr double kSamePlace =
    0.12;  ///< Minimum distance of two distinct hypotheses, in shares of their size.

Vec2 ApplyAffine(const std::array<double, 6>& m, Vec2 p) {
  return {m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]};
}

/// Corners of the marker's square, in no order around it.
Vec2 CornerModules(int corner) { return {corner & 1 ? 44.0 : 4.0, corner & 2 ? 44.0 : 4.0}; }

bool Inside(const std::array<Vec2, 4>& quad, double x, double y) {
  const auto right_of = [&](int i) {
    const Vec2 a = quad[i], b = quad[(i + 1) % 4];
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0.0;
  };
  const bool first = right_of(0);
  return right_of(2) == first && right_of(1) == first && right_of(3) == first;
}

std::size_t MaxVotes(const BorderSearchOptions& options) {
  return static_cast<std::size_t>(options.surf.max_keypoints) * options.neighbours;
}

}  // namespace

BorderSearch::BorderSearch(const LensGrid& lens, BorderTemplates templates,
                           const BorderSearchOptions& options)
    : lens_(lens),
      templates_(std::move(templates)),
      options_(options),
      frame_(options.surf),
      bins_(options.rotation_bin_rad, MaxVotes(options)) {
  matcher_.SetTemplates(templates_.descriptors);
  const std::size_t most = MaxVotes(options);
  votes_.reserve(most);
  ranked_.reserve(2 * most);
  members_.reserve(most);
  guessed_corners_.reserve(options_.max_guesses);
}

void BorderSearch::Find(ImageView<const std::uint8_t> grey,
                        const std::vector<std::array<Vec2, 4>>& taken, Sizes sizes, bool refill,
                        std::vector<BorderGuess>* guesses) {
  guesses->clear();
  const auto known = [&](const SurfKeypoint& k) {
    return std::any_of(taken.begin(), taken.end(),
                       [&](const auto& quad) { return Inside(quad, k.x, k.y); });
  };
  using Unwanted = DescribedKeypoints::Unwanted;
  frame_.Find(grey, sizes == Sizes::kAll, known, refill ? Unwanted::kReplace : Unwanted::kDrop);
  matcher_.Match(frame_.descriptors(), options_.neighbours, &templates_of_frame_, nullptr);
  CastVotes();
  Gather(guesses);
}

void BorderSearch::CastVotes() {
  votes_.clear();
  const double largest = kMaxShare * lens_.camera().height;
  constexpr double kUnit2 =
      QuantisedDescriptor::kUnit * static_cast<double>(QuantisedDescriptor::kUnit);
  for (std::size_t n = 0; n < frame_.keypoints().size(); ++n) {
    const SurfKeypoint& k = frame_.keypoints()[n];
    const Vec2 here = lens_.Undistort(k.x, k.y);
    for (int i = 0; i < options_.neighbours; ++i) {
      const DescriptorMatch& match = templates_of_frame_[n * options_.neighbours + i];
      if (match.index == DescriptorMatch::kNone) break;
      const double distance = std::sqrt(match.squared_distance / kUnit2);
      if (distance > kMaxDistance) break;
      const BorderTemplate& model = templates_.keypoints[match.index];
      const auto& view = templates_.views[model.view_index].from_modules;
      BorderVote vote;
      vote.keypoint = static_cast<int>(n);
      vote.model = match.index;
      vote.place = here;
      vote.rotation_rad = std::remainder(k.angle_rad - model.angle_rad, 2.0 * std::numbers::pi);
      const double zoom = k.scale / model.scale;
      const double c = zoom * std::cos(vote.rotation_rad), s = zoom * std::sin(vote.rotation_rad);
      vote.from_modules = {c * view[0] - s * view[3],
                           c * view[1] - s * view[4],
                           c * (view[2] - model.view.x) - s * (view[5] - model.view.y) + here.x,
                           s * view[0] + c * view[3],
                           s * view[1] + c * view[4],
                           s * (view[2] - model.view.x) + c * (view[5] - model.view.y) + here.y};
      const auto& m = vote.from_modules;
      vote.size_px = sg::kEdge * std::sqrt(std::fabs(m[0] * m[4] - m[1] * m[3]));
      vote.centre = ApplyAffine(m, {kMiddle, kMiddle});
      vote.weight = 1.0 - distance / kMaxDistance;
      const double longest = sg::kEdge * std::max(std::hypot(m[0], m[3]), std::hypot(m[1], m[4]));
      if (!(longest > kMin_px && longest < largest)) continue;
      votes_.push_back(vote);
    }
  }
}

void BorderSearch::Gather(std::vector<BorderGuess>* guesses) {
  bins_.Fill(votes_, frame_.keypoints(), templates_.keypoints);
  ranked_.clear();
  const std::span<const VoteBins::Bin> bins = bins_.bins();
  for (int bin = 0; bin < static_cast<int>(bins.size()); ++bin) {
    for (int i = bins[bin].begin; i < bins[bin].end; ++i) {
      const double votes = bins_.Supporters(bins[bin], i, nullptr);
      if (votes >= options_.min_votes) ranked_.push_back({bin, i, votes});
    }
  }
  std::sort(ranked_.begin(), ranked_.end(), [](const Ranked& a, const Ranked& b) {
    if (a.votes != b.votes) return a.votes > b.votes;
    return a.bin < b.bin || (a.bin == b.bin && a.place < b.place);
  });
  guessed_corners_.clear();
  for (const Ranked& candidate : ranked_) {
    if (static_cast<int>(guesses->size()) >= options_.max_guesses) break;
    const BorderVote& seed = bins_.At(candidate.place);
    members_.clear();
    bins_.Supporters(bins[candidate.bin], candidate.place, &members_);
    BorderGuess guess;
    guess.votes = candidate.votes;
    guess.matches = static_cast<int>(members_.size());
    if (!FitGuess(members_, seed, &guess)) continue;
    std::array<Vec2, 4> corners;
    const Mat3 inverse = Adjugate(guess.modules_from_undistorted);
    for (int k = 0; k < 4; ++k) corners[k] = Apply(inverse, CornerModules(k));
    const double same2 = kSamePlace * kSamePlace * seed.size_px * seed.size_px;
    const auto near = [&](Vec2 a, Vec2 b) {
      return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) < same2;
    };
    const bool known = std::ranges::any_of(guessed_corners_, [&](const std::array<Vec2, 4>& other) {
      return std::ranges::equal(corners, other, near);
    });
    if (known) continue;
    guesses->push_back(guess);
    guessed_corners_.push_back(corners);
  }
}

bool BorderSearch::FitGuess(const std::vector<int>& members, const BorderVote& seed,
                            BorderGuess* guess) {
  // Least squares of an affine map on all agreeing matches, with the seed's own shape as a prior. A
  // match of one view is already near, and a few matches add little.
  double w = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  Vec2 by_one, by_x, by_y;
  const auto add = [&](Vec2 modules, Vec2 undistorted, double weight) {
    const double u = modules.x - kMiddle, v = modules.y - kMiddle;
    const Vec2 weighted = undistorted * weight;
    w += weight;
    x += weight * u;
    y += weight * v;
    xx += weight * u * u;
    xy += weight * u * v;
    yy += weight * v * v;
    by_one = by_one + weighted;
    by_x = by_x + weighted * u;
    by_y = by_y + weighted * v;
  };
  for (const int member : members) {
    const BorderVote& vote = votes_[member];
    add(templates_.keypoints[vote.model].modules, vote.place, vote.weight);
  }
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 modules = CornerModules(corner);
    add(modules, ApplyAffine(seed.from_modules, modules), 0.15);
  }
  const Eigen::Matrix3d normal{{xx, xy, x}, {xy, yy, y}, {x, y, w}};
  const Eigen::Matrix<double, 3, 2> right{{by_x.x, by_x.y}, {by_y.x, by_y.y}, {by_one.x, by_one.y}};
  const Eigen::Matrix<double, 3, 2> affine = normal.ldlt().solve(right);
  if (!affine.allFinite()) return false;
  const double a = affine(0, 0), b = affine(1, 0), d = affine(0, 1), e = affine(1, 1);
  const double x0 = affine(2, 0) - (a + b) * kMiddle, y0 = affine(2, 1) - (d + e) * kMiddle;
  const double determinant = a * e - b * d;
  if (!(determinant > 1e-6)) return false;  // Mirrored or degenerate.
  guess->modules_from_undistorted = {{e / determinant, -b / determinant,
                                      (b * y0 - e * x0) / determinant, -d / determinant,
                                      a / determinant, (d * x0 - a * y0) / determinant, 0, 0, 1}};
  return true;
}

}  // namespace pleinair::tracker
