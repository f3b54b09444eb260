#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/images/picture_file.h"

namespace pleinair::devices {

/// One picture of a sequence and its stamps.
struct SequenceFrame {
  std::filesystem::path file;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  std::optional<std::int64_t> device_timestamp_ns;
};

/// The PNG and JPEG files in `folder` in the order of the number that ends their names, with or
/// without leading zeros ("0000.jpg", "frame_12.png"); other files are passed over.
/// Errors: no such folder or none in it, a number twice, a number missing between the first and
/// the last, another count than `promised`.
Result<std::vector<std::filesystem::path>> ListNumberedPictures(const std::filesystem::path& folder,
                                                                std::optional<int> promised);

/// Frames from picture files, decoded one by one. All files are looked at first.
/// Errors: a picture that is missing, cut short, no picture, or not of `size`.
Result<std::unique_ptr<FrameSource>> OpenPictureSequence(std::vector<SequenceFrame> frames,
                                                         PictureSize size);

}  // namespace pleinair::devices
