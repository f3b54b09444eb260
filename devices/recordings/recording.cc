#include "devices/recordings/recording.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "devices/calibration/calibration.h"
#include "devices/calibration/fitted_camera.h"
#include "devices/films/photo_lens.h"
#include "devices/images/image_file.h"
#include "devices/recordings/euroc.h"
#include "devices/recordings/frame_pack.h"
#include "devices/recordings/image_sequence.h"
#include "devices/recordings/recording_manifest.h"
#include "devices/recordings/video_file.h"
#include "files/text_file.h"
#include "scene/scene_facts.h"

namespace pleinair::devices {
namespace {

namespace fs = std::filesystem;

// The rate of a single image; it appears nowhere.
constexpr double kOneImageRate_hz = 1.0;

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::int64_t Nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

/// A description file that exists, and its bytes.
struct Description {
  fs::path file;
  std::string bytes;
};

/// True if a path exists, even as a folder or as a link to nothing. Reading these is an error; no
/// other file takes their place.
bool IsNamed(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

Result<std::optional<Description>> ReadIfThere(const fs::path& file) {
  if (!IsNamed(file)) return std::nullopt;
  PLEINAIR_ASSIGN_OR_RETURN(std::string bytes,
                            files::ReadWholeFile(file, files::kMaxDescriptionBytes));
  return Description{file, std::move(bytes)};
}

// A recording.json names no models; by convention the phantoms and the object are in its folder.
void AddModelsByCustom(const fs::path& folder, scene::SceneFacts* facts) {
  const auto add = [&](const char* name, std::vector<scene::ModelReference>* models) {
    if (IsFile(folder / name)) models->emplace_back().file = name;
  };
  add("phantom.obj", &facts->phantoms);
  add("object.obj", &facts->objects);
}

Result<scene::SceneDescription> CompleteAndCheck(const scene::SceneFacts& facts,
                                                 const fs::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(scene::SceneDescription scene, scene::CompleteScene(facts, file));
  PLEINAIR_RETURN_IF_ERROR(scene::CheckModelsExist(scene));
  return scene;
}

// The scene in `file`, completed from the recording's own data.
Result<scene::SceneDescription> SceneFromFile(const fs::path& file,
                                              const scene::SceneFacts& recorded) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(file, files::kMaxDescriptionBytes));
  PLEINAIR_ASSIGN_OR_RETURN(scene::SceneFacts facts, scene::ParseScene(bytes, file.string()));
  return CompleteAndCheck(scene::WithFallback(std::move(facts), recorded), file);
}

/// recording.json and scene.json of a folder, each if present.
struct OwnFolder {
  fs::path folder;
  std::optional<Description> recording_json, scene_json;
};

Result<std::optional<scene::SceneDescription>> SceneOf(const OwnFolder& own,
                                                       const RecordingOptions& options) {
  scene::SceneFacts recorded;
  if (own.recording_json) {
    PLEINAIR_ASSIGN_OR_RETURN(recorded, scene::ParseSceneJson(own.recording_json->bytes,
                                                              own.recording_json->file.string()));
  }
  scene::SceneFacts scene;
  if (own.scene_json) {
    PLEINAIR_ASSIGN_OR_RETURN(
        scene, scene::ParseSceneJson(own.scene_json->bytes, own.scene_json->file.string()));
  }
  const scene::SceneFacts known = scene::WithFallback(scene, recorded);
  if (options.scene) return SceneFromFile(*options.scene, known);
  if (IsNamed(own.folder / "scene.toml")) return SceneFromFile(own.folder / "scene.toml", known);
  if (own.scene_json) return CompleteAndCheck(known, own.scene_json->file);
  if (recorded.LacksPlaceTimeAndMarker()) return std::nullopt;
  AddModelsByCustom(own.folder, &recorded);
  return CompleteAndCheck(recorded, own.recording_json->file);
}

// A recorder without a calibrated lens has the calibration in the scene file.
Result<CameraModel> CameraOf(const OwnFolder& own, const RecordingManifest& manifest,
                             const RecordingOptions& options) {
  if (options.calibration) return ReadCalibration(*options.calibration);
  const bool in_recording = own.recording_json && (manifest.has_calibration || !own.scene_json);
  const Description& from = in_recording ? *own.recording_json : *own.scene_json;
  return ParseCalibration(from.bytes, from.file.string());
}

Result<RecordingManifest> ManifestOf(const OwnFolder& own) {
  RecordingManifest manifest;
  if (own.recording_json) {
    PLEINAIR_ASSIGN_OR_RETURN(manifest, ParseRecordingManifest(own.recording_json->bytes,
                                                               own.recording_json->file.string()));
    if (manifest.frames) return manifest;
  }
  if (own.scene_json) {
    PLEINAIR_ASSIGN_OR_RETURN(
        const RecordingManifest scene,
        ParseRecordingManifest(own.scene_json->bytes, own.scene_json->file.string()));
    manifest.frames = scene.frames;
    if (!manifest.frame_count) manifest.frame_count = scene.frame_count;
    if (!manifest.frame_rate_hz) manifest.frame_rate_hz = scene.frame_rate_hz;
  }
  return manifest;
}

// Location of the frames: as in the manifest, else the conventional folder or video.
fs::path FramesOf(const RecordingManifest& manifest, const fs::path& folder) {
  fs::path named = folder / manifest.frames.value_or("frames");
  // "frames/%04d.jpg": images are found by number, with any zero padding.
  const bool is_pattern = named.filename().string().find('%') != std::string::npos;
  if (is_pattern && !IsFile(named)) named = named.parent_path();
  if (!IsFolder(named) && !IsFile(named) && IsFile(folder / "background.mp4")) {
    return folder / "background.mp4";
  }
  return named.lexically_normal();
}

/// Lists of focus distances and of exposures must have one a frame.
Result<void> CheckLensLists(const Recording& recording) {
  if (!recording.scene || !recording.scene->camera.recorded_lens) return {};
  const scene::LensDescription& lens = *recording.scene->camera.recorded_lens;
  const std::optional<std::int64_t> frames = recording.frames->FrameCount();
  if (!frames || !recording.frames->CountsExactly()) return {};
  for (const auto& [count, what] : {std::pair{lens.focus_dioptres.size(), " focus distances for "},
                                    std::pair{lens.exposure_s.size(), " exposures for "}}) {
    if (count < 2 || static_cast<std::int64_t>(count) == *frames) continue;
    return InputError((recording.path / "recording.json").string(),
                      "\"lens\" has a list of " + std::to_string(count) + what +
                          std::to_string(*frames) + " frames",
                      "give one value, or one for each frame");
  }
  return {};
}

/// What the images state of their lens completes what the recording's description leaves out.
void AddLensOfImages(const std::vector<fs::path>& files, Recording* recording) {
  if (!recording->scene) return;
  std::optional<scene::LensDescription>& recorded = recording->scene->camera.recorded_lens;
  if (recorded && recorded->IsComplete() && !recorded->exposure_s.empty()) return;
  const std::optional<scene::LensDescription> stated = LensOfPhotos(files);
  if (!stated) return;
  if (!recorded) recorded.emplace();
  if (recorded->focus_dioptres.empty()) recorded->focus_dioptres = stated->focus_dioptres;
  if (!recorded->aperture_m) recorded->aperture_m = stated->aperture_m;
  if (recorded->exposure_s.empty()) recorded->exposure_s = stated->exposure_s;
}

Result<Recording> OpenOwnFolder(const fs::path& folder, const RecordingOptions& options) {
  OwnFolder own{folder, {}, {}};
  PLEINAIR_ASSIGN_OR_RETURN(own.recording_json, ReadIfThere(folder / "recording.json"));
  PLEINAIR_ASSIGN_OR_RETURN(own.scene_json, ReadIfThere(folder / "scene.json"));

  Recording recording;
  recording.path = folder;
  PLEINAIR_ASSIGN_OR_RETURN(const RecordingManifest manifest, ManifestOf(own));
  PLEINAIR_ASSIGN_OR_RETURN(recording.camera, CameraOf(own, manifest, options));
  PLEINAIR_ASSIGN_OR_RETURN(recording.scene, SceneOf(own, options));
  const ImageSize size{recording.camera.width, recording.camera.height};
  const fs::path frames = FramesOf(manifest, folder);
  if (IsFile(frames) && IsFramePack(frames)) {
    PLEINAIR_ASSIGN_OR_RETURN(OpenedFramePack pack, OpenFramePack(frames, size));
    constexpr double kUsualRate_hz = 30.0;  // For a single frame; it only appears in the header of
                                            // an output video.
    const double stated_hz = manifest.frame_rate_hz.value_or(kUsualRate_hz);
    recording.frame_rate_hz = pack.frame_rate_hz > 0.0 ? pack.frame_rate_hz : stated_hz;
    recording.damage = std::move(pack.damage);
    recording.frames = std::move(pack.frames);
    return recording;
  }
  if (IsFile(frames) && IsImageFile(frames)) {
    recording.frame_rate_hz = kOneImageRate_hz;
    recording.is_photo = true;
    PLEINAIR_ASSIGN_OR_RETURN(recording.frames,
                              OpenImageSequence({{frames, 0, std::nullopt}}, size));
    AddLensOfImages({frames}, &recording);
    return recording;
  }
  if (IsFile(frames)) {
    PLEINAIR_ASSIGN_OR_RETURN(OpenedVideo video,
                              OpenVideo(frames, {size, manifest.frame_count, manifest.frame_rate_hz,
                                                 manifest.timestamps_s}));
    recording.frame_rate_hz = video.frame_rate_hz;
    recording.curve = video.curve;
    if (video.start_s) recording.sound = RecordedSound{frames, *video.start_s};
    recording.frames = std::move(video.frames);
    return recording;
  }
  if (!IsFolder(frames)) {
    if (manifest.frames) {
      return InputError(
          folder.string(), "its frames, " + frames.string() + ", are not there",
          "move the film or folder back, or correct \"frames\" in " +
              (own.recording_json ? own.recording_json : own.scene_json)->file.string());
    }
    return InputError(frames.string(), "the recording's frames are not there",
                      "it must be a folder of numbered images or a video");
  }
  if (!manifest.frame_rate_hz) {
    const Description& user_scene = own.recording_json ? *own.recording_json : *own.scene_json;
    return InputError(user_scene.file.string(), "does not say the frame rate",
                      "add frame_rate_hz or timestamps_s");
  }
  recording.frame_rate_hz = *manifest.frame_rate_hz;
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<fs::path> files,
                            ListNumberedImages(frames, manifest.frame_count));
  std::vector<SequenceFrame> sequence;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double stamp_s = manifest.timestamps_s.empty()
                               ? static_cast<double>(i) / recording.frame_rate_hz
                               : manifest.timestamps_s[i];
    sequence.push_back({files[i], Nanoseconds(stamp_s), std::nullopt});
  }
  PLEINAIR_ASSIGN_OR_RETURN(recording.frames, OpenImageSequence(std::move(sequence), size));
  AddLensOfImages(files, &recording);
  return recording;
}

