#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::gl {

/// A shader file embedded in the program.
struct EmbeddedShader {
  std::string_view name;  ///< Path in the source tree: "shadows/shaders/shadow_depth.vert".
  std::string_view text;
};

/// Shader source with includes resolved.
struct ShaderSource {
  std::string text;
  /// Names of the source files; the driver's messages refer to them by index ("1:27: error").
  std::vector<std::string> files;
};

/// Finds shaders by name. In a module's CMakeLists.txt,
///
///     pleinair_embed_shaders(shadows FILES shaders/shadow_depth.vert shaders/shadow_common.glsl)
///
/// validates the files, embeds them and generates "shadows/embedded_shaders.h" with
/// `shadows::RegisterShaders()`. Call that before loading a shader, for every module whose .glsl
/// files are included. Then
///
///     GlProgram::Create({.vertex = "shadows/shaders/shadow_depth.vert", .defines = {"LAYERS 3"}})
///
/// `#include "module/shaders/file.glsl"` is resolved when a shader is loaded, always by the path in
/// the source tree. Each file is included once, as with #pragma once (files that are also compiled
/// as C++ or validated need their own guard too). Thread-safe.
class ShaderLibrary {
 public:
  /// Adds shaders; names that are registered already keep their first text. The text must outlive
  /// the process's use of shaders (string literals).
  static void Register(std::span<const EmbeddedShader> shaders);

  /// Files in this folder (same relative names) replace the embedded ones; empty path: none.
  static void SetOverrideDirectory(std::filesystem::path directory);

  /// The named shader with its includes. Each of `defines` ("NAME" or "NAME value") becomes a
  /// #define after the #version line. Errors (kInput, because they concern override files): unknown
  /// name, no #version.
  static Result<ShaderSource> Load(std::string_view name,
                                   std::span<const std::string> defines = {});
};

}  // namespace pleinair::gl
