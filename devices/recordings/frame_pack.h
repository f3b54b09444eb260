#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Writes frames as a camera sent them into one file that only grows
/// (docs/guide/reference/recordings.md, "frames.pack"): whatever is cut off its end, the frames
/// before stay readable. Frames without the camera's bytes (of recordings) are kept as RGB.
class FramePackWriter {
 public:
  /// Errors: the file is there already, or cannot be made.
  static Result<std::unique_ptr<FramePackWriter>> Create(const std::filesystem::path& file);
  ~FramePackWriter();
  FramePackWriter(const FramePackWriter&) = delete;
  FramePackWriter& operator=(const FramePackWriter&) = delete;

  /// Adds a frame, whole or not at all. Error: the disk is full or fails; the file then ends with
  /// the frame before, and nothing more is taken.
  Result<void> Add(const Frame& frame);

  /// Hands everything to the disk: what was added before survives a power cut.
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

/// Whether a file begins as a frame pack does.
bool IsFramePack(const std::filesystem::path& file);

struct OpenedFramePack {
  std::unique_ptr<FrameSource> frames;
  double frame_rate_hz = 0.0;      ///< By the frames' stamps; 0 with fewer than two.
  std::int64_t dropped_bytes = 0;  ///< After the last whole frame: the recording was cut there.
};

/// Opens the frames up to the last whole one, each with the stamps, exposure and losses that were
/// recorded; stamps count from the first frame. `size`: what each must have; 0x0: what the first
/// has. Errors: not such a file, no whole frame, another size; and from Next() a frame in the
/// middle that is damaged.
Result<OpenedFramePack> OpenFramePack(const std::filesystem::path& file, ImageSize size);

}  // namespace pleinair::devices
