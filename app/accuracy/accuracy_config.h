#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// The configuration that determines the results of an accuracy run. Sharding and output folder are
/// not part of it.
struct AccuracyConfig {
  std::vector<std::string> sweeps;      ///< accuracy::SweepNames(), each once, in that order.
  std::string camera = "640x480";       ///< accuracy::SweepCameraNames().
  std::uint64_t seed = 1;               ///< Seed of the scenes.
  std::uint64_t noise_seed = 1;         ///< Seed of their noise.
  double scale = 1.0;                   ///< kMinScale to kMaxScale.
  std::vector<std::string> recordings;  ///< Folders or videos with ground truth.
  bool light = true;                    ///< Also composite recordings with ground-truth images.
  std::vector<std::string> peers;       ///< "apriltag", "aruco".
  /// S-G numbers that our detector assumes to be in use in the sweeps, such as "0-49"; empty: all.
  std::vector<std::string> numbers;
  std::string measure = "blocks";  ///< "blocks" or "print".
  double spoil_corners_px = 0.0;   ///< Up to kMostSpoil_px.

  bool operator==(const AccuracyConfig&) const = default;
};

inline constexpr double kMinScale = 0.001, kMaxScale = 1000.0;
inline constexpr double kMostSpoil_px = 100.0;

inline constexpr const char* kOwnName = "pleinair";

/// Returns it as one line of JSON. The same configuration gives the same bytes.
std::string ConfigJson(const AccuracyConfig& config);

/// Errors (input): not a text of ConfigJson, or values outside the command's ranges.
Result<AccuracyConfig> ParseConfig(const std::string& json, const std::string& file);

/// Returns the command that reproduces these results, without the output folder.
std::string CommandOf(const AccuracyConfig& config);

}  // namespace pleinair::app
