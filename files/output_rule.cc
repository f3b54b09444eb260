#include "files/output_rule.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

namespace pleinair::files {
namespace {

namespace fs = std::filesystem;

bool IsInside(const fs::path& file, const fs::path& folder) {
  const auto [end, at] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && at != file.end();
}

bool HasBytes(const fs::path& file, std::string_view content) {
  std::error_code error;
  if (fs::file_size(file, error) != content.size() || error) return false;
  std::ifstream in(file, std::ios::binary);
  return std::equal(content.begin(), content.end(), std::istreambuf_iterator<char>(in), {});
}

}  // namespace

Result<void> CheckNamedOutput(const std::string& option, const std::string& output,
                              std::span<const std::string> inputs) {
  if (output.empty()) return InputError(option, "the name is empty", "name a file or a folder");
  std::error_code error;
  if (!fs::is_regular_file(output, error)) return {};
  const fs::path real = fs::canonical(output, error);
  if (error) return InputError(output, "cannot be reached: " + error.message());
  for (const std::string& input : inputs) {
    if (input.empty() || !fs::exists(input, error)) continue;
    if (fs::equivalent(output, input, error)) {
      return InputError(output, "is the input itself, and would be overwritten",
                        "name another file to write");
    }
    if (fs::is_directory(input, error) && IsInside(real, fs::canonical(input, error))) {
      return InputError(output,
                        "is a file in a folder that this command reads, and would be overwritten",
                        "name another file to write, or move that one away");
    }
  }
  return {};
}

Result<void> CheckFreeName(const fs::path& file, std::string_view content) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return {};
  if (!content.empty() && HasBytes(file, content)) return {};
  return InputError(file.string(), "is there already and will not be overwritten",
                    "name another folder, or move the file away");
}

}  // namespace pleinair::files
