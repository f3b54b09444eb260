#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "tracker/observation.h"

namespace pleinair::app {

/// Writes detections.jsonl: one line per frame, also without observations, in the form of `pleinair
/// detect`:
/// {"frame":0,"timestamp_s":0.0,"markers":[…],"lost":[…]}
/// It contains no durations, so that two replays give the same bytes.
class DetectionsWriter {
 public:
  static Result<DetectionsWriter> Create(const std::filesystem::path& file);

  /// The line of a frame, without its end.
  static std::string Line(std::int64_t frame_index, std::int64_t timestamp_ns,
                          const std::vector<tracker::MarkerObservation>& observations,
                          const std::vector<tracker::LostMarker>& lost);

  Result<void> Add(const std::string& line);
  Result<void> Finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path file_;
  std::unique_ptr<std::FILE, CloseFile> out_;
};

}  // namespace pleinair::app
