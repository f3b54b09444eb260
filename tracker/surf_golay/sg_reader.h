#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf_golay/cells/cell_light.h"
#include "tracker/surf_golay/cells/number_decoder.h"
#include "tracker/surf_golay/cells/pixel_noise.h"
#include "tracker/surf_golay/cover_mask.h"
#include "tracker/surf_golay/fitted_patch.h"
#include "tracker/surf_golay/marker_windows.h"
#include "tracker/surf_golay/sg_patterns.h"
#include "tracker/surf_golay/sg_reading.h"

namespace pleinair::tracker {

/// Decodes and measures the marker at a hypothesised position: aligns the border, estimates the
/// cells, decodes the number, predicts the whole marker and verifies it, then measures it to
/// hundredths of a pixel. Reuses its buffers; one thread at a time.
class SgReader {
 public:
  explicit SgReader(const LensGrid& lens) : lens_(lens), windows_(lens) {}

  Result<void> SetNumbersInUse(std::span<const int> numbers) {
    return numbers_.SetNumbersInUse(numbers);
  }

  /// Image for the following readings; kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);

  /// Resolution of a fit: the marker's longest side in pixels.
  enum class Detail { kProbe, kCoarse, kFine };

  /// Correlation of a border with the image at a hypothesis, after some steps of fitting. `steps` 0
  /// evaluates only.
  double FitBorder(int steps, Detail detail, BlockFitState* state);

  /// Share of the border that matched the prediction in the last fit.
  double VisibleBorder() const;

  /// Finds and measures a marker of the previous frame near a prediction that may be some pixels
  /// off.
  std::optional<SgReading> Track(int number, const BlockFitState& guess);

  /// Full decode, from a hypothesis that FitBorder() has improved.
  std::optional<SgReading> DecodeFull(const BlockFitState& guess);

  /// Fast decode of a completely visible, uniformly lit marker, from a hypothesis accurate to a
  /// pixel. Returns nullopt in any doubt; DecodeFull() must then decide.
  std::optional<SgReading> DecodeFast(const BlockFitState& guess);

  /// As DecodeFull(), from a hypothesis of another origin that is accurate already, where a fit of
  /// a mostly occluded border could only make it worse. The caller checks the confidence
  /// (IsConfident) from the border's pixels.
  std::optional<SgReading> DecodeAsGuessed(const BlockFitState& guess) {
    return DecodeFull(guess, 0);
  }

  /// Unoccluded borders of this image (modules from undistorted pixels) whose cells gave no number.
  /// Not those whose cells show a number that is not in use.
  std::span<const Mat3> UnreadBorders() const { return unread_borders_; }

  /// Measures a marker of unknown number by its border alone. The reading's number has no meaning;
  /// its visible share is that of the border.
  std::optional<SgReading> MeasureBorder(const BlockFitState& guess);

  /// Measures a marker with a known number from a hypothesis accurate to about a pixel, until a
  /// step moves no corner farther than `done_px`.
  std::optional<SgReading> Measure(int number, const BlockFitState& guess,
                                   double done_px = kDone_px);

 private:
  static constexpr double kDone_px = 0.01;
  /// Longest side and maximum blur of a marker in coarse fits, and the block sizes of coarse fits
  /// and of measurements.
  static constexpr double kCoarseSide_px = 52.0, kCoarseBlur_px = 1.2;
  static constexpr double kCoarseBlock_px = 8.0, kFineBlock_px = 14.0;
  /// A marker with a smaller visible share is also measured from its content, and with a mask of
  /// its occluders.
  static constexpr double kNearlyAllVisible = 0.93;

  std::optional<SgReading> DecodeFull(const BlockFitState& guess, int border_steps);
  /// FitBorder(), fine, in a reduced image if noise hides the border in the full one.
  double FitBorderThroughNoise(int steps, BlockFitState* state);
  /// Estimates and decodes the cells of the marker whose border was fitted last.
  std::optional<DecodedNumber> DecodeNumber(const BlockFitState& state);
  /// Measures a marker whose number was decoded at a state, and verifies both.
  std::optional<SgReading> MeasureDecoded(DecodedNumber number, const BlockFitState& state);
  /// Refines a state by a fit of the content alone.
  bool FitContent(int number, BlockFitState* state);
  /// Measures again from a fit of the content alone, and keeps what explains more. An occluder of
  /// the border has edges of its own that resemble the marker's; the content pulls the fit away
  /// from them.
  void LetContentPull(const BlockFitState& guess, SgReading* reading);
  /// Recomputes the appearance of a measured marker, in blocks that depend on the first reading
  /// only.
  void DescribeAnew(SgReading* reading);
  /// Whether the inside of the last fit, of `reading`, correlates as well as its noise allows.
  bool InsideFits(const SgReading& reading) const;
  /// Whether the marker that was fitted last is so noisy that its pixels' own inverse variances are
  /// misleading.
  bool IsNoisy();
  /// Measure() and MeasureBorder() without the number.
  std::optional<SgReading> MeasurePattern(const MarkerPattern& pattern, MarkerPart part,
                                          const BlockFitState& guess, double done_px);
  /// Repeats the last fit with inverse variances from the predicted light, and adds its corners to
  /// the reading. The first fit and the rest of the reading stay.
  void MeasureThroughNoise(const MarkerPattern& pattern, MarkerPart part, BlockFitOptions options,
                           BlockFitState state, SgReading* reading);
  /// Sets the weight of all pixels of the window outside the content to zero.
  void KeepContent(const PixelWindow& window, const Mat3& modules_from_undistorted);
  /// Measures a partly occluded marker again, without the occluded pixels.
  void RefineBeneathCovers(SgReading* reading);
  std::optional<SgReading> MeasureBeneathCovers(int number, const BlockFitState& guess);
  /// Number of blocks along a marker that is measured in that window.
  static int FineBlocks(const PixelWindow& window, const BlockFitState& state);

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  MarkerWindows windows_;
  NumberDecoder numbers_;
  SgPatterns patterns_;
  FittedPatch fitted_;
  /// Stores a fit at another size, or one that is used for its position only.
  FittedPatch other_;
  CoverMask cover_;
  MarkerLightEstimator cover_light_;  ///< For partly occluded markers.
  PixelNoiseEstimator noise_estimator_;
  std::vector<Mat3> unread_borders_;
  /// Blur of the last clearly visible marker of this image; others have a similar distance or
  /// motion.
  double plain_blur_px_ = 0.0;
};

}  // namespace pleinair::tracker
