#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "base/bounded_queue.h"
#include "base/error.h"
#include "base/image.h"
#include "base/stage_times.h"
#include "export/images/video_writer.h"

namespace pleinair::app {

/// Writes composited frames as images and to a video, on a background thread while the next frames
/// are drawn.
class CompositeWriter {
 public:
  /// `pictures`: folder for 0000.png and so on; empty: none. `video`: null: none.
  CompositeWriter(std::filesystem::path pictures, std::unique_ptr<exports::VideoWriter> video);
  ~CompositeWriter();
  CompositeWriter(const CompositeWriter&) = delete;
  CompositeWriter& operator=(const CompositeWriter&) = delete;

  /// Takes the frames in order. Errors may belong to an earlier frame.
  /// `is_written`: its image file is there already.
  Result<void> Add(std::int64_t index, std::int64_t timestamp_ns, RgbImage composed,
                   bool is_written = false);

  /// Waits until everything is written and ends the video.
  Result<void> Finish();

  /// After Finish().
  const StageTimes& times() const { return times_; }

 private:
  struct Item {
    std::int64_t index = 0;
    std::int64_t timestamp_ns = 0;
    RgbImage picture;
    bool is_written = false;
  };

  // Max. number of queued images.
  static constexpr std::size_t kWaiting = 3;

  void Run();
  Result<void> Write(const Item& item);
  void End();

  std::filesystem::path pictures_;
  std::unique_ptr<exports::VideoWriter> video_;
  // Used by the thread until it has ended.
  StageTimes times_;
  Result<void> result_;
  BoundedQueue<Item> items_{kWaiting, WhenFull::kWait};
  std::thread thread_;  // Last: it uses the other members.
};

}  // namespace pleinair::app