// Scene of a recording without a description of its own: from the options, else in the folder.
Result<std::optional<scene::SceneDescription>> FindSceneNextTo(const fs::path& folder,
                                                               const RecordingOptions& options) {
  if (options.scene) return SceneFromFile(*options.scene, {});
  for (const char* name : {"scene.toml", "scene.json"}) {
    if (IsNamed(folder / name)) return SceneFromFile(folder / name, {});
  }
  return std::nullopt;
}

Result<Recording> OpenEuroc(const fs::path& folder, const fs::path& camera_folder,
                            const RecordingOptions& options) {
  Recording recording;
  recording.path = folder;
  const fs::path sensor = camera_folder / "sensor.yaml";
  const fs::path table = camera_folder / "data.csv";
  PLEINAIR_ASSIGN_OR_RETURN(recording.camera,
                            ReadCalibration(options.calibration.value_or(sensor)));
  PLEINAIR_ASSIGN_OR_RETURN(recording.scene, FindSceneNextTo(folder, options));
  PLEINAIR_ASSIGN_OR_RETURN(const std::string csv,
                            files::ReadWholeFile(table, files::kMaxDescriptionBytes));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<EurocFrame> frames,
                            ParseEurocTable(csv, table.string()));
  std::optional<double> rate_hz;
  if (IsFile(sensor)) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::string yaml,
                              files::ReadWholeFile(sensor, files::kMaxCalibrationBytes));
    PLEINAIR_ASSIGN_OR_RETURN(rate_hz, ParseEurocRate(yaml, sensor.string()));
  }
  const std::int64_t start_ns = frames.front().timestamp_ns;
  const double span_s = static_cast<double>(frames.back().timestamp_ns - start_ns) * 1e-9;
  if (!rate_hz && frames.size() < 2) {
    return InputError(sensor.string(), "does not say the frame rate", "add rate_hz");
  }
  recording.frame_rate_hz = rate_hz ? *rate_hz : static_cast<double>(frames.size() - 1) / span_s;
  std::vector<SequenceFrame> sequence;
  sequence.reserve(frames.size());
  for (const EurocFrame& frame : frames) {
    sequence.push_back(
        {camera_folder / "data" / frame.file, frame.timestamp_ns - start_ns, frame.timestamp_ns});
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      recording.frames,
      OpenImageSequence(std::move(sequence), {recording.camera.width, recording.camera.height}));
  return recording;
}

