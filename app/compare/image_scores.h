#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "base/image.h"

namespace pleinair::app {

/// Errors of an image against the ground truth. Color differences are means of CIEDE2000. PSNR is
/// in dB; PSNR and SSIM use 8-bit sRGB. A region without pixels gives NaN.
struct PictureScores {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double psnr = kNone, ssim = kNone;
  double color_object = kNone;  ///< Where the object covers more than half of a pixel.
  double color_shadow = kNone;  ///< Where it reduces the light on real surfaces.
  double color_near = kNone;    ///< Object, shadow and 25 pixels around them.
  double color_all = kNone;
  double psnr_near = kNone, ssim_near = kNone;

  /// In the order above, with the names used in files.
  std::array<double, 8> Values() const {
    return {psnr, ssim, color_object, color_shadow, color_near, color_all, psnr_near, ssim_near};
  }
};
inline constexpr std::array<const char*, 8> kPictureScoreNames{
    "PSNR", "SSIM", "dE_obj", "dE_shadow", "dE_near", "dE_all", "PSNR_near", "SSIM_near"};

/// Regions of the virtual object and its shadow; empty if unknown.
struct PictureRegions {
  Image<std::uint8_t> object;  ///< Coverage; 255: the whole pixel.
  Image<std::uint8_t> shadow;  ///< Above 0: darkened.
};

/// Computes PSNR from the mean squared difference of the channels. SSIM uses luma and an 11 × 11
/// Gaussian of σ 1.5 (Wang et al. 2004, "Image Quality Assessment: From Error Visibility to
/// Structural Similarity", Eq. (13), K1 = 0.01, K2 = 0.03). Scores are means over the pixels of a
/// region. All images must have the same size.
PictureScores ScorePicture(ImageView<const std::uint8_t> picture,
                           ImageView<const std::uint8_t> truth, const PictureRegions& regions);

/// CIEDE2000 of every pixel as a color map: black 0, through blue and red to white at 10 and above.
RgbImage DifferencePicture(ImageView<const std::uint8_t> picture,
                           ImageView<const std::uint8_t> truth);

/// Means over images, ignoring NaN.
PictureScores MeanOf(const PictureScores* scores, std::size_t count);

}  // namespace pleinair::app
