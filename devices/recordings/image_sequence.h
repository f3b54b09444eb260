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

/// One image of a sequence and its stamps.
struct SequenceFrame {
  std::filesystem::path file;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  std::optional<std::int64_t> device_timestamp_ns;
};

/// The PNG and JPEG files in `folder` in the order of the number that ends their names, with or
/// without leading zeros ("0000.jpg", "frame_12.png"); other files are passed over.
/// Errors: no such folder or none in it, a number twice, a number missing between the first and
/// the last, another count than `promised`.
Result<std::vector<std::filesystem::path>> ListNumberedImages(const std::filesystem::path& folder,
                                                              std::optional<int> promised);

/// Frames from image files, decoded one by one. All files are looked at first.
/// Errors: an image that is missing, cut short, no image, or not of `size`.
Result<std::unique_ptr<FrameSource>> OpenImageSequence(std::vector<SequenceFrame> frames,
                                                       ImageSize size);

}  // namespace pleinair::devices
