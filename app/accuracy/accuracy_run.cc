#include "app/accuracy/accuracy_run.h"

#include <sys/utsname.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "accuracy/detector.h"
#include "accuracy/scoring.h"
#include "accuracy/sweeps.h"
#include "app/accuracy/light_run.h"
#include "app/accuracy/own_detector.h"
#include "app/accuracy/recording_run.h"
#include "app/options/marker_numbers.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "session/scene_marker.h"

namespace pleinair::app {
namespace {

/// A detector and the renderer of frames with its marker.
struct Station {
  std::string name;
  std::unique_ptr<accuracy::Detector> detector;
  std::unique_ptr<accuracy::FrameRenderer> renderer;
};

std::unique_ptr<accuracy::Detector> MakeDetector(const std::string& name,
                                                 const AccuracyConfig& config,
                                                 const CameraModel& camera) {
  if (name == "apriltag") return accuracy::MakeAprilTagPeer(camera);
  if (name == "aruco") return accuracy::MakeArucoPeer(camera);
  OwnDetectorOptions options;
  options.tracker.families = {session::kSgFamily};
  options.tracker.marker_size_m = accuracy::kMarkerEdge.value();
  options.tracker.sg.numbers_in_use = MarkerNumbersOf(config.numbers).value_or(std::vector<int>());
  options.measure_prints = config.measure == "print";
  options.spoil_corners_px = config.spoil_corners_px;
  return MakeOwnDetector(camera, options);
}

std::vector<Station> MakeStations(const AccuracyConfig& config) {
  const CameraModel camera = accuracy::SweepCamera(config.camera);
  std::vector<std::string> names{kOwnName};
  names.insert(names.end(), config.peers.begin(), config.peers.end());
  std::vector<Station> stations;
  for (const std::string& name : names) {
    Station station{name, MakeDetector(name, config, camera), nullptr};
    station.renderer = std::make_unique<accuracy::FrameRenderer>(
        camera, station.detector->Patterns(), config.seed, config.noise_seed);
    stations.push_back(std::move(station));
  }
  return stations;
}

/// "Linux 6.1.0 x86_64, Intel(R) Xeon(R) …, 2 threads".
std::string MachineName() {
  utsname system{};
  uname(&system);
  std::string name = std::string(system.sysname) + " " + system.release + " " + system.machine;
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    name += ", " + line.substr(std::min(line.size(), line.find(':') + 2));
    break;
  }
  return name + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

Result<void> MeasureRun(const accuracy::FrameRun& run, std::int64_t first_frame, Station* station,
                        std::vector<accuracy::FrameRecord>* records) {
  if (run.film) PLEINAIR_RETURN_IF_ERROR(station->detector->Start(true));
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const accuracy::FrameSpec& spec = run.frames[i];
    if (!run.film) PLEINAIR_RETURN_IF_ERROR(station->detector->Start(false));
    const accuracy::RenderedFrame frame = station->renderer->Render(spec);
    PLEINAIR_ASSIGN_OR_RETURN(accuracy::Detector::Detections seen,
                              station->detector->Detect(frame.grey.view()));
    accuracy::FrameRecord record{.frame = first_frame + static_cast<std::int64_t>(i),
                                 .name = spec.name,
                                 .sweep = spec.sweep,
                                 .pattern = spec.pattern,
                                 .level = spec.level,
                                 .repeat = spec.repeat,
                                 .detector = station->name};
    accuracy::Score(frame.truth, seen.markers, &record);
    record.lost = seen.lost;
    record.stages_ms = std::move(seen.stages_ms);
    records->push_back(std::move(record));
  }
  return {};
}

/// Sorts the records by frame. They were measured detector by detector.
void SortByFrame(std::vector<accuracy::FrameRecord>* records) {
  std::stable_sort(records->begin(), records->end(),
                   [](const accuracy::FrameRecord& a, const accuracy::FrameRecord& b) {
                     return a.frame < b.frame;
                   });
}

/// Measures a recording's frames or its composited images. Skips what cannot be measured.
Result<RecordPart> MeasureRecordingChunk(const AccuracyChunk& chunk, RecordPart part,
                                         const AccuracyConfig& config) {
  if (chunk.light) {
    auto pictures = MeasureLight(*chunk.recording);
    // If interrupted while compositing, nothing must be written.
    if (!pictures && InterruptGuard::Interrupted()) return tl::make_unexpected(pictures.error());
    if (pictures) {
      part.pictures = *std::move(pictures);
    } else {
      part.skipped = pictures.error().Message();
      part.skipped_kind = pictures.error().kind;
    }
    return part;
  }
  auto records = MeasureRecording(*chunk.recording, FirstFrameOf(part.chunk), config);
  if (records) {
    part.records = *std::move(records);
    SortByFrame(&part.records);
  } else {
    part.skipped = records.error().Message();
    part.skipped_kind = records.error().kind;
  }
  return part;
}

Result<RecordPart> MeasureChunk(const AccuracyChunk& chunk, std::int64_t number,
                                const AccuracyConfig& config, std::vector<Station>* stations) {
  RecordPart part;
  part.chunk = number;
  part.machine = MachineName();
  if (chunk.recording) return MeasureRecordingChunk(chunk, std::move(part), config);
  for (Station& station : *stations) {
    std::int64_t frame = FirstFrameOf(number);
    for (const accuracy::FrameRun& run : chunk.runs) {
      PLEINAIR_RETURN_IF_ERROR(MeasureRun(run, frame, &station, &part.records));
      frame += static_cast<std::int64_t>(run.frames.size());
    }
  }
  SortByFrame(&part.records);
  return part;
}

}  // namespace

