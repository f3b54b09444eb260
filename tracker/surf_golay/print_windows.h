#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstdint>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/reduced_pictures.h"
#include "tracker/alignment/seen_window.h"

namespace pleinair::tracker {

/// Cuts out of a picture, or of its halves, what a guessed print covers, at the size that a fit
/// needs: small and in codes for finding it, as large as pays and in linear light for measuring.
class PrintWindows {
 public:
  explicit PrintWindows(const LensGrid& lens) : lens_(lens) {}

  /// Kept by reference.
  void SetPicture(ImageView<const std::uint8_t> grey);

  /// The longest side of the print's square in ideal pixels; 0 where the guess is none.
  static double SidePx(const Mat3& modules_from_ideal);

  /// Where the print's sides are `most_side_px` at most. False where there is no such window.
  bool TakeCoarse(const Mat3& modules_from_ideal, double most_side_px, PixelWindow* window,
                  SeenWindow* seen);

  /// The same in linear light, where edges are where TakeFine will see them.
  bool TakeCoarseLight(const Mat3& modules_from_ideal, double most_side_px, PixelWindow* window,
                       SeenWindow* seen);

  /// At the size that tells the edges' places best for the blur of `state`. False where there is no
  /// window.
  bool TakeFine(const BlockFitState& state, PixelWindow* window, SeenWindow* seen);

  /// How often pictures for measuring are halved at least, since noise hides the print in them.
  void SetHalvingsForNoise(int halvings) { halvings_for_noise_ = halvings; }
  int halvings_for_noise() const { return halvings_for_noise_; }

 private:
  bool Window(const Mat3& modules_from_ideal, int level, PixelWindow* window) const;
  /// Where the print's sides are `most_side_px` at most.
  bool CoarseWindow(const Mat3& modules_from_ideal, double most_side_px, PixelWindow* window) const;

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  ReducedPictures reduced_;
  int halvings_for_noise_ = 0;
};

}  // namespace pleinair::tracker
