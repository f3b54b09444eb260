#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace pleinair::scene {

/// A camera trajectory that another program has estimated, and how it relates to the recording.
struct TrajectoryDescription {
  std::filesystem::path file;
  std::string format;                ///< "tum", "colmap", …; empty: by the file's name.
  std::filesystem::path points;      ///< File of places that align it; empty: the marker aligns it.
  std::filesystem::path extrinsics;  ///< sensor.yaml of a EuRoC camera; empty: body and camera are
                                     ///< one.
  std::optional<double> offset_s;    ///< Time of the recording minus its time; unset: estimated.
  std::optional<double> scale;       ///< Metres of one of its units; unset: by its format.
  bool is_scale_free = false;        ///< Its unit is not known, whatever its format.
  int turn_deg = 0;  ///< Frames are turned clockwise against its images by 0, 90, 180 or 270.
  /// Longest time between poses across which poses are interpolated.
  std::optional<double> max_gap_s;
  std::optional<double> frame_rate_hz;  ///< Images a second of a COLMAP model; unset: an image's
                                        ///< number is that of its frame.
};

}  // namespace pleinair::scene
