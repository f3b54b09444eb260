#pragma once

#include <cstdint>
#include <vector>

namespace pleinair::tracker {

/// What of votes for places of prints tells whether they agree, array by array.
struct VoteData {
  std::vector<float> centre_x,
      centre_y;  ///< Of the marker, as each vote has it, undistorted pixels.
  std::vector<float> size_px, rotation_rad;
  std::vector<float> keypoint_x, keypoint_y;
  std::vector<float> modules_x, modules_y;  ///< The keypoint's place on the marker.

  void Resize(std::size_t count);
};

/// A vote that others are asked to agree with.
struct VoteSeed {
  float from_modules[6];  ///< Affine: pixel = (m0 x + m1 y + m2, m3 x + m4 y + m5).
  float centre_y, rotation_rad;
  float far_px;   ///< Farthest that centres may be apart downwards.
  float near_px;  ///< … and a keypoint from where the seed expects it.
  float min_px, max_px;
  float turn_rad;  ///< Greatest difference of the rotations.
};

/// Writes those of the votes first..last - 1 that agree with the seed, in rising order, and returns
/// how many. `agreeing` has room for last - first + kVoteSlack.
inline constexpr int kVoteSlack = 16;
int AgreeingVotes(const VoteData& votes, const VoteSeed& seed, int first, int last,
                  std::int32_t* agreeing);
/// The same one by one, for comparison.
int AgreeingVotesScalar(const VoteData& votes, const VoteSeed& seed, int first, int last,
                        std::int32_t* agreeing);

}  // namespace pleinair::tracker
