#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "devices/frame.h"

namespace pleinair::devices {

/// Magic number at the start of the file.
inline constexpr std::string_view kFramePackStart = "pleinair frames\n";

/// Header before each frame; all numbers little-endian. The checksum (CRC-32 of zlib) covers
/// metadata and image.
struct FrameRecordHead {
  static constexpr std::size_t kBytes = 24;
  static constexpr std::string_view kMagic = "FRAM";
  /// The mandatory keys take more bytes. The limit bounds the number of forged records in a file,
  /// and thereby the memory for their places.
  static constexpr std::uint32_t kMinMetadataBytes = 100;
  static constexpr std::uint32_t kMaxMetadataBytes = 64 * 1024;
  static constexpr std::uint64_t kMaxImageBytes = std::uint64_t{1} << 31;

  std::uint32_t metadata_bytes = 0;
  std::uint64_t image_bytes = 0;
  std::uint32_t checksum = 0;

  /// Appends kBytes bytes.
  void Append(std::string* bytes) const;
  /// Reads kBytes bytes. Nullopt: not a frame header.
  static std::optional<FrameRecordHead> Decode(std::string_view bytes);
};

/// Metadata of a frame (everything except pixels) as one line of JSON, and back. `layout` has no
/// bytes.
std::string FrameMetadataJson(const Frame& frame, const RawImage& layout);
struct FrameMetadata {
  Frame frame;
  RawImage layout;
};
/// Nullopt: damaged.
std::optional<FrameMetadata> ParseFrameMetadata(std::string_view json);

}  // namespace pleinair::devices