/// A video or a single picture.
Result<Recording> OpenPlainFile(const fs::path& file, const RecordingOptions& options) {
  if (file.extension() == ".mcap") {
    return InputError(file.string(), "is an MCAP file, a format that can be written but not read",
                      "name a recording's folder or a video (docs/guide/reference/recordings.md)");
  }
  if (!options.calibration) {
    return InputError(file.string(), "is a plain file, which has no lens calibration",
                      "give --calibration FILE, for example that of 'pleinair calibrate " +
                          file.string() + " --marker sg', or name a recording's folder");
  }
  Recording recording;
  recording.path = file;
  PLEINAIR_ASSIGN_OR_RETURN(recording.camera, ReadCalibration(*options.calibration));
  if (options.scene) {
    PLEINAIR_ASSIGN_OR_RETURN(recording.scene, SceneFromFile(*options.scene, {}));
  }
  const ImageSize size{recording.camera.width, recording.camera.height};
  if (IsImageFile(file)) {
    recording.frame_rate_hz = kOneImageRate_hz;
    recording.is_photo = true;
    PLEINAIR_ASSIGN_OR_RETURN(recording.frames, OpenImageSequence({{file, 0, std::nullopt}}, size));
    AddLensOfImages({file}, &recording);
    return recording;
  }
  PLEINAIR_ASSIGN_OR_RETURN(OpenedVideo video, OpenVideo(file, {}));
  PLEINAIR_ASSIGN_OR_RETURN(
      FittedCamera fitted,
      FitCamera(recording.camera, video.size, video.facts.clockwise_deg, file.string()));
  recording.camera = fitted.camera;
  recording.camera_note = std::move(fitted.note);
  recording.frame_rate_hz = video.frame_rate_hz;
  recording.curve = video.curve;
  if (video.start_s) recording.sound = RecordedSound{file, *video.start_s};
  recording.frames = std::move(video.frames);
  return recording;
}

}  // namespace

