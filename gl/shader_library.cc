#include "gl/shader_library.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace pleinair::gl {
namespace {

struct Registry {
  std::mutex mutex;
  std::map<std::string, std::string_view, std::less<>> shaders;
  std::filesystem::path override_directory;

  static Registry& Instance() {
    static Registry registry;
    return registry;
  }

  Result<std::string> Read(std::string_view name) {
    const std::lock_guard lock(mutex);
    if (!override_directory.empty()) {
      std::ifstream file(override_directory / std::filesystem::path(name), std::ios::binary);
      if (file) return std::string(std::istreambuf_iterator<char>(file), {});
    }
    const auto found = shaders.find(name);
    if (found == shaders.end()) {
      return InputError(std::string(name), "no such shader",
                        "name it by its path in the source tree and register its module first");
    }
    return std::string(found->second);
  }
};

// The file name of an #include line; nullopt for other lines.
std::optional<std::string> IncludedFile(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t");
  if (start == std::string_view::npos || !line.substr(start).starts_with("#include")) return {};
  const std::size_t open = line.find('"');
  const std::size_t close = open == std::string_view::npos ? open : line.find('"', open + 1);
  if (close == std::string_view::npos) return {};
  return std::string(line.substr(open + 1, close - open - 1));
}

Result<void> Append(std::string_view name, std::span<const std::string> defines,
                    ShaderSource* source) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text, Registry::Instance().Read(name));
  const std::string file_index = std::to_string(source->files.size());
  const bool root = source->files.empty();
  source->files.emplace_back(name);
  if (!root) source->text += "#line 1 " + file_index + "\n";
  bool version_seen = false;
  int line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    ++line_number;
    const std::string next_line =
        "#line " + std::to_string(line_number + 1) + " " + file_index + "\n";
    if (const std::optional<std::string> included = IncludedFile(line)) {
      if (std::find(source->files.begin(), source->files.end(), *included) == source->files.end()) {
        PLEINAIR_RETURN_IF_ERROR(Append(*included, {}, source));
      }
      source->text += next_line;
      continue;
    }
    source->text.append(line);
    source->text += '\n';
    if (root && !version_seen && line.starts_with("#version")) {
      version_seen = true;
      for (const std::string& define : defines) source->text += "#define " + define + "\n";
      source->text += next_line;
    }
  }
  if (root && !version_seen) {
    return InputError(std::string(name), "has no #version line", "start it with #version 450 core");
  }
  return {};
}

}  // namespace

void ShaderLibrary::Register(std::span<const EmbeddedShader> shaders) {
  Registry& registry = Registry::Instance();
  const std::lock_guard lock(registry.mutex);
  for (const EmbeddedShader& shader : shaders) {
    registry.shaders.emplace(std::string(shader.name), shader.text);
  }
}

void ShaderLibrary::SetOverrideDirectory(std::filesystem::path directory) {
  Registry& registry = Registry::Instance();
  const std::lock_guard lock(registry.mutex);
  registry.override_directory = std::move(directory);
}

Result<ShaderSource> ShaderLibrary::Load(std::string_view name,
                                         std::span<const std::string> defines) {
  ShaderSource source;
  PLEINAIR_RETURN_IF_ERROR(Append(name, defines, &source));
  return source;
}

}  // namespace pleinair::gl
