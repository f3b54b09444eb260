#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/image.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Where an OBJ's companions come from: files in LoadModel, made up in tests and fuzzing.
struct ObjCompanions {
  /// The text of a material library.
  std::function<Result<std::string>(const std::filesystem::path&)> read_text;
  /// A decoded texture.
  std::function<Result<Image<std::uint8_t>>(const std::filesystem::path&)> read_texture;
};

/// Parses Wavefront OBJ: v, vt, vn, f (any polygon, indices from either end), o, g, usemtl,
/// mtllib; line continuations; other statements are passed over. One mesh for each pair of name
/// and material. Normals that the file lacks are left zero. `file` is for messages and for
/// finding companions beside it.
/// Errors: name the file and line.
Result<Model> ParseObj(std::string_view text, const std::filesystem::path& file,
                       const ObjCompanions& companions);

}  // namespace pleinair::compositor
