#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/alignment/reduced_images.h"

namespace pleinair::tracker {

/// Copies the window of a hypothesised marker from an image or a reduced image, at the size that a
/// fit needs: small and in 8-bit values for finding it, larger and in linear light for measuring.
class MarkerWindows {
 public:
  explicit MarkerWindows(const LensGrid& lens) : lens_(lens) {}

  /// Kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);

  /// Longest side of the marker's square in undistorted pixels; 0 if the hypothesis is invalid.
  static double SidePx(const Mat3& modules_from_undistorted);

  /// Reduced until the marker's sides are at most `max_side_px`. Returns false if there is no such
  /// window.
  bool TakeCoarse(const Mat3& modules_from_undistorted, double max_side_px, PixelWindow* window,
                  ObservedPatch* observed);

  /// The same in linear light, so that edges are where TakeFine() has them.
  bool TakeCoarseLight(const Mat3& modules_from_undistorted, double max_side_px,
                       PixelWindow* window, ObservedPatch* observed);

  /// At the size that determines the edges' positions best for the blur of `state`. Returns false
  /// if there is no window.
  bool TakeFine(const BlockFitState& state, PixelWindow* window, ObservedPatch* observed);

  /// Minimum number of halvings of images for measuring, when noise hides the marker in them.
  void SetHalvingsForNoise(int halvings) { halvings_for_noise_ = halvings; }
  int halvings_for_noise() const { return halvings_for_noise_; }

 private:
  bool Window(const Mat3& modules_from_undistorted, int level, PixelWindow* window) const;
  /// Reduced until the marker's sides are at most `max_side_px`.
  bool CoarseWindow(const Mat3& modules_from_undistorted, double max_side_px,
                    PixelWindow* window) const;

  const LensGrid& lens_;
  ImageView<const std::uint8_t> grey_;
  ReducedImages reduced_;
  int halvings_for_noise_ = 0;
};

}  // namespace pleinair::tracker
