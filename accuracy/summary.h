#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "accuracy/image_record.h"
#include "accuracy/statistics.h"

namespace pleinair::accuracy {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Consistency of a detector's covariances with its errors.
struct NeesSummary {
  std::int64_t count = 0;
  double mean = 0.0;  ///< 6 if consistent,
  Interval band{};    ///< … within this interval with 95 %.
};

/// Results of one detector for some frames: those of a level, a pattern or a sweep.
struct CellSummary {
  struct Counts {
    std::int64_t frames = 0, markers = 0, hits = 0, misplaced = 0, false_numbers = 0;
    std::int64_t flips = 0;  ///< Hits with a rotation error beyond kFlip_deg.
  };
  struct Rates {
    Interval hits{};          ///< Of markers,
    Interval false_frames{};  ///< … and of frames with a false number.
  };
  /// Mean corner error: to the right and down, and away from the marker's middle.
  struct CornerBias {
    double x = 0.0, y = 0.0, outward = 0.0;
  };

  std::string detector, sweep;
  std::string pattern;          ///< Empty: all, or the sweep has none.
  std::optional<double> level;  ///< None: all.
  Counts counts;
  Rates rates;
  Spread corner_px;  ///< RMS over a marker's corners, over its hits.
  CornerBias bias_px;
  Spread rotation_deg, translation_m;
  Spread translation_share;         ///< Relative to the distance.
  std::optional<NeesSummary> nees;  ///< Of hits without flips.
};

/// One scene with many draws of the noise: "jitter".
struct JitterSummary {
  std::string detector, pattern;
  double level = 0.0;
  std::int64_t frames = 0;
  double corner_std_px = 0.0;   ///< Of one corner coordinate, mean over the eight.
  double corner_bias_px = 0.0;  ///< Mean error of a coordinate, mean of the eight absolute values.
  double translation_std_m = 0.0, rotation_std_deg = 0.0;
};

/// Runs of frames.
struct Runs {
  std::int64_t count = 0, longest = 0;
};

/// A marker that was there and then was not found.
struct Losses {
  std::int64_t count = 0;      ///< How often,
  std::int64_t reported = 0;   ///< … and the detector reported it in that frame,
  std::int64_t recovered = 0;  ///< … and it was found again.
};

/// Errors of a trajectory, absolute and from frame to frame (RMS); no numbers where the marker was
/// never found.
struct TrajectoryRmse {
  double ate_m = kNoNumber, ate_unaligned_m = kNoNumber;
  double rpe_translation_m = kNoNumber, rpe_rotation_deg = kNoNumber;
};

/// A film: how well a marker is followed through it.
struct FilmSummary {
  std::string detector, film;
  std::int64_t frames = 0, found = 0;
  Runs tracks;                ///< Runs of frames with the marker.
  Runs gaps;                  ///< Runs of frames without it, before the first observation too.
  double median_track = 0.0;  ///< Length of a track, frames.
  Losses losses;
  double step_jitter_px = kNoNumber;  ///< Median change of the corner errors from frame to frame,
                                      ///< RMS; no number where the marker was never found.
  bool truth_aligned = false;         ///< Then there is no unaligned error.
  TrajectoryRmse trajectory;
};

/// One measure of composed images.
struct LightFigure {
  std::int64_t count = 0;  ///< Images, or recordings, that have it.
  double mean = kNoNumber;
  std::optional<Interval> interval{};  ///< Student's; unset for a single value.
};

/// Difference of a recording's composed images from the true ones.
struct LightSummary {
  std::string recording{};  ///< Empty: all, with each recording's mean as one value.
  std::int64_t pictures = 0;
  std::array<LightFigure, kImageMeasures.size()> figures{};
};

/// Hits whose ambiguity ratio lies in one decade.
struct AmbiguityBin {
  std::string detector;
  double low = 0.0, high = 0.0;
  std::int64_t count = 0;
  std::int64_t wrong = 0;  ///< The other solution was closer to the ground truth.
  std::int64_t flips = 0;  ///< Rotated by more than kFlip_deg.
  Interval rate;
};

/// Ours over the peer's; no numbers without markers, infinite where theirs is 0.
struct PeerRatio {
  double value = kNoNumber;
  Interval interval{kNoNumber, kNoNumber};  ///< Its ends are infinite where data do not bound them.
};

/// Markers by who hit them.
struct PairedHits {
  std::int64_t markers = 0, both = 0, only_ours = 0, only_peer = 0;
  double p = 1.0;  ///< McNemar's exact test.
};

/// Ours against a peer on the same scenes, each with its own print.
struct PeerSummary {
  std::string sweep{}, peer{};
  std::string film{};  ///< Of recordings: which one; empty: all of the sweep.
  PairedHits hits{};
  PeerRatio rate{}, corner{}, rotation{};
  std::int64_t our_false = 0, peer_false = 0;
};

/// Corner errors by image region: `columns` × `rows` cells.
struct ErrorMap {
  std::string detector;
  int columns = 0, rows = 0;
  std::vector<std::int64_t> counts;
  std::vector<double> median_px;
};

struct RunSummary {
  std::vector<std::string> detectors, sweeps;  ///< In the order of the records.
  std::vector<CellSummary> cells;
  std::vector<JitterSummary> jitter;
  std::vector<FilmSummary> films;
  std::vector<AmbiguityBin> ambiguity;
  std::vector<PeerSummary> peers;
  std::vector<LightSummary> light;
  std::vector<ErrorMap> maps;
  std::vector<NeesSummary> nominal_nees;  ///< Per detector: the sweep "distance".
};

/// Frames in their order; detectors of a frame in the run's order, ours first; composed images in
/// the order of recordings.
struct RunRecords {
  std::vector<FrameRecord> frames;
  std::vector<ImageRecord> pictures;
};

/// Computes all measures from the records alone, in their order, so that they do not depend on how
/// the run was divided.
RunSummary Summarize(const RunRecords& records, int image_width, int image_height);

}  // namespace pleinair::accuracy
