#include "export/trajectories/trajectory_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "export/trajectories/colmap_folder.h"
#include "export/trajectories/euroc_trajectory.h"
#include "export/trajectories/gltf_trajectory.h"
#include "export/trajectories/mcap_trajectory.h"
#include "export/trajectories/tum_trajectory.h"
#include "files/text_file.h"

namespace pleinair::exports {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

std::string LowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

std::optional<TrajectoryFormat> TrajectoryFormatNamed(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, TrajectoryFormat>, 6> kNames{{
      {"tum", TrajectoryFormat::kTum},
      {"euroc", TrajectoryFormat::kEuroc},
      {"colmap", TrajectoryFormat::kColmap},
      {"colmap-binary", TrajectoryFormat::kColmapBinary},
      {"gltf", TrajectoryFormat::kGltf},
      {"mcap", TrajectoryFormat::kMcap},
  }};
  for (const auto& [known, format] : kNames) {
    if (name == known) return format;
  }
  return std::nullopt;
}

Result<TrajectoryFormat> TrajectoryFormatOf(const fs::path& file) {
  std::error_code error;
  const std::string extension = LowerExtension(file);
  if (fs::is_directory(file, error) || extension.empty()) return TrajectoryFormat::kColmap;
  if (extension == ".tum" || extension == ".txt") return TrajectoryFormat::kTum;
  if (extension == ".csv") return TrajectoryFormat::kEuroc;
  if (extension == ".glb" || extension == ".gltf") return TrajectoryFormat::kGltf;
  if (extension == ".mcap") return TrajectoryFormat::kMcap;
  return InputError(
      file.string(), "has a name without a known trajectory format",
      "name it .tum, .csv, .glb, .gltf or .mcap or a folder, or give --from and --to");
}

Result<CameraTrajectory> ReadTrajectory(const fs::path& file, TrajectoryFormat format,
                                        const TrajectoryReading& options) {
  if (format == TrajectoryFormat::kGltf || format == TrajectoryFormat::kMcap) {
    const char* form = format == TrajectoryFormat::kGltf ? "a glTF" : "an MCAP";
    return InputError(file.string(),
                      fmt::format("is {} file, a format that can be written but not read", form),
                      "name a TUM, EuRoC or COLMAP trajectory");
  }
  if (format == TrajectoryFormat::kColmap || format == TrajectoryFormat::kColmapBinary) {
    if (options.frame_rate_hz == 0.0) {
      return InputError(file.string(), "is a COLMAP model, which has no times",
                        "give the images' rate with --frame-rate");
    }
    PLEINAIR_ASSIGN_OR_RETURN(ColmapModel model, ReadColmapFolder(file));
    return TrajectoryFromColmap(std::move(model), options.frame_rate_hz);
  }
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
