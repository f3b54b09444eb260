#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// One image of a sequence, with its time stamps.
struct SequenceFrame {
  std::filesystem::path file;
  std::int64_t timestamp_ns = 0;  ///< Since the start of the recording.
  std::optional<std::int64_t> device_timestamp_ns;
};

/// The PNG and JPEG files in `folder`, sorted by the number at the end of their names, with or
/// without leading zeros ("0000.jpg", "frame_12.png"). Other files are ignored. Errors: no such
/// folder or no images; duplicate numbers; gaps in the numbers; a count other than `promised`.
Result<std::vector<std::filesystem::path>> ListNumberedImages(const std::filesystem::path& folder,
                                                              std::optional<int> promised);

/// Opens frames from image files, which are decoded one by one. All headers are checked first.
/// Errors: an image that is missing, truncated, not an image, or not of `size`.
Result<std::unique_ptr<FrameSource>> OpenImageSequence(std::vector<SequenceFrame> frames,
                                                       ImageSize size);

}  // namespace pleinair::devices
