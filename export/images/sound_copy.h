#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/error.h"
#include "devices/films/libav_pointer.h"
#include "export/images/copied_sound.h"

namespace pleinair::exports {

/// Copies a film's sound track into a video that is being written.
class SoundCopy {
 public:
  /// Adds a track to `output`, before its header is written. Null, with the reason in
  /// `*why_not` (a sentence for the user), where the film has no sound or the container cannot hold
  /// it. Errors: the film cannot be opened.
  static Result<std::unique_ptr<SoundCopy>> Add(const CopiedSound& sound, AVFormatContext* output,
                                                std::string* why_not);

  /// Writes what sounds before `time_s` of the output. Returns libav's error number of a failed
  /// write, else 0. A damaged sound track ends the copy.
  int WriteUntil(double time_s);

 private:
  SoundCopy(devices::LibavPointer<AVFormatContext> input, int from, AVFormatContext* output, int to,
            double start_s);
  bool ReadNext();

  devices::LibavPointer<AVFormatContext> input_;
  int from_, to_;
  AVFormatContext* output_;  // Owned by the writer.
  double start_s_;
  devices::LibavPointer<AVPacket> next_;  // The packet to be written next.
  bool has_next_ = false;
  std::int64_t last_ticks_ = INT64_MIN;  // Decoding time of the last packet that was read.
};

}  // namespace pleinair::exports
