#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/image.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Source of an OBJ's companion files: the file system in LoadModel, synthetic in tests and
/// fuzzing.
struct ObjCompanions {
  /// Returns the text of a material library.
  std::function<Result<std::string>(const std::filesystem::path&)> read_text;
  /// Returns a decoded texture.
  std::function<Result<Image<std::uint8_t>>(const std::filesystem::path&)> read_texture;
};

/// Parses Wavefront OBJ: v, vt, vn, f (any polygon, indices from either end), o, g, usemtl, mtllib,
/// and line continuations. Other statements are ignored. The model has one mesh per pair of name
/// and material. Missing normals are zero. `file` serves messages and the search for companions
/// beside it. Errors name the file and line.
Result<Model> ParseObj(std::string_view text, const std::filesystem::path& file,
                       const ObjCompanions& companions);

}  // namespace pleinair::compositor
