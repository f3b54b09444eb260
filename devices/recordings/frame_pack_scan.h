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

/// A frame's record in a frames.pack.
struct FramePackPlace {
  std::int64_t at = 0;  ///< Offset of its first byte in the file.
  FrameRecordHead head;
  std::int64_t timestamp_ns = 0;  ///< From WalkFramePack(): 0 but for the first and last.

  std::int64_t bytes() const {
    return static_cast<std::int64_t>(FrameRecordHead::kBytes + head.metadata_bytes +
                                     head.image_bytes);
  }
};

/// The whole frames of a frames.pack, in order. A frame is whole if its checksum holds.
struct FramePackScan {
  std::vector<FramePackPlace> places;
  std::int64_t file_bytes = 0;

  /// Bytes that belong to no whole frame, without the file's start.
  std::int64_t LostBytes() const;
  /// What is lost, as sentences: where in the file, and between which times.
  std::vector<std::string> Damage(const std::filesystem::path& file) const;
};

/// Finds the records of a frames.pack by their headers alone. Cost: one header per frame. It checks
/// only the first and the last record as a whole, because a power cut damages the end. Nullopt: the
/// headers do not lead to the end of the file, or one of the two records is damaged.
/// ScanFramePack() then finds the whole frames.
std::optional<FramePackScan> WalkFramePack(const std::filesystem::path& file);

/// Finds the whole frames of a frames.pack, also of a cut or damaged one. A damaged record is
/// skipped. Its lengths may be wrong, so the search for the next whole one begins behind its first
/// byte. Failed searches read at most four times the file's size in all, so that forged records
/// cannot prolong them. Errors (input): the file cannot be read; it has no whole frame.
Result<FramePackScan> ScanFramePack(const std::filesystem::path& file);

/// Reads a record. Nullopt: its bytes are not there, its checksum fails or its metadata are
/// damaged.
std::optional<FrameMetadata> ReadFramePackRecord(std::ifstream& file, const FramePackPlace& place);

}  // namespace pleinair::devices
