#pragma once

#include <string>
#include <vector>

#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// Suitability of an image as a target.
struct TargetQuality {
  int features = 0;       ///< Keypoints that are repeatable in all frontal views.
  double coverage = 0.0;  ///< Share of a 6×6 grid over the image with features.
  double contrast = 0.0;  ///< Share of an 8×8 grid with enough contrast for alignment.
  /// Share of the keypoints that resemble another one elsewhere in the image.
  double repetition = 0.0;
  /// Correlation with itself turned by 180°, or by 90° if it is nearly square; 1: the orientation
  /// is ambiguous.
  double turned_likeness = 0.0;
  int score = 0;                    ///< 0…100; good from 60 on.
  std::vector<std::string> advice;  ///< Suggestions for improvement; most important first.
};

TargetQuality RateTarget(const PictureTarget& target);

/// Minimum number of features of a target.
inline constexpr int kMinTargetFeatures = 30;
/// Minimum coverage of a target.
inline constexpr double kMinTargetCoverage = 0.2;

}  // namespace pleinair::tracker
