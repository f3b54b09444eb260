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
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/surf_golay/cell_light.h"
#include "tracker/surf_golay/cell_reader.h"
#include "tracker/surf_golay/cover_mask.h"
#include "tracker/surf_golay/pixel_noise.h"
#include "tracker/surf_golay/print_windows.h"
#include "tracker/surf_golay/sg_reading.h"

namespace pleinair::tracker {

/// Reads the marker that may be seen at a guessed place: aligns the border, reads the cells,
/// decodes the number, predicts the whole print and verifies it, then measures it to hundredths of
/// a pixel. Keeps its buffers; one thread at a time.
class SgReader {
 public:
  explicit SgReader(const LensGrid& lens) : lens_(lens), windows_(lens) {}

  Result<void> SetNumbersInUse(std::span<const int> numbers) {
    return decoder_.SetNumbersInUse(numbers);
  }

  /// The picture that the following readings look at; kept by reference.
  void SetPicture(ImageView<const std::uint8_t> grey);

  /// Of what resolution the picture is that a print is fitted to: its longest side in pixels.
  enum class Detail { kGlance, kCoarse, kFine };

  /// How well a border fits at a guess, after some steps towards a better one: the correlation.
  /// `steps` 0 only looks.
  double FitBorder(int steps, Detail detail, BlockFitState* state);

  /// Share of the border that looked as predicted in the last fit.
  double VisibleBorder() const;

  /// Finds and measures a marker of the frame before near a guess that may be some pixels off.
  std::optional<SgReading> Follow(int number, const BlockFitState& guess);

  /// Everything, from a guess that FitBorder has improved.
  std::optional<SgReading> Read(const BlockFitState& guess);

  /// A marker that lies open in even light, whole and plain to see, from a guess that is good to a
  /// pixel; nothing where anything is doubtful, and Read must tell.
  std::optional<SgReading> ReadPlain(const BlockFitState& guess);

  /// As Read, from a guess of another origin that is good already, where a fit of a border that is
  /// covered nearly everywhere could only go wrong. Whether the number is proved (IsProved) is left
  /// to those who can look at the border's pixels.
  std::optional<SgReading> ReadAsGuessed(const BlockFitState& guess) { return Read(guess, 0); }

  /// Where borders of this picture lie open (modules from ideal pixels) of which the cells told no
  /// number.
  std::span<const Mat3> UnreadBorders() const { return unread_borders_; }

  /// Measures a print whose number is known from a guess that is right to about a pixel, until a
  /// step moves no corner farther than `done_px`.
  std::optional<SgReading> Measure(int number, const BlockFitState& guess, double done_px = 0.01);

 private:
  /// Longest side of a print that is fitted coarsely, the blur it is taken to have at most, and the
  /// sides of the blocks that it and one that is measured are cut into.
  static constexpr double kCoarseSide_px = 52.0, kCoarseBlur_px = 1.2;
  static constexpr double kCoarseBlock_px = 8.0, kFineBlock_px = 14.0;
  /// A print of which less is seen is also measured from its content, and beneath its covers.
  static constexpr double kWholeEnough = 0.93;

  std::optional<SgReading> Read(const BlockFitState& guess, int border_steps);
  /// FitBorder, finely, in a reduced picture where noise hides the border in the picture itself.
  double FitBorderThroughNoise(int steps, BlockFitState* state);
  /// Reads the cells of a print whose border was fitted last: number, margin and proof. False where
  /// they tell no number.
  bool ReadNumber(const BlockFitState& state, SgReading* reading);
  /// Moves a state to where the content alone fits best.
  bool FitContent(int number, BlockFitState* state);
  /// Describes how a print that was measured looks anew, in blocks that go by where it was found.
  void LookAgain(SgReading* reading);
  /// Whether the print that was fitted last is so noisy that its pixels' own certainties mislead.
  bool IsNoisy();
  /// Fits a print that was fitted last once more, its pixels as certain as what is predicted of
  /// them, and adds its corners to the reading. The first fit and the rest of the reading stay.
  void MeasureThroughNoise(int number, BlockFitOptions options, BlockFitState state,
                           SgReading* reading);
  /// Makes the pixels of the window that do not show the content count for nothing.
  void KeepContent(const PixelWindow& window, const Mat3& modules_from_ideal);
  /// Measures a print again of which something is covered, by what surely is not.
  void LookBeneathCovers(SgReading* reading);
  std::optional<SgReading> MeasureBeneathCovers(int number, const BlockFitState& guess);
  const PrintPattern& Print(int number);
  /// Blocks along a print that is measured in that window.
  static int FineBlocks(const PixelWindow& window, const BlockFitState& state);

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  PrintWindows windows_;
  SoftGolayDecoder decoder_;
  SoftGolayDecoder any_number_;  ///< Of all 4,096, in use or not.
  SeenWindow seen_;
  BlockFit fit_;
  SeenWindow other_seen_;  ///< Where a fit at another size waits.
  BlockFit other_fit_;     ///< … or one is made whose light and looks count for nothing.
  PrintLightMeter light_meter_;
  CellReader cell_reader_;
  CoverMask cover_;
  PixelNoiseMeter noise_meter_;
  PrintPattern blank_;
  PrintPattern print_;
  int print_number_ = -1;
  std::vector<Mat3> unread_borders_;
  /// That of the last plain print of this picture: others are as far away or as much in motion.
  double plain_blur_px_ = 0.0;
};

}  // namespace pleinair::tracker
