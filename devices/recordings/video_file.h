#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// What is known of a video apart from its file.
struct VideoMetadata {
  /// What every frame must have: the calibration's. 0x0: whatever size the film has.
  ImageSize size;
  std::optional<int> frame_count;       ///< Overrides what the file itself says.
  std::optional<double> frame_rate_hz;  ///< Overrides what the file itself says.
  std::vector<double> timestamps_s;     ///< One a frame; empty: index / rate.
};

struct OpenedVideo {
  std::unique_ptr<FrameSource> frames;
  double frame_rate_hz = 0.0;
  ImageSize size;
};

/// Frames of a video file, decoded by FFmpeg through OpenCV; a turn said in the file (phones) is
/// applied.
/// Errors: no file, empty, no video FFmpeg knows, cut short (MP4, MOV, AVI), another size, no
/// frame rate; and from Next() fewer frames than the file or `frame_count` promises.
Result<OpenedVideo> OpenVideo(const std::filesystem::path& file, const VideoMetadata& facts);

}  // namespace pleinair::devices
