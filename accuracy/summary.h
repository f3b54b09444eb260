#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "accuracy/statistics.h"

namespace pleinair::accuracy {

/// Whether a detector's covariances are as large as its errors.
struct NeesSummary {
  std::int64_t count = 0;
  double mean = 0.0;  ///< 6 if consistent,
  Interval band{};    ///< … within this with 95 %.
};

/// What one detector did with some frames: those of a level, a pattern or a sweep.
struct CellSummary {
  std::string detector, sweep;
  std::string pattern;          ///< Empty: all, or the sweep has none.
  std::optional<double> level;  ///< None: all.
  std::int64_t frames = 0, markers = 0, hits = 0, misplaced = 0, false_numbers = 0;
  Interval rate;           ///< Of hits.
  Interval false_frames;   ///< Of frames with a false number.
  std::int64_t flips = 0;  ///< Hits with a rotation error beyond kFlip_deg.
  Spread corner_px;        ///< RMS over a marker's corners, over its hits.
  /// Mean corner error: to the right and down, and away from the marker's middle.
  double bias_x_px = 0.0, bias_y_px = 0.0, bias_outward_px = 0.0;
  Spread rotation_deg, translation_m;
  Spread translation_share;         ///< Of the distance.
  std::optional<NeesSummary> nees;  ///< Of hits that are no flips.
};

/// One scene under many draws of the noise: "jitter".
struct JitterSummary {
  std::string detector, pattern;
  double level = 0.0;
  std::int64_t frames = 0;
  double corner_std_px = 0.0;   ///< Of a coordinate of a corner, mean over the eight.
  double corner_bias_px = 0.0;  ///< Its mean error, mean of the eight amounts.
  double translation_std_m = 0.0, rotation_std_deg = 0.0;
};

/// A film: how well a marker is followed through it.
struct FilmSummary {
  std::string detector, film;
  std::int64_t frames = 0, found = 0;
  std::int64_t tracks = 0;  ///< Runs of frames with the marker.
  std::int64_t longest_track = 0, longest_gap = 0;
  std::int64_t gaps = 0, recovered = 0;  ///< Runs of frames without it; those that ended.
  double step_jitter_px = 0.0;  ///< Median change of the corner errors from frame to frame, RMS.
  double ate_rmse_m = 0.0, ate_unaligned_rmse_m = 0.0;
  double rpe_translation_rmse_m = 0.0, rpe_rotation_rmse_deg = 0.0;
};

/// Hits whose ambiguity ratio lies in one tenth of 0…1.
struct AmbiguityBin {
  std::string detector;
  double low = 0.0, high = 0.0;
  std::int64_t count = 0;
  std::int64_t wrong = 0;  ///< The other solution was nearer to the truth.
  Interval rate;
};

/// Ours against a peer on the same scenes, each with its own print.
struct PeerSummary {
  std::string sweep{}, peer{};
  std::int64_t markers = 0, both = 0, only_ours = 0, only_peer = 0;
  double p = 1.0;                                                     ///< McNemar's exact test.
  double rate_ratio = 0.0, corner_ratio = 0.0, rotation_ratio = 0.0;  ///< Ours over the peer's.
  Interval rate_interval{}, corner_interval{}, rotation_interval{};
  std::int64_t our_false = 0, peer_false = 0;
};

/// Where in the picture corners are missed by how much: `columns` × `rows` cells.
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
  std::vector<ErrorMap> maps;
  std::vector<NeesSummary> nominal_nees;  ///< By detector: the sweep "distance".
};

/// The records of a run in the order of their frames, detectors of a frame in the run's order: the
/// first detector is ours. All figures are computed from these alone, in this order, so that they
/// are the same however the run was divided.
RunSummary Summarize(const std::vector<FrameRecord>& records, int picture_width,
                     int picture_height);

}  // namespace pleinair::accuracy
