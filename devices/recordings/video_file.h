#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Properties of a video that are known from outside its file.
struct VideoMetadata {
  /// Required frame size: the calibration's. 0x0: any size.
  ImageSize size;
  std::optional<int> frame_count;       ///< Overrides the file's own count.
  std::optional<double> frame_rate_hz;  ///< Overrides the file's own rate.
  std::vector<double> timestamps_s;     ///< One per frame; empty: index / rate.
};

struct OpenedVideo {
  std::unique_ptr<FrameSource> frames;
  double frame_rate_hz = 0.0;
  ImageSize size;
};

/// Opens a video file, decoded by FFmpeg through OpenCV. A rotation in the metadata (phones) is
/// applied. Errors: no file, empty, format unknown to FFmpeg, truncated (MP4, MOV, AVI), another
/// size, no frame rate; from Next(): fewer frames than the file or `frame_count` specifies.
Result<OpenedVideo> OpenVideo(const std::filesystem::path& file, const VideoMetadata& facts);

}  // namespace pleinair::devices
