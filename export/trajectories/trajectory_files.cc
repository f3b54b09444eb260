#include "export/trajectories/trajectory_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <ios>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "export/trajectories/colmap_folder.h"
#include "export/trajectories/euroc_trajectory.h"
#include "export/trajectories/gltf_trajectory.h"
#include "export/trajectories/mcap_trajectory.h"
#include "export/trajectories/record3d_archive.h"
#include "export/trajectories/record3d_trajectory.h"
#include "export/trajectories/stray_trajectory.h"
#include "export/trajectories/tum_trajectory.h"
#include "files/text_file.h"

namespace pleinair::exports {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
constexpr const char* kStrayFile = "odometry.csv";
constexpr const char* kArchiveExtension = ".r3d";
constexpr std::array<const char*, 2> kRecord3dFiles{"metadata", "metadata.json"};

std::string LowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// True for a file that begins with the header of Stray Scanner's odometry.csv.
bool HasStrayHeader(const fs::path& file) {
  if (!files::CheckRegularFile(file)) return false;  // Opening a pipe waits for its writer.
  constexpr std::streamsize kHeaderBytes = 200;
  std::string start(kHeaderBytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(start.data(), kHeaderBytes);
  start.resize(static_cast<std::size_t>(in.gcount()));
  return IsStrayOdometry(start);
}

/// The metadata or the one archive in a folder of Record3D; nothing for other folders and files.
/// Errors: several archives and no metadata.
Result<std::optional<fs::path>> Record3dFileIn(const fs::path& folder) {
  std::error_code error;
  for (const char* name : kRecord3dFiles) {
    if (fs::is_regular_file(folder / name, error)) return folder / name;
  }
  std::optional<fs::path> archive;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (LowerExtension(entry->path()) != kArchiveExtension) continue;
    if (archive) {
      return InputError(folder.string(), "holds several .r3d archives",
                        "name the one of this film");
    }
    archive = entry->path();
  }
  return archive;
}

/// True for a folder with a COLMAP model, whatever else is in it.
bool HasColmapModel(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "cameras.txt", error) || fs::exists(folder / "cameras.bin", error);
}

/// Reads an .r3d archive, its metadata, or the folder of either.
Result<CameraTrajectory> ReadRecord3d(const fs::path& named) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<fs::path> found, Record3dFileIn(named));
  const fs::path metadata = found.value_or(named);
  PLEINAIR_RETURN_IF_ERROR(files::CheckRegularFile(metadata));
  const bool is_archive = IsZipArchive(metadata) || LowerExtension(metadata) == kArchiveExtension;
  PLEINAIR_ASSIGN_OR_RETURN(const std::string json,
                            is_archive
                                ? ReadRecord3dArchive(metadata)
                                : files::ReadWholeFile(metadata, kMaxRecord3dMetadata_bytes));
  return ParseRecord3dMetadata(json, metadata.string());
}

/// Reads odometry.csv, and the camera_matrix.csv beside it if there is one.
Result<CameraTrajectory> ReadStray(const fs::path& named) {
  std::error_code error;
  const fs::path file = fs::is_directory(named, error) ? named / kStrayFile : named;
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadWholeFile(file, kMaxBytes));
  PLEINAIR_ASSIGN_OR_RETURN(CameraTrajectory path, ParseStrayOdometry(text, file.string()));
  const fs::path matrix = file.parent_path() / "camera_matrix.csv";
  if (!fs::exists(matrix, error)) return path;
  PLEINAIR_ASSIGN_OR_RETURN(const std::string lens,
                            files::ReadWholeFile(matrix, files::kMaxCalibrationBytes));
  PLEINAIR_ASSIGN_OR_RETURN(path.camera, ParseStrayCamera(lens, matrix.string()));
  return path;
}

}  // namespace

bool IsArkit(TrajectoryFormat format) {
  return format == TrajectoryFormat::kStray || format == TrajectoryFormat::kRecord3d;
}

std::optional<TrajectoryFormat> TrajectoryFormatNamed(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, TrajectoryFormat>, 8> kNames{{
      {"tum", TrajectoryFormat::kTum},
      {"euroc", TrajectoryFormat::kEuroc},
      {"colmap", TrajectoryFormat::kColmap},
      {"colmap-binary", TrajectoryFormat::kColmapBinary},
      {"gltf", TrajectoryFormat::kGltf},
      {"mcap", TrajectoryFormat::kMcap},
      {"stray", TrajectoryFormat::kStray},
      {"record3d", TrajectoryFormat::kRecord3d},
  }};
  for (const auto& [known, format] : kNames) {
    if (name == known) return format;
  }
  return std::nullopt;
}

