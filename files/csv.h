#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::files {

/// `text` without spaces and tabs at both ends.
std::string_view Trimmed(std::string_view text);

/// A decimal number that fills all of `text` and is finite; nullopt otherwise.
std::optional<double> ParseNumber(std::string_view text);

/// Reads CSV records (RFC 4180) one by one. Accepts a byte order mark, CRLF and quoted fields.
/// Blank lines are valid only at the end: before a record they are an error, because data may be
/// missing there. `text` must outlive the reader.
class CsvReader {
 public:
  /// `name` is the file's name for error messages, which add the line number.
  CsvReader(std::string_view text, std::string name);

  /// Reads the next record; returns false at the end. Errors: a blank line before the record, an
  /// unclosed quote.
  Result<bool> Next();

  /// The raw text of the record without its line end, and its fields without quotes.
  std::string_view record() const { return record_; }
  const std::vector<std::string>& fields() const { return fields_; }

  /// Location of the record for error messages, "FILE:LINE".
  std::string Where() const { return name_ + ":" + std::to_string(line_); }

  /// Column index of a name in the header, which must be the record read last; nullopt if absent.
  /// Errors: two columns of that name.
  Result<std::optional<std::size_t>> FindColumn(std::string_view name) const;

  /// Errors: the number of fields differs from `columns`, that of the header.
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
