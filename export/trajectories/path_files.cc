#include "export/trajectories/path_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "export/trajectories/colmap_folder.h"
#include "export/trajectories/euroc_path.h"
#include "export/trajectories/gltf_path.h"
#include "export/trajectories/mcap_path.h"
#include "export/trajectories/tum_path.h"
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

std::optional<PathFormat> PathFormatNamed(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, PathFormat>, 6> kNames{{
      {"tum", PathFormat::kTum},
      {"euroc", PathFormat::kEuroc},
      {"colmap", PathFormat::kColmap},
      {"colmap-binary", PathFormat::kColmapBinary},
      {"gltf", PathFormat::kGltf},
      {"mcap", PathFormat::kMcap},
  }};
  for (const auto& [known, format] : kNames) {
    if (name == known) return format;
  }
  return std::nullopt;
}

Result<PathFormat> PathFormatOf(const fs::path& file) {
  std::error_code error;
  const std::string extension = LowerExtension(file);
  if (fs::is_directory(file, error) || extension.empty()) return PathFormat::kColmap;
  if (extension == ".tum" || extension == ".txt") return PathFormat::kTum;
  if (extension == ".csv") return PathFormat::kEuroc;
  if (extension == ".glb" || extension == ".gltf") return PathFormat::kGltf;
  if (extension == ".mcap") return PathFormat::kMcap;
  return InputError(
      file.string(), "has a name that tells no form of a path",
      "name it .tum, .csv, .glb, .gltf or .mcap or a folder, or give --from and --to");
}

Result<CameraPath> ReadPath(const fs::path& file, PathFormat format, const PathReading& options) {
  if (format == PathFormat::kGltf || format == PathFormat::kMcap) {
    const char* form = format == PathFormat::kGltf ? "a glTF" : "an MCAP";
    return InputError(file.string(),
                      fmt::format("is {} file, a form that is written and not read", form),
                      "name a TUM, EuRoC or COLMAP path");
  }
  if (format == PathFormat::kColmap || format == PathFormat::kColmapBinary) {
    if (options.frame_rate_hz == 0.0) {
      return InputError(file.string(), "is a COLMAP model, which knows no times",
                        "give the pictures' rate with --frame-rate");
    }
    PLEINAIR_ASSIGN_OR_RETURN(ColmapModel model, ReadColmapFolder(file));
    return PathFromColmap(std::move(model), options.frame_rate_hz);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, files::ReadWholeFile(file, kMaxBytes));
  if (format == PathFormat::kTum) return ParseTum(text, file.string());
  return ParseEurocPath(text, file.string(), options.body_from_camera);
}

Result<void> WritePath(const CameraPath& path, const fs::path& file, PathFormat format,
                       const PathWriting& options) {
  switch (format) {
    case PathFormat::kTum:
      return WriteFileAtomically(file, TumText(path, options.comment));
    case PathFormat::kEuroc:
      return WriteFileAtomically(file, EurocPathText(path, options.body_from_camera));
    case PathFormat::kColmap:
    case PathFormat::kColmapBinary: {
      PLEINAIR_ASSIGN_OR_RETURN(const ColmapModel model, ColmapFromPath(path));
      return WriteColmapFolder(
          model, format == PathFormat::kColmap ? ColmapForm::kText : ColmapForm::kBinary, file);
    }
    case PathFormat::kGltf: {
      const bool binary = LowerExtension(file) != ".gltf";
      PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                                GltfFromPath(path, {options.up, options.marker_size_m, binary}));
      return WriteFileAtomically(file, bytes);
    }
    case PathFormat::kMcap:
      break;
  }
  McapPathOptions mcap;
  mcap.reference = "reference";
  mcap.marker_size_m = options.marker_size_m;
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes, McapFromPath(path, mcap));
  return WriteFileAtomically(file, bytes);
}

}  // namespace pleinair::exports
