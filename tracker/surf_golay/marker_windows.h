#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstdint>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/alignment/reduced_images.h"

namespace pleinair::tracker {

/// Cuts out of an image, or of its halves, what a guessed marker covers, at the size that a fit
/// needs: small and in codes for finding it, as large as pays and in linear light for measuring.
class MarkerWindows {
 public:
  explicit MarkerWindows(const LensGrid& lens) : lens_(lens) {}

  /// Kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);

  /// The longest side of the marker's square in undistorted pixels; 0 where the guess is none.
  static double SidePx(const Mat3& modules_from_undistorted);

  /// Where the marker's sides are `max_side_px` at most. False where there is no such window.
  bool TakeCoarse(const Mat3& modules_from_undistorted, double max_side_px, PixelWindow* window,
                  ObservedPatch* observed);

  /// The same in linear light, where edges are where TakeFine will see them.
  bool TakeCoarseLight(const Mat3& modules_from_undistorted, double max_side_px,
                       PixelWindow* window, ObservedPatch* observed);

  /// At the size that tells the edges' places best for the blur of `state`. False where there is no
  /// window.
  bool TakeFine(const BlockFitState& state, PixelWindow* window, ObservedPatch* observed);

  /// How often images for measuring are halved at least, since noise hides the marker in them.
  void SetHalvingsForNoise(int halvings) { halvings_for_noise_ = halvings; }
  int halvings_for_noise() const { return halvings_for_noise_; }

 private:
  bool Window(const Mat3& modules_from_undistorted, int level, PixelWindow* window) const;
  /// Where the marker's sides are `max_side_px` at most.
  bool CoarseWindow(const Mat3& modules_from_undistorted, double max_side_px,
                    PixelWindow* window) const;

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  ReducedImages reduced_;
  int halvings_for_noise_ = 0;
};

}  // namespace pleinair::tracker
