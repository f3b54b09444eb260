#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

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

/// True if a file has the header of a frame pack.
bool IsFramePack(const std::filesystem::path& file);

struct OpenedFramePack {
  std::unique_ptr<FrameSource> frames;
  double frame_rate_hz = 0.0;      ///< Computed from the time stamps; 0 with fewer than two frames.
  std::int64_t dropped_bytes = 0;  ///< Bytes after the last complete frame: the recording was
                                   ///< truncated there.
};

/// Opens the complete frames of a pack, with the recorded time stamps, exposure and losses. Time
/// stamps count from the first frame. `size`: required size of every frame; 0x0: the size of the
/// first. Errors: not a frame pack, no complete frame, another size; from Next(): a damaged frame
/// before the end.
Result<OpenedFramePack> OpenFramePack(const std::filesystem::path& file, ImageSize size);

}  // namespace pleinair::devices
