#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace pleinair::accuracy {

/// A figure of a composed picture against the true one.
struct ImageMeasure {
  const char* name;  ///< As `pleinair compare` calls it.
  bool more_is_worse;
  /// Changes of the mean up to this are not called worse or better: nobody sees them.
  double min_change;
};

/// What `pleinair compare` gives: mean CIEDE2000 over object, shadow, both with 25 px around them,
/// everything; PSNR in dB and SSIM.
inline constexpr std::array<ImageMeasure, 8> kImageMeasures{{{"PSNR", false, 0.05},
                                                             {"SSIM", false, 0.0005},
                                                             {"dE_obj", true, 0.02},
                                                             {"dE_shadow", true, 0.02},
                                                             {"dE_near", true, 0.02},
                                                             {"dE_all", true, 0.02},
                                                             {"PSNR_near", false, 0.05},
                                                             {"SSIM_near", false, 0.0005}}};

/// How far a composed picture of a recording is from the true one.
struct ImageRecord {
  std::string recording{};
  std::string picture{};  ///< The key frame's name: "0036".
  /// In the order of kImageMeasures; nothing where a region has no pixel.
  std::array<std::optional<double>, kImageMeasures.size()> scores{};
};

}  // namespace pleinair::accuracy
