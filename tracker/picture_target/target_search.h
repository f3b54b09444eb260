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

/// Hypothesis of a target's position, from its keypoints.
struct TargetGuess {
  int target = 0;
  Mat3 target_from_undistorted;
  double votes = 0.0;  ///< Number of agreeing matches, weighted by similarity.
  int keypoints = 0;   ///< Number of keypoints of the frame among them.
};

/// Finds targets in an image by SURF. Matches the frame's keypoints with all views of all targets,
/// with several candidates each. Applies the angle filter (Prochazka et al. 2012, §3.2) with
/// overlapping bins, then groups matches that agree in the target's position and size, then fits a
/// robust homography to each group. The cost of description does not depend on the number of
/// targets; that of matching grows with it.
class TargetSearch {
 public:
  TargetSearch(const LensGrid& lens, std::vector<std::shared_ptr<const PictureTarget>> targets);

  /// Hypotheses for the targets with `wanted` set, most votes first. `mirrored`: searches for their
  /// mirror images in the image of the last call, without detecting keypoints again.
  void Find(ImageView<const std::uint8_t> grey, const std::vector<bool>& wanted,
            std::vector<TargetGuess>* guesses);
  void FindMirrored(const std::vector<bool>& wanted, std::vector<TargetGuess>* guesses);

 private:
  /// A match, with the affine map of the target that it implies.
  struct Vote {
    int keypoint = 0, model = 0;
    std::array<double, 6> from_target{};
    Vec2 centre;
    double size_px = 0.0;  ///< Square root of the target's area in the image under this map.
    double rotation_rad = 0.0;
    double weight = 0.0;
  };
  struct Ranked {
    int seed = 0, keypoints = 0;
    double votes = 0.0;
  };
  /// A match to which a homography is fitted.
  struct Member {
    int keypoint;
    Vec2 unit;    ///< On the target's square (±1),
    Vec2 shares;  ///< … and in the frame, relative to the hypothesis's centre and size.
    double weight;
    double sigma;  ///< Standard deviation relative to that size.
  };
  /// A keypoint of a target's view: its target and its position there.
  struct Model {
    int target = 0, index = 0;
    Vec2 place;
  };
  /// The keypoints of the frame in the form used for matching, mirrored or not.
  struct Shown {
    std::vector<SurfKeypoint> keypoints;
    std::vector<Vec2> undistorted;              ///< Their undistorted pixels.
    std::vector<QuantisedDescriptor> mirrored;  ///< Descriptors of the mirrored image.
  };
  /// Ensures that each keypoint is counted once.
  class Witnesses {
   public:
    /// Resets for a frame with this number of keypoints.
    void Start(std::size_t keypoints) {
      last_count_.assign(keypoints, 0);
      count_ = 0;
    }
    void StartCount() { ++count_; }
    bool IsCounted(int keypoint) const { return last_count_[keypoint] == count_; }
    void Count(int keypoint) { last_count_[keypoint] = count_; }

   private:
    std::vector<int> last_count_;  ///< Index of the last count that included a keypoint.
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
