#pragma once

#include <string>
#include <vector>

#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// How well a picture can be found and measured.
struct TargetQuality {
  int features = 0;  ///< Keypoints that come back whenever the picture is observed from the front.
  double coverage = 0.0;  ///< Share of a 6×6 grid over the picture that has any.
  double contrast = 0.0;  ///< Share of an 8×8 grid that has light and dark to be aligned with.
  /// Share of the keypoints that look like another one elsewhere in the picture.
  double repetition = 0.0;
  /// Correlation with itself upside down, or lying on a side where it is about square: 1 is a
  /// picture of which nobody can say which way up it hangs.
  double turned_likeness = 0.0;
  int score = 0;                    ///< 0…100; from 60 on good.
  std::vector<std::string> advice;  ///< What would make it better, in words; worst first.
};

TargetQuality RateTarget(const PictureTarget& target);

/// Fewer features than this make no target.
inline constexpr int kMinTargetFeatures = 30;
/// … nor do features in less of the picture.
inline constexpr double kMinTargetCoverage = 0.2;

}  // namespace pleinair::tracker
