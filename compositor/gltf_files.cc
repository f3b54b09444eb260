#include "compositor/gltf_files.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <system_error>
#include <vector>

#include "compositor/model_files.h"

namespace pleinair::compositor {
namespace {

bool IsBesideModel(const std::string& file, void* folder) {
  // tinygltf looks in the model's folder first, then in the working folder.
  if (!file.starts_with(*static_cast<const std::string*>(folder))) return false;
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

tinygltf::FsCallbacks FilesBesideModel(std::string* folder) {
  return {.FileExists = IsBesideModel,
          .ExpandFilePath = [](const std::string& file, void*) { return file; },
          .ReadWholeFile = ReadBesideModel,
          .WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                               void*) { return false; },
          .user_data = folder};
}

}  // namespace pleinair::compositor
