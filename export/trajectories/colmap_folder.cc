#include "export/trajectories/colmap_folder.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <system_error>

#include "base/atomic_file.h"
#include "export/trajectories/colmap_binary.h"
#include "export/trajectories/colmap_text.h"
#include "files/output_rule.h"
#include "files/text_file.h"

namespace pleinair::exports {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

bool IsThere(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error);
}

ColmapForm FormIn(const fs::path& folder) {
  const auto names = ColmapFileNames(ColmapForm::kBinary);
  const bool whole = std::all_of(names.begin(), names.end(),
                                 [&](const char* name) { return IsThere(folder / name); });
  const bool no_text = !IsThere(folder / "images.txt") && IsThere(folder / "images.bin");
  return whole || no_text ? ColmapForm::kBinary : ColmapForm::kText;
}

}  // namespace

std::array<const char*, 3> ColmapFileNames(ColmapForm form) {
  if (form == ColmapForm::kText) return {"cameras.txt", "points3D.txt", "images.txt"};
  return {"cameras.bin", "points3D.bin", "images.bin"};
}

Result<ColmapModel> ReadColmapFolder(const fs::path& folder) {
  const ColmapForm form = FormIn(folder);
  const auto [cameras, points3d, images] = ColmapFileNames(form);
  ColmapFiles files;
  PLEINAIR_ASSIGN_OR_RETURN(files.cameras, files::ReadWholeFile(folder / cameras, kMaxBytes));
  PLEINAIR_ASSIGN_OR_RETURN(files.images, files::ReadWholeFile(folder / images, kMaxBytes));
  if (IsThere(folder / points3d)) {
    PLEINAIR_ASSIGN_OR_RETURN(files.points3d, files::ReadWholeFile(folder / points3d, kMaxBytes));
  }
  return form == ColmapForm::kText ? ParseColmapText(files, folder.string())
                                   : ParseColmapBinary(files, folder.string());
}

Result<void> WriteColmapFolder(const ColmapModel& model, ColmapForm form, const fs::path& folder) {
  const bool text = form == ColmapForm::kText;
  for (const char* name : ColmapFileNames(text ? ColmapForm::kBinary : ColmapForm::kText)) {
    if (!IsThere(folder / name)) continue;
    return InputError((folder / name).string(),
                      "belongs to a model in COLMAP's other form, which would contradict this one",
                      "name another folder");
  }
  const ColmapFiles model_files = text ? ColmapText(model) : ColmapBinary(model);
  const std::array<const std::string*, 3> contents = {&model_files.cameras, &model_files.points3d,
                                                      &model_files.images};
  const auto names = ColmapFileNames(form);
  for (std::size_t i = 0; i < names.size(); ++i) {
    PLEINAIR_RETURN_IF_ERROR(files::CheckFreeName(folder / names[i], *contents[i]));
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return tl::make_unexpected(WriteError(folder, error.value()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(folder / names[i], *contents[i]));
  }
  return {};
}

}  // namespace pleinair::exports
