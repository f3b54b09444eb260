#include "gl/program.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "gl/shader_library.h"

namespace pleinair::gl {
namespace {

inline void DeleteShader(GLuint id) { glDeleteShader(id); }
using ShaderHandle = GlHandle<&DeleteShader>;

// The driver's log on one line, as required for Error::what.
std::string OneLine(std::string log) {
  while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
  std::replace(log.begin(), log.end(), '\n', ' ');
  return log;
}

Result<ShaderHandle> Compile(const StageText& stage) {
  ShaderHandle shader(glCreateShader(stage.stage));
  const char* text = stage.text.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  GLint length = 0;
  glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
  return SystemError(stage.name, "shader does not compile: " + OneLine(log));
}

}  // namespace

Result<GlProgram> GlProgram::Create(const ProgramStages& stages) {
  std::vector<StageText> texts;
  const std::pair<GLenum, const std::string*> all[] = {{GL_VERTEX_SHADER, &stages.vertex},
                                                       {GL_FRAGMENT_SHADER, &stages.fragment}};
  for (const auto& [stage, name] : all) {
    if (name->empty()) continue;
    PLEINAIR_ASSIGN_OR_RETURN(ShaderSource source, ShaderLibrary::Load(*name, stages.defines));
    std::string label = *name;
    for (std::size_t i = 1; i < source.files.size(); ++i) {
      label += (i == 1 ? " (" : ", ") + std::to_string(i) + " = " + source.files[i];
    }
    if (source.files.size() > 1) label += ")";
    texts.push_back({stage, std::move(source.text), std::move(label)});
  }
  return FromText(texts);
}

Result<GlProgram> GlProgram::FromText(const std::vector<StageText>& stages) {
  GlProgram program;
  program.handle_ = GlHandle<&DeleteProgram>(glCreateProgram());
  std::vector<ShaderHandle> shaders;
  std::string names;
  for (const StageText& stage : stages) {
    PLEINAIR_ASSIGN_OR_RETURN(ShaderHandle shader, Compile(stage));
    glAttachShader(program.id(), shader.id());
    shaders.push_back(std::move(shader));
    names += (names.empty() ? "" : " + ") + stage.name;
  }
  glLinkProgram(program.id());
  for (const ShaderHandle& shader : shaders) glDetachShader(program.id(), shader.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  GLint length = 0;
  glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program.id(), length, nullptr, log.data());
  return SystemError(names, "program does not link: " + OneLine(log));
}

int GlProgram::UniformLocation(std::string_view name) const {
  std::string key(name);
  if (const auto found = locations_.find(key); found != locations_.end()) return found->second;
  const int location = glGetUniformLocation(id(), key.c_str());
  locations_.emplace(std::move(key), location);
  return location;
}

void GlProgram::Set(std::string_view name, int value) const {
  glProgramUniform1i(id(), UniformLocation(name), value);
}
void GlProgram::Set(std::string_view name, float value) const {
  glProgramUniform1f(id(), UniformLocation(name), value);
}
void GlProgram::Set(std::string_view name, const glm::vec2& value) const {
  glProgramUniform2fv(id(), UniformLocation(name), 1, glm::value_ptr(value));
}
void GlProgram::Set(std::string_view name, const glm::vec3& value) const {
  glProgramUniform3fv(id(), UniformLocation(name), 1, glm::value_ptr(value));
}
void GlProgram::Set(std::string_view name, const glm::vec4& value) const {
  glProgramUniform4fv(id(), UniformLocation(name), 1, glm::value_ptr(value));
}
void GlProgram::Set(std::string_view name, const glm::ivec2& value) const {
  glProgramUniform2iv(id(), UniformLocation(name), 1, glm::value_ptr(value));
}
void GlProgram::Set(std::string_view name, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id(), UniformLocation(name), 1, GL_FALSE, glm::value_ptr(value));
}
void GlProgram::SetArray(std::string_view name, const std::vector<glm::vec3>& values) const {
  if (values.empty()) return;
  glProgramUniform3fv(id(), UniformLocation(name), static_cast<GLsizei>(values.size()),
                      glm::value_ptr(values.front()));
}
void GlProgram::SetArray(std::string_view name, const std::vector<float>& values) const {
  if (values.empty()) return;
  glProgramUniform1fv(id(), UniformLocation(name), static_cast<GLsizei>(values.size()),
                      values.data());
}

}  // namespace pleinair::gl
