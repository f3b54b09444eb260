#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/recordings/frame_pack_format.h"

namespace pleinair::devices {

/// Position of a frame's record in the file.
struct FramePackPlace {
  std::int64_t at = 0;
  FrameRecordHead head;
  std::int64_t timestamp_ns = 0;

  std::int64_t bytes() const {
    return static_cast<std::int64_t>(FrameRecordHead::kBytes + head.metadata_bytes +
                                     head.image_bytes);
  }
};

/// The whole frames of a file, and the bytes between them.
struct FramePackScan {
  std::vector<FramePackPlace> places;
  std::int64_t file_bytes = 0;

  std::int64_t LostBytes() const;
  /// What is lost, as sentences: where in the file, and between which times.
  std::vector<std::string> Damage(const std::filesystem::path& file) const;
};

/// Reads the whole file. A record that is cut or whose checksum fails is passed over: the search
/// for the next whole one begins behind its first byte, because its lengths may be wrong. The
/// search reads at most four times the file's size, so that made-up records cannot prolong it.
/// Errors (input): cannot be read; no whole frame.
Result<FramePackScan> ScanFramePack(const std::filesystem::path& file);

/// Reads a record. Nullopt: its bytes are not there, its checksum fails or its metadata are
/// damaged.
std::optional<FrameMetadata> ReadFramePackRecord(std::ifstream& file, const FramePackPlace& place);

}  // namespace pleinair::devices
