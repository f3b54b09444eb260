#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Writes frames in the camera's own format to one append-only file
/// (docs/guide/reference/recordings.md, "frames.pack"). After a truncation all complete frames stay
/// readable. Frames without camera bytes (from recordings) are stored as RGB.
class FramePackWriter {
 public:
  /// Errors: the file exists already, or cannot be created.
  static Result<std::unique_ptr<FramePackWriter>> Create(const std::filesystem::path& file);
  ~FramePackWriter();
  FramePackWriter(const FramePackWriter&) = delete;
  FramePackWriter& operator=(const FramePackWriter&) = delete;

  /// Appends one complete frame. Error: the disk is full or fails; the file then ends with the
  /// previous frame and accepts no more.
  Result<void> Add(const Frame& frame);

  /// Appends a frame's record as another pack has it. Errors: as Add().
  Result<void> AddRecord(std::string_view record);

  /// Flushes to disk: frames added before survive a power cut.
  Result<void> Sync();

  std::int64_t frames() const { return frames_; }
  std::int64_t bytes() const { return size_; }

 private:
  FramePackWriter(std::filesystem::path file, int fd);
  Result<void> Fail(int error_number);

  std::filesystem::path file_;
  int fd_;
  bool failed_ = false;
  std::int64_t size_ = 0;
  std::int64_t frames_ = 0;
  std::string header_;
};

/// True if a file has the header of a frame pack, or its extension, .pack.
bool IsFramePack(const std::filesystem::path& file);

struct OpenedFramePack {
  std::unique_ptr<FrameSource> frames;
  double frame_rate_hz = 0.0;      ///< Computed from the time stamps; 0 with fewer than two frames.
  std::int64_t dropped_bytes = 0;  ///< Bytes of the file that belong to no frame, at opening.
  /// What is lost, as sentences; empty for a whole pack. Next() adds what it finds. One thread must
  /// not read it while another calls Next().
  std::shared_ptr<const std::vector<std::string>> damage;
};

/// Opens the whole frames of a pack, with the recorded time stamps, exposure and losses. A frame is
/// whole if its checksum holds. Opening reads the headers, and the first and the last frame. If
/// they are damaged, and when Next() meets a damaged frame, it reads the file once: behind damage
/// it searches for the next whole frame. FrameCount() is the number found at opening. Next()
/// returns fewer frames if it finds further damage. Time stamps count from the first whole frame.
/// `size`: required size of every frame; 0x0: the size of the first. Errors: not a frame pack, no
/// whole frame, another size.
Result<OpenedFramePack> OpenFramePack(const std::filesystem::path& file, ImageSize size);

struct RecoveredFramePack {
  std::int64_t frames = 0;
  std::vector<std::string> damage;
};

/// Copies the whole frames of a pack to a new pack, byte for byte. Calls `check` between frames and
/// stops with its error. Errors: as OpenFramePack() and FramePackWriter.
Result<RecoveredFramePack> RecoverFramePack(const std::filesystem::path& from,
                                            const std::filesystem::path& to,
                                            const std::function<Result<void>()>& check);

}  // namespace pleinair::devices