Result<Recording> OpenRecording(const fs::path& path, const RecordingOptions& options) {
  if (IsFile(path)) {
    const fs::path name = path.filename();
    // The path of a description file stands for its recording's folder.
    if (name == "recording.json" || name == "scene.json") {
      PLEINAIR_ASSIGN_OR_RETURN(Recording recording, OpenOwnFolder(path.parent_path(), options));
      PLEINAIR_RETURN_IF_ERROR(CheckLensLists(recording));
      return recording;
    }
    return OpenPlainFile(path, options);
  }
  if (!IsFolder(path)) {
    return InputError(path.string(), "there is no such recording", "check the name and the folder");
  }
  if (IsNamed(path / "recording.json") || IsNamed(path / "scene.json")) {
    PLEINAIR_ASSIGN_OR_RETURN(Recording recording, OpenOwnFolder(path, options));
    PLEINAIR_RETURN_IF_ERROR(CheckLensLists(recording));
    return recording;
  }
  for (const fs::path& camera : {path / "mav0" / "cam0", path / "cam0", path}) {
    if (IsFile(camera / "data.csv")) return OpenEuroc(path, camera, options);
  }
  return InputError(path.string(),
                    "is no recording: it has neither recording.json nor scene.json nor "
                    "mav0/cam0/data.csv",
                    "docs/guide/reference/recordings.md describes recordings");
}

}  // namespace pleinair::devices
