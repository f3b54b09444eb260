#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "devices/frame.h"

namespace pleinair::devices {

/// First bytes of the file.
inline constexpr std::string_view kFramePackStart = "pleinair frames\n";

/// What stands before each frame: all numbers little-endian. The checksum (CRC-32 of zlib) is over
/// the facts and the image.
struct FrameRecordHead {
  static constexpr std::size_t kBytes = 24;
  static constexpr std::string_view kMagic = "FRAM";
  static constexpr std::uint32_t kMaxMetadataBytes = 64 * 1024;
  static constexpr std::uint64_t kMaxImageBytes = std::uint64_t{1} << 31;

  std::uint32_t metadata_bytes = 0;
  std::uint64_t image_bytes = 0;
  std::uint32_t checksum = 0;

  /// Adds kBytes.
  void Append(std::string* bytes) const;
  /// Takes kBytes. Nothing: these bytes begin no frame.
  static std::optional<FrameRecordHead> Decode(std::string_view bytes);
};

/// Everything of a frame but its pixels, as one line of JSON, and back. `layout` has no bytes.
std::string FrameMetadataJson(const Frame& frame, const RawImage& layout);
struct FrameMetadata {
  Frame frame;
  RawImage layout;
};
/// Nothing: damaged.
std::optional<FrameMetadata> ParseFrameMetadata(std::string_view json);

}  // namespace pleinair::devices
