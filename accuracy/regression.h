#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/summary.h"

namespace pleinair::accuracy {

/// One figure of a sweep in an old run and in a new one.
struct Change {
  std::string sweep;       ///< "all": over all sweeps; "light": composed pictures.
  std::string measure;     ///< "rate", "misplaced", "false_numbers", "corner_px", "rotation_deg",
                           ///< "translation_percent"; of "light" kImageMeasures' names.
  std::int64_t pairs = 0;  ///< Of scenes (frames, pictures) that were compared.
  double before = 0.0,
         after =
             0.0;  ///< Rates, sums of counts, means of "light"; medians of errors of both's hits.
  double p_worse = 1.0, p_better = 1.0;  ///< One-sided; before any correction for their number.
  bool worse = false, better = false;    ///< Significantly, all changes together at level alpha.
};

struct RegressionOptions {
  std::string detector;
  /// Probability that any figure at all is called worse where nothing has changed but chance.
  double alpha = 0.001;
  /// Both runs have the same scenes (one seed): every frame is a pair of its own. Otherwise frames
  /// of one scene count as one: the draws of "jitter" at one level, all of a film.
  bool same_scenes = true;
};

/// Compares runs frame by frame, paired by name. Errors of markers that both hit by Wilcoxon's
/// signed-rank test, what is found or not by the sign test (McNemar's), composed pictures by
/// Student's paired test of more than the smallest change that counts (key frames are few: ranks of
/// less than ten cannot reach a level of 0.001); which of all these changes are significant by
/// Holm's procedure, for worse and for better each.
std::vector<Change> CompareRuns(const RunRecords& before, const RunRecords& after,
                                const RegressionOptions& options);

}  // namespace pleinair::accuracy
