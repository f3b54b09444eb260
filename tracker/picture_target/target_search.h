#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/picture_target/picture_target.h"
#include "tracker/surf/described_keypoints.h"
#include "tracker/surf/descriptor_matcher.h"

namespace pleinair::tracker {

/// A place where a target may be, by its keypoints.
struct TargetGuess {
  int target = 0;
  Mat3 target_from_undistorted;
  double votes = 0.0;  ///< How many matches agree, by their likeness.
  int keypoints = 0;   ///< How many keypoints of the frame do.
};

/// Finds targets in a picture by SURF: matches of keypoints with all the targets' views, several
/// candidates each, the angle filter (Prochazka et al. 2012, §3.2) with bins that overlap, then
/// agreement of the matches in where and how large the target would be observed, then a homography
/// of those that agree, robustly. What is described costs the same for any number of targets; what
/// is matched grows with it.
class TargetSearch {
 public:
  TargetSearch(const LensGrid& lens, std::vector<std::shared_ptr<const PictureTarget>> targets);

  /// Guesses, the most votes first, for targets with `wanted` set. `mirrored` looks for their
  /// mirror images instead, in the same picture as the last call: nothing is detected anew.
  void Find(ImageView<const std::uint8_t> grey, const std::vector<bool>& wanted,
            std::vector<TargetGuess>* guesses);
  void FindMirrored(const std::vector<bool>& wanted, std::vector<TargetGuess>* guesses);

 private:
  /// A match and the affine picture of the target that it alone implies.
  struct Vote {
    int keypoint = 0, model = 0;
    std::array<double, 6> from_target{};
    Vec2 centre;
    double size_px = 0.0;  ///< Square root of the area that the target would be observed with.
    double rotation_rad = 0.0;
    double weight = 0.0;
  };
  struct Ranked {
    int seed = 0, keypoints = 0;
    double votes = 0.0;
  };
  /// A match that a homography is fitted to.
  struct Member {
    int keypoint;
    Vec2 unit;    ///< On the target's square (±1),
    Vec2 shares;  ///< … and in the frame, in shares of the guess's size from its middle.
    double weight;
    double sigma;  ///< How far it may be off, in shares of size.
  };
  /// A keypoint of a target's view: where it lies on which target.
  struct Model {
    int target = 0, index = 0;
    Vec2 place;
  };
  /// The keypoints of the frame as they are matched: mirrored or not.
  struct Shown {
    std::vector<SurfKeypoint> keypoints;
    std::vector<Vec2> undistorted;              ///< Their undistorted pixels.
    std::vector<QuantisedDescriptor> mirrored;  ///< Their descriptors where they are mirrored.
  };
  /// Counts each keypoint once.
  class Witnesses {
   public:
    /// Before the first count of a frame with so many keypoints.
    void Start(std::size_t keypoints) {
      last_count_.assign(keypoints, 0);
      count_ = 0;
    }
    void StartCount() { ++count_; }
    bool IsCounted(int keypoint) const { return last_count_[keypoint] == count_; }
    void Count(int keypoint) { last_count_[keypoint] = count_; }

   private:
    std::vector<int> last_count_;  ///< The last count that a keypoint was in.
    int count_ = 0;
  };

  void MatchAndGather(const std::vector<bool>& wanted, bool mirrored,
                      std::vector<TargetGuess>* guesses);
  void CastVotes(const std::vector<bool>& wanted);
  void Rank();
  void Gather(bool mirrored, std::vector<TargetGuess>* guesses);
  bool Agrees(const Vote& hypothesis, const Vote& vote) const;
  bool FitGuess(const Vote& seed, TargetGuess* guess);
  Vec2 Here(const Vote& vote) const;

  const LensGrid& lens_;
  const std::vector<std::shared_ptr<const PictureTarget>> targets_;
  std::vector<Model> models_;
  DescribedKeypoints frame_;
  Shown shown_;
  DescriptorMatcher matcher_;
  std::vector<DescriptorMatch> templates_of_frame_;
  std::vector<Vote> votes_;
  std::vector<std::vector<int>> bins_;
  std::vector<Ranked> ranked_;
  std::vector<Member> members_;
  Witnesses witnesses_;
};

}  // namespace pleinair::tracker
