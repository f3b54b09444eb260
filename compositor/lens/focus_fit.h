#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pleinair::compositor {

/// Blur of one side of a print in one frame.
struct BlurReading {
  std::int64_t frame_index = 0;
  double timestamp_s = 0.0;       ///< Since the recording's start.
  int side = 0;                   ///< 0 top, 1 left, 2 bottom, 3 right; 0 and 2 are parallel.
  double dioptres = 0.0;          ///< Mean of 1/z along the side, 1/m.
  double dioptres_squared = 0.0;  ///< Mean of 1/z² along the side, 1/m².
  double blur_px = 0.0;           ///< Root of the edge spread's second moment.
  double error_px = 0.0;          ///< Its standard deviation, by the profile's residuals.
  /// Mean of the squared speed across the edge, (px/s)²; 0 where it is not known.
  double squared_speed = 0.0;
};

/// What is known of the lens beforehand.
struct KnownLens {
  std::optional<double> aperture_m{}, focus_dioptres{}, exposure_s{};
};

/// Focus in a part of a recording whose focus changes.
struct FocusAt {
  double timestamp_s = 0.0, focus_dioptres = 0.0, error = 0.0;
};

/// Focus and aperture by the blur of a print at several distances.
struct FocusFit {
  std::string reason;  ///< Why nothing was measured; empty: measured.
  double aperture_m = 0.0, aperture_relative_error = 0.0;
  double focus_dioptres = 0.0, focus_dioptres_error = 0.0;
  double in_focus_blur_px = 0.0;             ///< σ₀: the lens's own blur, and the pixel's width.
  double exposure_s = 0.0;                   ///< By the edges along the motion; 0: none is seen.
  std::size_t readings = 0;                  ///< That were used.
  double nearest_m = 0.0, farthest_m = 0.0;  ///< Distances of the print's centre.
  std::vector<FocusAt> changes;  ///< Where the focus changes: its course. Empty: constant.

  bool is_measured() const { return reason.empty(); }
};

/// The farthest distance of the print's centre over the nearest one, below which blur does not tell
/// the focus.
inline constexpr double kLeastDistanceChange = 1.15;

/// Fits σ² = σ₀² + (fx D / 4)² (1/z − 1/z_f)² + (v t)² / 12 to the readings. A uniform disc of
/// diameter d has the second moment (d/4)² along a line. A motion of length v t has (v t)²/12.
/// It is linear in powers of 1/z, so that nothing has to be guessed. Weighted by 1 / (2 σ s)²,
/// three rounds with Huber weights. Some sides blur by more than 15 % beyond those across them at
/// the same depth. They are moved by what the poses do not show, and are left out.
///
/// Errors: the larger of the formal one and of the jackknife over eighths of the frames. Refuses
/// where the print's distance changes too little, and where the parabola is not curved by three
/// standard errors. It also refuses where the blur at both ends exceeds σ₀ by less than 0.15 px,
/// and where the focus is not known to 0.1 dioptres plus a tenth.
///
/// `fx`: focal length, pixels. Readings in order of frames.
FocusFit FitFocus(std::span<const BlurReading> readings, double fx, const KnownLens& known = {});

}  // namespace pleinair::compositor
