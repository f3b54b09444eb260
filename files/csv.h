#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::files {

/// Without blanks and tabs at both ends.
std::string_view Trimmed(std::string_view text);

/// A whole decimal number, finite; nothing otherwise.
std::optional<double> ParseNumber(std::string_view text);

/// Splits CSV records (RFC 4180) one by one: a byte order mark, CRLF and quoted fields are
/// understood. Blank lines may end the text; before a record they are an error, since something is
/// missing there. `text` must outlive it.
class CsvReader {
 public:
  /// `name` is the file's, for errors, which say the line.
  CsvReader(std::string_view text, std::string name);

  /// Reads the next record; false at the end. Errors: a blank line before it, an open quote.
  Result<bool> Next();

  /// The record's own text without its line end, and its fields unquoted.
  std::string_view record() const { return record_; }
  const std::vector<std::string>& fields() const { return fields_; }

  /// "FILE:LINE" of the record.
  std::string Where() const { return name_ + ":" + std::to_string(line_); }

  /// Column of a name in the record just read, the header; nothing when it is not there. Errors:
  /// two columns of that name.
  Result<std::optional<std::size_t>> FindColumn(std::string_view name) const;

  /// Errors: the record has not as many fields as the header.
  Result<void> CheckFieldCount(std::size_t columns) const;

 private:
  Result<void> ReadRecord();

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 0;
  int next_line_ = 1;
  std::string_view record_;
  std::vector<std::string> fields_;
};

}  // namespace pleinair::files
