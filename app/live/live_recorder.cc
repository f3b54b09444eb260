#include "app/live/live_recorder.h"

#include <chrono>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

// A power failure loses at most this much.
constexpr std::chrono::seconds kSyncEvery{1};

/// The block `lens` of recording.json. Lists have one value a frame of another recording.
nlohmann::json LensJson(const scene::LensDescription& lens) {
  nlohmann::json json = nlohmann::json::object();
  if (lens.focus_dioptres.size() == 1) json["focus_dioptres"] = lens.focus_dioptres.front();
  if (lens.aperture_m) json["aperture_mm"] = 1e3 * *lens.aperture_m;
  if (lens.exposure_s.size() == 1) json["exposure_ms"] = 1e3 * lens.exposure_s.front();
  if (lens.blades != 0) {
    json["blades"] = lens.blades;
    json["blade_rotation_deg"] = lens.blade_rotation_deg;
  }
  return json;
}

std::string RecordingJson(const CameraModel& camera,
                          const std::optional<scene::LensDescription>& lens, UtcTime start) {
  const auto& d = camera.distortion;
  nlohmann::json calibration{{"image_width", camera.width},
                             {"image_height", camera.height},
                             {"fx", camera.fx},
                             {"fy", camera.fy},
                             {"cx", camera.cx},
                             {"cy", camera.cy}};
  const bool fisheye = camera.distortion_model == DistortionModel::kEquidistant;
  calibration["model"] = fisheye ? "equidistant" : "brown_conrady";
  if (fisheye) {
    calibration["distortion"] = {d[0], d[1], d[2], d[3]};
  } else {
    calibration["distortion"] = d;
  }
  nlohmann::json recording{
      {"frames", "frames.pack"}, {"utc", start.ToString()}, {"calibration", calibration}};
  if (lens) {
    nlohmann::json block = LensJson(*lens);
    if (!block.empty()) recording["lens"] = std::move(block);
  }
  return recording.dump(1) + "\n";
}

}  // namespace

LiveRecorder::LiveRecorder(std::unique_ptr<devices::FramePackWriter> writer)
    : writer_(std::move(writer)), thread_([this] { Run(); }) {}

LiveRecorder::~LiveRecorder() { Finish(); }

Result<std::unique_ptr<LiveRecorder>> LiveRecorder::Create(const fs::path& folder,
                                                           const CameraModel& camera,
                                                           const scene::SceneDescription& scene,
                                                           UtcTime start) {
  std::error_code error;
  for (const char* name : {"recording.json", "scene.json", "scene.toml", "frames.pack"}) {
    if (fs::exists(folder / name, error)) {
      return InputError((folder / name).string(), "is there already", "record into another folder");
    }
  }
  fs::create_directories(folder, error);
  if (error) return tl::make_unexpected(WriteError(folder, error.value()));
  PLEINAIR_ASSIGN_OR_RETURN(auto writer, devices::FramePackWriter::Create(folder / "frames.pack"));
  PLEINAIR_RETURN_IF_ERROR(
      WriteFileAtomically(folder / "scene.toml", SceneToml(scene, start, folder)));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(
      folder / "recording.json", RecordingJson(camera, scene.camera.recorded_lens, start)));
  return std::unique_ptr<LiveRecorder>(new LiveRecorder(std::move(writer)));
}

void LiveRecorder::Add(std::shared_ptr<const devices::Frame> frame) {
  queue_.Give(std::move(frame));
}

void LiveRecorder::Finish() {
  queue_.Close();
  if (thread_.joinable()) thread_.join();
}

void LiveRecorder::Run() {
  auto synced = std::chrono::steady_clock::now();
  bool ended = false;
  while (auto frame = queue_.Take()) {
    if (ended) continue;  // Empties the queue.
    Result<void> added = writer_->Add(**frame);
    const auto now = std::chrono::steady_clock::now();
    if (added && now - synced >= kSyncEvery) {
      added = writer_->Sync();
      synced = now;
    }
    const std::lock_guard lock(mutex_);
    if (added) {
      ++recorded_;
    } else {
      trouble_ = added.error();
      ended = true;
    }
  }
  if (!ended) static_cast<void>(writer_->Sync());
}

std::int64_t LiveRecorder::recorded() const {
  const std::lock_guard lock(mutex_);
  return recorded_;
}

std::int64_t LiveRecorder::left_out() const { return queue_.dropped(); }

std::optional<Error> LiveRecorder::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

}  // namespace pleinair::app
