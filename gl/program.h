#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/error.h"
#include "gl/handle.h"

namespace pleinair::gl {

inline void DeleteProgram(GLuint id) { glDeleteProgram(id); }

/// The stages of a program, by name in the ShaderLibrary. Empty stages are omitted.
struct ProgramStages {
  std::string vertex = {};
  std::string fragment = {};
  std::vector<std::string> defines = {};  ///< "NAME" or "NAME value", for all stages.
};

/// Source text of one stage.
struct StageText {
  GLenum stage = 0;  ///< GL_VERTEX_SHADER, …
  std::string text;
  std::string name;  ///< Used in error messages.
};

/// A linked program and its uniforms. The Set… functions need no binding (direct state access).
/// Names of uniforms that the compiler has removed are ignored, as in GL.
class GlProgram {
 public:
  /// Loads, compiles and links. Errors (kSystem): the driver's log, with the names of the files
  /// that its numbers refer to; (kInput): as ShaderLibrary::Load.
  static Result<GlProgram> Create(const ProgramStages& stages);
  static Result<GlProgram> FromText(const std::vector<StageText>& stages);

  GlProgram() = default;

  void Use() const { glUseProgram(id()); }

  void Set(std::string_view name, int value) const;
  void Set(std::string_view name, float value) const;
  void Set(std::string_view name, const glm::vec2& value) const;
  void Set(std::string_view name, const glm::vec3& value) const;
  void Set(std::string_view name, const glm::vec4& value) const;
  void Set(std::string_view name, const glm::ivec2& value) const;
  void Set(std::string_view name, const glm::mat4& value) const;
  void SetArray(std::string_view name, const std::vector<glm::vec3>& values) const;
  void SetArray(std::string_view name, const std::vector<float>& values) const;

  GLuint id() const { return handle_.id(); }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  /// Location of an active uniform, -1 if there is none.
  int UniformLocation(std::string_view name) const;

  GlHandle<&DeleteProgram> handle_;
  mutable std::unordered_map<std::string, int> locations_;
};

}  // namespace pleinair::gl
