#include "app/paths/path_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/paths/colmap_model.h"
#include "app/paths/euroc_path.h"
#include "app/paths/gltf_path.h"
#include "app/paths/mcap_path.h"
#include "app/paths/tum_path.h"
#include "base/atomic_file.h"
#include "devices/text_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{1} << 30;

Result<ColmapTexts> ReadColmapTexts(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "images.txt", error) && fs::exists(folder / "images.bin", error)) {
    return InputError(folder.string(), "holds a COLMAP model in binary form",
                      "turn it into text: colmap model_converter --output_type TXT");
  }
  ColmapTexts texts;
  PLEINAIR_ASSIGN_OR_RETURN(texts.cameras,
                            devices::ReadWholeFile(folder / "cameras.txt", kMostBytes));
  PLEINAIR_ASSIGN_OR_RETURN(texts.images,
                            devices::ReadWholeFile(folder / "images.txt", kMostBytes));
  if (fs::exists(folder / "points3D.txt", error)) {
    PLEINAIR_ASSIGN_OR_RETURN(texts.points3d,
                              devices::ReadWholeFile(folder / "points3D.txt", kMostBytes));
  }
  return texts;
}

Result<void> WriteColmap(const CameraPath& path, const fs::path& folder) {
  PLEINAIR_ASSIGN_OR_RETURN(const ColmapTexts texts, ColmapFromPath(path));
  std::error_code error;
  if (fs::exists(folder / "images.bin", error) || fs::exists(folder / "cameras.bin", error)) {
    return InputError(folder.string(), "holds a COLMAP model in binary form, which would count",
                      "name another folder");
  }
  fs::create_directories(folder, error);
  if (error) return tl::make_unexpected(WriteError(folder, error.value()));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / "cameras.txt", texts.cameras));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / "points3D.txt", texts.points3d));
  return WriteFileAtomically(folder / "images.txt", texts.images);
}

std::string LowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

std::optional<PathFormat> PathFormatNamed(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, PathFormat>, 5> kNames{{
      {"tum", PathFormat::kTum},
      {"euroc", PathFormat::kEuroc},
      {"colmap", PathFormat::kColmap},
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
    return InputError(file.string(), "is of a form that is written and not read",
                      "name a TUM, EuRoC or COLMAP path");
  }
  if (format == PathFormat::kColmap) {
    if (options.frame_rate_hz == 0.0) {
      return InputError(file.string(), "is a COLMAP model, which knows no times",
                        "give the pictures' rate with --frame-rate");
    }
    PLEINAIR_ASSIGN_OR_RETURN(const ColmapTexts texts, ReadColmapTexts(file));
    return ParseColmap(texts, file.string(), options.frame_rate_hz);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, devices::ReadWholeFile(file, kMostBytes));
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
      return WriteColmap(path, file);
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

}  // namespace pleinair::app
