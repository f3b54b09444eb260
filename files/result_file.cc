#include "files/result_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "base/atomic_file.h"
#include "files/text_file.h"

namespace pleinair::files {

std::string TextFileName(const std::string& path) { return path == "-" ? "standard input" : path; }

Result<std::string> ReadTextFile(const std::string& path) {
  const bool standard_input = path == "-";
  const auto fail = [&](int error_number) {
    return InputError(TextFileName(path),
                      std::string("cannot read: ") + std::strerror(error_number),
                      "name a CSV file, or - for standard input");
  };
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(nullptr, &std::fclose);
  if (!standard_input) {
    // A named pipe might never be written to. Open descriptors are the shell's: <(command), or a
    // pipe to /dev/stdin.
    const bool is_open =
        path == "/dev/stdin" || path.starts_with("/dev/fd/") || path.starts_with("/proc/self/fd/");
    if (!is_open) PLEINAIR_RETURN_IF_ERROR(CheckRegularFile(path));
    opened.reset(std::fopen(path.c_str(), "rb"));
    if (!opened) return fail(errno);
  }
  std::FILE* file = standard_input ? stdin : opened.get();
  std::string text;
  std::array<char, 1 << 16> block;
  while (const std::size_t read = std::fread(block.data(), 1, block.size(), file)) {
    text.append(block.data(), read);
    if (std::memchr(block.data(), '\0', read) != nullptr) {
      return InputError(TextFileName(path), "is not text: it holds a NUL byte", "name a CSV file");
    }
    if (text.size() > kMaxTableBytes) {
      return InputError(TextFileName(path),
                        "is longer than the " + std::to_string(kMaxTableBytes >> 20) +
                            " MiB that a table may have",
                        "divide the table");
    }
  }
  if (std::ferror(file) != 0) return fail(errno);
  return text;
}

Result<ResultFile> ResultFile::Open(const std::string& path) {
  ResultFile output;
  if (path.empty()) return output;
  output.path_ = path;
  const bool device = IsDevice(output.path_);
  if (!device) output.temporary_ = TemporarySibling(output.path_);
  errno = 0;
  output.file_ = std::make_unique<std::ofstream>(device ? output.path_ : output.temporary_,
                                                 std::ios::binary | std::ios::trunc);
  if (!*output.file_) {
    output.file_.reset();
    return tl::make_unexpected(WriteError(output.path_, errno != 0 ? errno : EIO));
  }
  return output;
}

ResultFile::~ResultFile() {
  if (!file_) return;
  file_.reset();
  RemoveTemporary();
}

void ResultFile::RemoveTemporary() const {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

Result<void> ResultFile::Finish() {
  if (!file_) return {};  // Standard output: its owner flushes and checks it.
  errno = 0;
  file_->close();
  const bool good = static_cast<bool>(*file_);
  const int error_number = errno != 0 ? errno : EIO;
  file_.reset();
  if (!good) {
    RemoveTemporary();
    return tl::make_unexpected(WriteError(path_, error_number));
  }
  if (temporary_.empty()) return {};
  return CommitFile(temporary_, path_);
}

}  // namespace pleinair::files
