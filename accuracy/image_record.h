#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace pleinair::accuracy {

/// A measure of a composed image against the true one.
struct ImageMeasure {
  const char* name;  ///< Name in `pleinair compare`.
  bool more_is_worse;
  /// Smaller changes of the mean are not reported: they are not visible.
  double min_change;
};

/// Results of `pleinair compare`: mean CIEDE2000 over object, shadow, both with 25 px around them,
/// and the whole image; PSNR in dB; SSIM.
inline constexpr std::array<ImageMeasure, 8> kImageMeasures{{{"PSNR", false, 0.05},
                                                             {"SSIM", false, 0.0005},
                                                             {"dE_obj", true, 0.02},
                                                             {"dE_shadow", true, 0.02},
                                                             {"dE_near", true, 0.02},
                                                             {"dE_all", true, 0.02},
                                                             {"PSNR_near", false, 0.05},
                                                             {"SSIM_near", false, 0.0005}}};

/// Difference of a composed image of a recording from the true one.
struct ImageRecord {
  std::string recording{};
  std::string picture{};  ///< Name of the key frame: "0036".
  /// In the order of kImageMeasures; unset if a region has no pixel.
  std::array<std::optional<double>, kImageMeasures.size()> scores{};
};

}  // namespace pleinair::accuracy
