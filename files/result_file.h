#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "base/error.h"

namespace pleinair::files {

/// Size limit of a table: room for ten million rows.
constexpr std::size_t kMaxTableBytes = std::size_t{1} << 30;

/// Reads a whole text file; "-" and "/dev/stdin" are standard input. Errors (input): a named file
/// that is neither regular nor an open descriptor, more than kMaxTableBytes, a NUL byte.
Result<std::string> ReadTextFile(const std::string& path);

/// The name of that file in error messages.
std::string TextFileName(const std::string& path);

/// Standard output, or a file that appears under its name only when it is complete. An unfinished
/// file is removed.
class ResultFile {
 public:
  /// An empty path is standard output. Errors as in WriteError().
  static Result<ResultFile> Open(const std::string& path);
  ~ResultFile();
  ResultFile(ResultFile&&) = default;
  ResultFile& operator=(ResultFile&&) = delete;

  std::ostream& stream() { return file_ ? *file_ : std::cout; }

  Result<void> Finish();

 private:
  ResultFile() = default;
  void RemoveTemporary() const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< Empty for a device or pipe, which is written directly.
  std::unique_ptr<std::ofstream> file_;
};

}  // namespace pleinair::files
