#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// One measure of a sweep in an old and a new run.
struct Change {
  std::string sweep;       ///< "all": all sweeps; "light": composed images.
  std::string measure;     ///< "rate", "misplaced", "false_numbers", "corner_px", "rotation_deg",
                           ///< "translation_percent"; for "light" the names of kImageMeasures.
  std::int64_t pairs = 0;  ///< Number of compared scenes (frames, images).
  double before = 0.0,
         after = 0.0;  ///< Rates, sums of counts, means of "light"; medians of the errors of
                       ///< markers hit in both.
  double p_worse = 1.0, p_better = 1.0;  ///< One-sided; without correction for multiple tests.
  bool worse = false, better = false;    ///< Significant with all changes together at level alpha.
};

struct RegressionOptions {
  std::string detector;
  /// Probability that any measure is called worse by chance although nothing has changed.
  double alpha = 0.001;
  /// Both runs have the same scenes (one seed): every frame is a pair. Otherwise all frames of one
  /// scene form one pair: the draws of "jitter" at one level, a whole video.
  bool same_scenes = true;
};

/// Compares runs frame by frame, paired by name. Tests: Wilcoxon's signed-rank test for errors of
/// markers hit in both; the sign test (McNemar) for detections; Student's paired test for composed
/// images, against the smallest relevant change (there are few key frames, and ranks of less than
/// ten cannot reach a level of 0.001). Holm's procedure selects the significant changes, separately
/// for worse and for better.
std::vector<Change> CompareRuns(const RunRecords& before, const RunRecords& after,
                                const RegressionOptions& options);

}  // namespace pleinair::accuracy