std::vector<AccuracyChunk> PlanChunks(const AccuracyConfig& config) {
  constexpr std::size_t kFramesAChunk = 24;  // Takes a few seconds.
  std::vector<AccuracyChunk> chunks;
  const CameraModel camera = accuracy::SweepCamera(config.camera);
  for (const std::string& sweep : config.sweeps) {
    AccuracyChunk chunk;
    for (accuracy::FrameRun& run :
         accuracy::MakeSweep(sweep, camera, {.seed = config.seed, .scale = config.scale})) {
      chunk.runs.push_back(std::move(run));
      if (chunk.runs.size() < kFramesAChunk) continue;
      chunks.push_back(std::move(chunk));
      chunk = {};
    }
    if (!chunk.runs.empty()) chunks.push_back(std::move(chunk));
  }
  for (const std::string& recording : config.recordings) {
    chunks.push_back({{}, recording, false});
    if (config.light) chunks.push_back({{}, recording, true});
  }
  return chunks;
}

Result<RunOutcome> MeasureShard(const RecordParts& parts, const Shard& shard, int threads) {
  const std::vector<AccuracyChunk> chunks = PlanChunks(parts.config());
  RunOutcome outcome;
  std::vector<std::int64_t> to_do;
  for (std::int64_t i = shard.index - 1; i < static_cast<std::int64_t>(chunks.size());
       i += shard.count) {
    ++outcome.chunks;
    if (!parts.Has(i)) to_do.push_back(i);
  }
  if (to_do.empty()) return outcome;
  ProgressBar bar("accuracy", static_cast<std::int64_t>(to_do.size()), "parts");
  std::mutex mutex;  // Guards the following variables.
  std::map<std::int64_t, std::string> skipped;
  std::optional<Error> failure;
  std::size_t next = 0;
  const auto work = [&] {
    std::vector<Station> stations = MakeStations(parts.config());
    for (;;) {
      std::int64_t number = 0;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (failure || next == to_do.size()) return;
        number = to_do[next++];
      }
      auto part = MeasureChunk(chunks[number], number, parts.config(), &stations);
      Result<void> written;
      if (part) written = parts.Write(*part);
      const std::lock_guard<std::mutex> lock(mutex);
      if (!part || !written) {
        if (!failure) failure = part ? written.error() : part.error();
        return;
      }
      if (part->skipped.empty()) {
        ++outcome.measured;
      } else {
        if (part->skipped_kind == ErrorKind::kSystem) outcome.skipped_kind = ErrorKind::kSystem;
        skipped.emplace(number, std::move(part->skipped));
      }
      bar.Advance();
    }
  };
  std::vector<std::thread> workers;
  const int count = std::clamp(threads, 1, static_cast<int>(to_do.size()));
  workers.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  if (failure) return tl::make_unexpected(*failure);
  for (auto& [number, message] : skipped) {
    outcome.skipped_recordings.insert(*chunks[number].recording);
    // Report an unreadable image once, although both parts of its recording fail.
    const bool is_new =
        std::find(outcome.skipped.begin(), outcome.skipped.end(), message) == outcome.skipped.end();
    if (is_new) outcome.skipped.push_back(std::move(message));
  }
  return outcome;
}

std::optional<GreyImage> PictureOf(const AccuracyConfig& config, std::int64_t frame) {
  const std::vector<AccuracyChunk> chunks = PlanChunks(config);
  const auto chunk = static_cast<std::size_t>(frame / FirstFrameOf(1));
  if (chunk >= chunks.size()) return std::nullopt;
  std::int64_t at = frame % FirstFrameOf(1);
  if (chunks[chunk].recording) return RecordedPicture(*chunks[chunk].recording, at);
  for (const accuracy::FrameRun& run : chunks[chunk].runs) {
    const auto frames = static_cast<std::int64_t>(run.frames.size());
    if (at < frames) {
      const CameraModel camera = accuracy::SweepCamera(config.camera);
      accuracy::FrameRenderer renderer(
          camera,
          [](int number) {
            return session::PatternOf({session::kSgFamily, number});
          },
          config.seed, config.noise_seed);
      return std::move(renderer.Render(run.frames[at]).grey);
    }
    at -= frames;
  }
  return std::nullopt;
}

}  // namespace pleinair::app
