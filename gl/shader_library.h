#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::gl {

/// A shader file carried inside the program.
struct EmbeddedShader {
  std::string_view name;  ///< Path in the source tree: "shadows/shaders/shadow_depth.vert".
  std::string_view text;
};

/// A shader ready for the compiler.
struct ShaderSource {
  std::string text;
  /// Names of the files it is made of; the driver's messages name them by index ("1:27: error").
  std::vector<std::string> files;
};

/// Finds shaders by name. A module's CMakeLists.txt says
///
///     pleinair_embed_shaders(shadows FILES shaders/shadow_depth.vert shaders/shadow_common.glsl)
///
/// which validates the files, embeds them and generates "shadows/embedded_shaders.h" with
/// `shadows::RegisterShaders()`; the module calls that before it loads a shader (every module
/// whose .glsl files are included must have been registered). Then
///
///     GlProgram::Create({.vertex = "shadows/shaders/shadow_depth.vert", .defines = {"LAYERS 3"}})
///
/// `#include "module/shaders/file.glsl"` is resolved when a shader is loaded, always by the path
/// in the source tree; each file is included once, wherever it is named again (like #pragma once;
/// files that are also compiled as C++ or validated need their own guard too). Thread-safe.
class ShaderLibrary {
 public:
  /// Adds shaders; those already known by name are kept. The text must live for ever.
  static void Register(std::span<const EmbeddedShader> shaders);

  /// Files in this folder (same relative names) replace the embedded ones; empty: none.
  static void SetOverrideDirectory(std::filesystem::path directory);

  /// The named shader with its includes; each of `defines` ("NAME" or "NAME value") becomes a
  /// #define after the #version line.
  /// Errors (kInput, they concern override files): unknown name, no #version.
  static Result<ShaderSource> Load(std::string_view name,
                                   std::span<const std::string> defines = {});
};

}  // namespace pleinair::gl