Result<TrajectoryFormat> TrajectoryFormatOf(const fs::path& file) {
  std::error_code error;
  const std::string extension = LowerExtension(file);
  if (fs::exists(file / kStrayFile, error)) return TrajectoryFormat::kStray;
  if (HasColmapModel(file)) return TrajectoryFormat::kColmap;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<fs::path> record3d, Record3dFileIn(file));
  if (record3d || extension == ".json" || extension == kArchiveExtension) {
    return TrajectoryFormat::kRecord3d;
  }
  if (fs::is_regular_file(file, error) && file.filename() == kRecord3dFiles[0]) {
    return TrajectoryFormat::kRecord3d;
  }
  if (fs::is_directory(file, error) || extension.empty()) return TrajectoryFormat::kColmap;
  if (extension == ".tum" || extension == ".txt") return TrajectoryFormat::kTum;
  if (extension == ".csv")
    return HasStrayHeader(file) ? TrajectoryFormat::kStray : TrajectoryFormat::kEuroc;
  if (extension == ".glb" || extension == ".gltf") return TrajectoryFormat::kGltf;
  if (extension == ".mcap") return TrajectoryFormat::kMcap;
  return InputError(
      file.string(), "has a name without a known trajectory format",
      "name it .tum, .csv, .r3d, .json, .glb, .gltf or .mcap or a folder, or state its format");
}

Result<TrajectoryFormat> TrajectoryFormatToRead(const fs::path& file) {
  std::error_code error;
  constexpr std::array kFilms{".mp4", ".mov", ".m4v", ".mkv", ".webm", ".avi"};
  if (std::find(kFilms.begin(), kFilms.end(), LowerExtension(file)) != kFilms.end()) {
    return InputError(file.string(), "is a film, not a trajectory",
                      "name the file or folder that the app or the reconstruction wrote beside it");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const TrajectoryFormat format, TrajectoryFormatOf(file));
  // A format that is only written is refused as such.
  const bool is_read = format != TrajectoryFormat::kGltf && format != TrajectoryFormat::kMcap;
  if (is_read && !fs::exists(file, error)) {
    return InputError(file.string(), "does not exist", "check the name of the trajectory");
  }
  if (format != TrajectoryFormat::kColmap || !fs::is_directory(file, error) ||
      HasColmapModel(file)) {
    return format;
  }
  const bool has_poses = fs::is_directory(file / "poses", error);
  const bool has_sparse = HasColmapModel(file / "sparse" / "0");
  return InputError(file.string(), "is a folder without a trajectory",
                    has_poses    ? "name one of the files in its folder poses"
                    : has_sparse ? "name its folder sparse/0"
                                 : "name a file (.tum, .csv, .r3d), or a folder with odometry.csv "
                                   "(Stray Scanner), metadata (Record3D) or cameras and images "
                                   "(COLMAP)");
}

Result<CameraTrajectory> ReadTrajectory(const fs::path& file, TrajectoryFormat format,
                                        const TrajectoryReading& options) {
  if (format == TrajectoryFormat::kGltf || format == TrajectoryFormat::kMcap) {
    const char* form = format == TrajectoryFormat::kGltf ? "a glTF" : "an MCAP";
    return InputError(file.string(),
                      fmt::format("is {} file, a format that can be written but not read", form),
                      "name a TUM, EuRoC, COLMAP, Stray Scanner or Record3D trajectory");
  }
  if (format == TrajectoryFormat::kColmap || format == TrajectoryFormat::kColmapBinary) {
    if (options.frame_rate_hz == 0.0) {
      return InputError(file.string(), "is a COLMAP model, which has no times",
                        "give the images' rate with --frame-rate");
    }
    PLEINAIR_ASSIGN_OR_RETURN(ColmapModel model, ReadColmapFolder(file));
    return TrajectoryFromColmap(std::move(model), options.frame_rate_hz);
  }
  if (format == TrajectoryFormat::kStray) return ReadStray(file);
  if (format == TrajectoryFormat::kRecord3d) return ReadRecord3d(file);
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadWholeFile(file, kMaxBytes));
  if (format == TrajectoryFormat::kTum) return ParseTum(text, file.string());
  return ParseEurocTrajectory(text, file.string(), options.body_from_camera);
}

Result<void> WriteTrajectory(const CameraTrajectory& path, const fs::path& file,
                             TrajectoryFormat format, const TrajectoryWriting& options) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return WriteFileAtomically(file, TumText(path, options.comment));
    case TrajectoryFormat::kEuroc:
      return WriteFileAtomically(file, EurocTrajectoryText(path, options.body_from_camera));
    case TrajectoryFormat::kColmap:
    case TrajectoryFormat::kColmapBinary: {
      PLEINAIR_ASSIGN_OR_RETURN(const ColmapModel model, ColmapFromTrajectory(path));
      return WriteColmapFolder(
          model, format == TrajectoryFormat::kColmap ? ColmapForm::kText : ColmapForm::kBinary,
          file);
    }
    case TrajectoryFormat::kGltf: {
      const bool binary = LowerExtension(file) != ".gltf";
      PLEINAIR_ASSIGN_OR_RETURN(
          const std::string bytes,
          GltfFromTrajectory(path, {options.up, options.marker_size_m, binary}));
      return WriteFileAtomically(file, bytes);
    }
    case TrajectoryFormat::kStray:
    case TrajectoryFormat::kRecord3d:
      return InputError(file.string(), "is to be in a format that can be read but not written",
                        "write TUM, EuRoC, COLMAP, glTF or MCAP");
    case TrajectoryFormat::kMcap:
      break;
  }
  McapTrajectoryOptions mcap;
  mcap.reference = "reference";
  mcap.marker_size_m = options.marker_size_m;
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes, McapFromTrajectory(path, mcap));
  return WriteFileAtomically(file, bytes);
}

}  // namespace pleinair::exports
