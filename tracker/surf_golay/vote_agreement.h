#pragma once

#include <cstdint>
#include <vector>

namespace pleinair::tracker {

/// Properties of votes that determine their agreement, in parallel arrays.
struct VoteData {
  std::vector<float> centre_x,
      centre_y;  ///< Centre of the marker implied by each vote, undistorted pixels.
  std::vector<float> size_px, rotation_rad;
  std::vector<float> keypoint_x, keypoint_y;
  std::vector<float> modules_x, modules_y;  ///< The keypoint's position on the marker.

  void Resize(std::size_t count);
};

/// A vote with which others are compared.
struct VoteSeed {
  float from_modules[6];  ///< Affine: pixel = (m0 x + m1 y + m2, m3 x + m4 y + m5).
  float centre_y, rotation_rad;
  float far_px;   ///< Maximum vertical distance of the centres.
  float near_px;  ///< Maximum distance of a keypoint from the position that the seed predicts.
  float min_px, max_px;
  float turn_rad;  ///< Maximum difference of the rotations.
};

/// Writes the indices of votes first..last - 1 that agree with the seed, ascending, and returns
/// their number. `agreeing` must have room for last - first + kVoteSlack.
inline constexpr int kVoteSlack = 16;
int AgreeingVotes(const VoteData& votes, const VoteSeed& seed, int first, int last,
                  std::int32_t* agreeing);
/// Scalar reference of the same, for comparison.
int AgreeingVotesScalar(const VoteData& votes, const VoteSeed& seed, int first, int last,
                        std::int32_t* agreeing);

}  // namespace pleinair::tracker
