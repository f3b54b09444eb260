#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::exports {

/// Walks the lines of a text of numbers, as TUM, EuRoC and COLMAP write them: fields between
/// blanks, tabs or commas, comments from '#'. The text must outlive it.
class TextLines {
 public:
  /// `name` is the file's, for errors, which say the line.
  TextLines(std::string_view text, std::string name);

  /// The next line that holds anything but a comment; false at the end.
  bool Next();
  /// The next line whatever it holds; false at the end.
  bool NextOfAnyKind();

  /// The line without its end; its fields.
  std::string_view line() const { return line_; }
  const std::vector<std::string_view>& fields() const { return fields_; }
  bool IsComment() const { return !line_.empty() && line_.front() == '#'; }

  /// "FILE:LINE".
  std::string Where() const { return name_ + ":" + std::to_string(number_); }

  /// A field as a number. Errors: it is not there, no number, or not finite.
  Result<double> Number(std::size_t field) const;
  /// As many numbers as asked for, from a field on.
  Result<std::vector<double>> Numbers(std::size_t first, std::size_t count) const;
  Result<std::int64_t> Integer(std::size_t field) const;

  /// What follows a number of fields, blanks at both ends taken off.
  std::string_view Rest(std::size_t fields) const;

 private:
  tl::unexpected<Error> Fail(std::size_t field, const char* what) const;

  std::string_view text_;
  std::string name_;
  int number_ = 0;
  std::string_view line_;
  std::vector<std::string_view> fields_;
};

/// Seconds in decimals to nanoseconds, exactly: a double would be off by a tenth of a microsecond
/// in stamps of this century. Errors as TextLines::Number, and more than 9e9 seconds.
Result<std::int64_t> NanosecondsFromSeconds(std::string_view seconds, const std::string& where);

/// "1305031098.665900": seconds with as many decimals as it takes, six at least.
std::string SecondsText(std::int64_t nanoseconds);

}  // namespace pleinair::exports
