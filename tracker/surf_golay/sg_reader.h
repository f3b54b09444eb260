#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf_golay/cell_light.h"
#include "tracker/surf_golay/cover_mask.h"
#include "tracker/surf_golay/fitted_patch.h"
#include "tracker/surf_golay/marker_windows.h"
#include "tracker/surf_golay/number_decoder.h"
#include "tracker/surf_golay/pixel_noise.h"
#include "tracker/surf_golay/sg_patterns.h"
#include "tracker/surf_golay/sg_reading.h"

namespace pleinair::tracker {

/// Reads the marker that may be observed at a guessed place: aligns the border, reads the cells,
/// decodes the number, predicts the whole marker and verifies it, then measures it to hundredths of
/// a pixel. Keeps its buffers; one thread at a time.
class SgReader {
 public:
  explicit SgReader(const LensGrid& lens) : lens_(lens), windows_(lens) {}

  Result<void> SetNumbersInUse(std::span<const int> numbers) {
    return numbers_.SetNumbersInUse(numbers);
  }

  /// The image that the following readings look at; kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);

  /// Of what resolution the image is that a marker is fitted to: its longest side in pixels.
  enum class Detail { kProbe, kCoarse, kFine };

  /// How well a border fits at a guess, after some steps towards a better one: the correlation.
  /// `steps` 0 only looks.
  double FitBorder(int steps, Detail detail, BlockFitState* state);

  /// Share of the border that looked as predicted in the last fit.
  double VisibleBorder() const;

  /// Finds and measures a marker of the frame before near a guess that may be some pixels off.
  std::optional<SgReading> Track(int number, const BlockFitState& guess);

  /// Everything, from a guess that FitBorder has improved.
  std::optional<SgReading> DecodeFull(const BlockFitState& guess);

  /// A marker that lies open in even light, whole and plain to see, from a guess that is good to a
  /// pixel; nothing where anything is doubtful, and Read must tell.
  std::optional<SgReading> DecodeFast(const BlockFitState& guess);

  /// As Read, from a guess of another origin that is good already, where a fit of a border that is
  /// covered nearly everywhere could only go wrong. Whether the number is proved (IsConfident) is
  /// left to those who can look at the border's pixels.
  std::optional<SgReading> DecodeAsGuessed(const BlockFitState& guess) {
    return DecodeFull(guess, 0);
  }

  /// Where borders of this image lie open (modules from undistorted pixels) of which the cells told
  /// no number.
  std::span<const Mat3> UnreadBorders() const { return unread_borders_; }

  /// Measures a marker whose number is known from a guess that is right to about a pixel, until a
  /// step moves no corner farther than `done_px`.
  std::optional<SgReading> Measure(int number, const BlockFitState& guess, double done_px = 0.01);

 private:
  /// Longest side of a marker that is fitted coarsely, the blur it is taken to have at most, and
  /// the sides of the blocks that it and one that is measured are cut into.
  static constexpr double kCoarseSide_px = 52.0, kCoarseBlur_px = 1.2;
  static constexpr double kCoarseBlock_px = 8.0, kFineBlock_px = 14.0;
  /// A marker of which less is observed is also measured from its content, and beneath its covers.
  static constexpr double kNearlyAllVisible = 0.93;

  std::optional<SgReading> DecodeFull(const BlockFitState& guess, int border_steps);
  /// FitBorder, finely, in a reduced image where noise hides the border in the image itself.
  double FitBorderThroughNoise(int steps, BlockFitState* state);
  /// Reads the cells of a marker whose border was fitted last.
  std::optional<DecodedNumber> DecodeNumber(const BlockFitState& state);
  /// Moves a state to where the content alone fits best.
  bool FitContent(int number, BlockFitState* state);
  /// Describes how a marker that was measured looks anew, in blocks that go by where it was found.
  void DescribeAnew(SgReading* reading);
  /// Whether the marker that was fitted last is so noisy that its pixels' own certainties mislead.
  bool IsNoisy();
  /// Fits a marker that was fitted last once more, its pixels as certain as what is predicted of
  /// them, and adds its corners to the reading. The first fit and the rest of the reading stay.
  void MeasureThroughNoise(int number, BlockFitOptions options, BlockFitState state,
                           SgReading* reading);
  /// Makes the pixels of the window that do not show the content count for nothing.
  void KeepContent(const PixelWindow& window, const Mat3& modules_from_undistorted);
  /// Measures a marker again of which something is covered, by what surely is not.
  void RefineBeneathCovers(SgReading* reading);
  std::optional<SgReading> MeasureBeneathCovers(int number, const BlockFitState& guess);
  /// Blocks along a marker that is measured in that window.
  static int FineBlocks(const PixelWindow& window, const BlockFitState& state);

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  MarkerWindows windows_;
  NumberDecoder numbers_;
  SgPatterns patterns_;
  FittedPatch fitted_;
  /// Where a fit at another size waits, or one is made whose light and looks count for nothing.
  FittedPatch other_;
  CoverMask cover_;
  MarkerLightEstimator cover_light_;  ///< Of a marker that something covers.
  PixelNoiseEstimator noise_estimator_;
  std::vector<Mat3> unread_borders_;
  /// That of the last plain marker of this image: others are as far away or as much in motion.
  double plain_blur_px_ = 0.0;
};

}  // namespace pleinair::tracker
