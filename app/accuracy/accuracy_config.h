#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// All that decides the figures of an accuracy run; how it is divided and where it is written does
/// not.
struct AccuracyConfig {
  std::vector<std::string> sweeps;      ///< accuracy::SweepNames(), each once, in that order.
  std::string camera = "640x480";       ///< accuracy::SweepCameraNames().
  std::uint64_t seed = 1;               ///< Of scenes,
  std::uint64_t noise_seed = 1;         ///< … and of their noise.
  double scale = 1.0;                   ///< kMinScale to kMaxScale.
  std::vector<std::string> recordings;  ///< Folders or films with ground truth.
  bool light = true;                    ///< Compose recordings that have true pictures, too.
  std::vector<std::string> peers;       ///< "apriltag", "aruco".
  /// Of S-G markers that our detector may take to be in use in the sweeps, such as "0-49"; none:
  /// all of them.
  std::vector<std::string> numbers;
  std::string measure = "blocks";  ///< "blocks" or "print".
  double spoil_corners_px = 0.0;   ///< Up to kMostSpoil_px.

  bool operator==(const AccuracyConfig&) const = default;
};

inline constexpr double kMinScale = 0.001, kMaxScale = 1000.0;
inline constexpr double kMostSpoil_px = 100.0;

inline constexpr const char* kOwnName = "pleinair";

/// As one line of JSON; the same configuration gives the same bytes.
std::string ConfigJson(const AccuracyConfig& config);

/// Errors (input): not what ConfigJson writes, or outside what the command takes.
Result<AccuracyConfig> ParseConfig(const std::string& json, const std::string& file);

/// The command that gives these figures, without where they go.
std::string CommandOf(const AccuracyConfig& config);

}  // namespace pleinair::app
