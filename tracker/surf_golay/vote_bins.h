#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "tracker/surf/surf_keypoint.h"
#include "tracker/surf_golay/border_templates.h"
#include "tracker/surf_golay/vote_agreement.h"

namespace pleinair::tracker {

/// A match, with the affine map of the marker that it implies.
struct BorderVote {
  int keypoint = 0, model = 0;
  Vec2 place;  ///< Position of the keypoint, in undistorted pixels.
  std::array<double, 6> from_modules{};
  Vec2 centre;
  double size_px = 0.0;  ///< Square root of the area of the marker's square.
  double rotation_rad = 0.0;
  double weight = 0.0;
};

/// The angle filter (Prochazka et al. 2012, §3.2): votes in bins of the rotation between template
/// and frame. Each bin overlaps its neighbours by half, so that every pair of matches of one marker
/// shares a bin. A place is an index into all bins, concatenated; each vote has two.
class VoteBins {
 public:
  /// Places of votes with similar rotations, sorted by their centres.
  struct Bin {
    int begin = 0, end = 0;
  };

  /// `bin_rad`: width of a bin; `max_votes`: upper limit of the votes given to Fill().
  VoteBins(double bin_rad, std::size_t max_votes);

  /// Sorts the votes into bins. `votes` is kept by reference; a vote's `keypoint` and `model` are
  /// indices into the other two.
  void Fill(const std::vector<BorderVote>& votes, const std::vector<SurfKeypoint>& keypoints,
            const std::vector<BorderTemplate>& models);

  std::span<const Bin> bins() const { return bins_; }
  const BorderVote& At(int place) const { return votes_[binned_[place]]; }
  /// Summed similarity of the votes in the bin that agree with the one at `place`. Appends their
  /// indices in `votes` to `members` unless that is nullptr.
  double Supporters(const Bin& bin, int place, std::vector<int>* members);

 private:
  std::span<const BorderVote> votes_;
  std::vector<std::pair<double, int>> by_centre_;
  std::vector<Bin> bins_;
  std::vector<int> binned_;  ///< Vote index of each place,
  VoteData vote_data_;       ///< … and the data for the agreement test.
  std::vector<std::int32_t> agreeing_;
};

}  // namespace pleinair::tracker
