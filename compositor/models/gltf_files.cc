#include "compositor/models/gltf_files.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <system_error>
#include <vector>

#include "compositor/models/model_files.h"

namespace pleinair::compositor {
namespace {

bool IsNamedFromModel(const std::string& file, void* model_folder) {
  // tinygltf first prefixes the name with the model's folder, then with the working folder.
  GltfFolder& from = *static_cast<GltfFolder*>(model_folder);
  if (!file.starts_with(from.folder)) return false;
  const bool absolute = file[from.folder.size()] == '/';  // The name in the model.
  if (absolute) return false;
  if (auto belongs = CheckBelongsToModel(file, from.folder); !belongs) {
    if (!from.error) from.error = belongs.error();
    return false;
  }
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

bool ReadBesideModel(std::vector<unsigned char>* bytes, std::string* error, const std::string& file,
                     void*) {
  const Result<std::string> content = ReadWholeFile(file);
  if (!content) {
    *error += content.error().what;
    return false;
  }
  bytes->assign(content->begin(), content->end());
  return true;
}

}  // namespace

tinygltf::FsCallbacks FilesBesideModel(GltfFolder* folder) {
  return {.FileExists = IsNamedFromModel,
          .ExpandFilePath = [](const std::string& file, void*) { return file; },
          .ReadWholeFile = ReadBesideModel,
          .WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                               void*) { return false; },
          .user_data = folder};
}

}  // namespace pleinair::compositor
