#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::exports {

/// Iterates over the lines of a text of numbers, in the style of TUM, EuRoC and COLMAP. Fields are
/// separated by blanks, tabs or commas; comments start with '#'. The text must outlive it.
class TextLines {
 public:
  /// `name` is the file's; errors contain it and the line.
  TextLines(std::string_view text, std::string name);

  /// Advances to the next line that is not empty or a comment; false at the end.
  bool Next();
  /// Advances to the next line of any kind; false at the end.
  bool NextOfAnyKind();

  /// The line without its end, and its fields.
  std::string_view line() const { return line_; }
  const std::vector<std::string_view>& fields() const { return fields_; }
  bool IsComment() const { return !line_.empty() && line_.front() == '#'; }

  /// "FILE:LINE".
  std::string Where() const { return name_ + ":" + std::to_string(number_); }

  /// Parses a field as a number. Errors: it is missing, not a number, or not finite.
  Result<double> Number(std::size_t field) const;
  /// Parses `count` numbers, starting at field `first`.
  Result<std::vector<double>> Numbers(std::size_t first, std::size_t count) const;
  Result<std::int64_t> Integer(std::size_t field) const;

  /// The text after a number of fields, trimmed.
  std::string_view Rest(std::size_t fields) const;

 private:
  tl::unexpected<Error> Fail(std::size_t field, const char* what) const;

  std::string_view text_;
  std::string name_;
  int number_ = 0;
  std::string_view line_;
  std::vector<std::string_view> fields_;
};

/// Converts decimal seconds to nanoseconds, exactly. A double has an error of a tenth of a
/// microsecond for current Unix times. Errors: as TextLines::Number, and more than 9e9 seconds.
Result<std::int64_t> NanosecondsFromSeconds(std::string_view seconds, const std::string& where);

/// "1305031098.665900": seconds with as many decimals as necessary, at least six.
std::string SecondsText(std::int64_t nanoseconds);

}  // namespace pleinair::exports
