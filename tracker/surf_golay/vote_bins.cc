#include "tracker/surf_golay/vote_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::tracker {
namespace {

/// Two matches agree if each is observed where the other predicts it: tolerances of position in
/// shares of the marker's size, of scale as a ratio, and of rotation.
constexpr float kPlaceTolerance = 0.13F, kScaleTolerance = 1.6F, kTurnTolerance_rad = 0.6F;

}  // namespace

VoteBins::VoteBins(double bin_rad, std::size_t max_votes) {
  by_centre_.reserve(max_votes);
  binned_.resize(2 * max_votes);
  vote_data_.Resize(2 * max_votes);
  agreeing_.resize(2 * max_votes + kVoteSlack);
  bins_.resize(std::max(4, static_cast<int>(std::ceil(2.0 * std::numbers::pi / (0.5 * bin_rad)))));
}

void VoteBins::Fill(const std::vector<BorderVote>& votes,
                    const std::vector<SurfKeypoint>& keypoints,
                    const std::vector<BorderTemplate>& models) {
  votes_ = votes;
  const int bins = static_cast<int>(bins_.size());
  const auto bin_of = [&](const BorderVote& vote) {
    const double turn = vote.rotation_rad / (2.0 * std::numbers::pi) + 0.5;
    return std::clamp(static_cast<int>(turn * bins), 0, bins - 1);
  };
  by_centre_.clear();
  for (Bin& bin : bins_) bin = {};
  for (std::size_t v = 0; v < votes_.size(); ++v) {
    by_centre_.emplace_back(votes_[v].centre.x, static_cast<int>(v));
    const int bin = bin_of(votes_[v]);
    ++bins_[bin].end;
    ++bins_[(bin + 1) % bins].end;
  }
  std::ranges::sort(by_centre_);
  int begin = 0;
  for (Bin& bin : bins_) {
    const int count = bin.end;
    bin = {begin, begin};
    begin += count;
  }
  VoteData& w = vote_data_;
  for (const auto& [centre_x, v] : by_centre_) {
    const BorderVote& vote = votes_[v];
    const Vec2 modules = models[vote.model].modules;
    const int first = bin_of(vote);
    for (const int bin : {first, (first + 1) % bins}) {
      const int i = bins_[bin].end++;
      binned_[i] = v;
      w.centre_x[i] = static_cast<float>(vote.centre.x);
      w.centre_y[i] = static_cast<float>(vote.centre.y);
      w.size_px[i] = static_cast<float>(vote.size_px);
      w.rotation_rad[i] = static_cast<float>(vote.rotation_rad);
      w.keypoint_x[i] = keypoints[vote.keypoint].x;
      w.keypoint_y[i] = keypoints[vote.keypoint].y;
      w.modules_x[i] = static_cast<float>(modules.x);
      w.modules_y[i] = static_cast<float>(modules.y);
    }
  }
}

double VoteBins::Supporters(const Bin& bin, int place, std::vector<int>* members) {
  const VoteData& w = vote_data_;
  const float size = w.size_px[place], far = 0.5F * size;
  VoteSeed seed{.from_modules = {},
                .centre_y = w.centre_y[place],
                .rotation_rad = w.rotation_rad[place],
                .far_px = far,
                .near_px = kPlaceTolerance * size,
                .min_px = size / kScaleTolerance,
                .max_px = kScaleTolerance * size,
                .turn_rad = kTurnTolerance_rad};
  std::ranges::copy(votes_[binned_[place]].from_modules, seed.from_modules);
  const auto x = w.centre_x.begin();
  const auto first =
      static_cast<int>(std::lower_bound(x + bin.begin, x + place, w.centre_x[place] - far) - x);
  const auto last =
      static_cast<int>(std::upper_bound(x + place, x + bin.end, w.centre_x[place] + far) - x);
  const int count = AgreeingVotes(w, seed, first, last, agreeing_.data());
  double sum = 0.0;
  int last_keypoint = -1;
  const auto add = [&](int j) {
    const BorderVote& vote = votes_[binned_[j]];
    if (members != nullptr) members->push_back(binned_[j]);
    // Several templates of one keypoint count as one witness.
    if (vote.keypoint != last_keypoint) sum += vote.weight;
    last_keypoint = vote.keypoint;
  };
  // From the seed to the right, then to the left.
  const int middle = static_cast<int>(
      std::lower_bound(agreeing_.begin(), agreeing_.begin() + count, place) - agreeing_.begin());
  for (int i = middle; i < count; ++i) add(agreeing_[i]);
  for (int i = middle; i-- > 0;) add(agreeing_[i]);
  return sum;
}

}  // namespace pleinair::tracker
