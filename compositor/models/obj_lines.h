#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace pleinair::compositor {

/// Iterates over the statements of OBJ and MTL text. It removes comments, joins lines that end in a
/// backslash with the next, and accepts any line ends.
class ObjLines {
 public:
  explicit ObjLines(std::string_view text) : text_(text) {}

  /// Advances to the next non-empty statement. Returns false at the end.
  bool Next() {
    while (!text_.empty()) {
      line_number_ = next_line_number_;
      std::string_view line = TakeLine();
      if (line.ends_with('\\')) {
        joined_.clear();
        while (line.ends_with('\\')) {
          line.remove_suffix(1);
          joined_.append(line);
          joined_ += ' ';
          line = TakeLine();
        }
        joined_.append(line);
        line = joined_;
      }
      const std::size_t comment = line.find('#');
      if (comment != std::string_view::npos && first_comment_.empty()) {
        first_comment_ =
            Trimmed(line.substr(std::min(line.find_first_not_of('#', comment), line.size())));
      }
      line = line.substr(0, comment);
      rest_ = Trimmed(line);
      if (!rest_.empty()) return true;
    }
    return false;
  }

  /// Takes the next word of the statement; empty at its end.
  std::string_view Word() {
    const std::size_t end = rest_.find_first_of(kBlanks);
    const std::string_view word = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : Trimmed(rest_.substr(end));
    return word;
  }

  /// The remaining text of the statement.
  std::string_view Rest() const { return rest_; }

  /// The first comment with text so far.
  const std::string& first_comment() const { return first_comment_; }

  /// Number of the statement's first line, from 1.
  int line_number() const { return line_number_; }

 private:
  static constexpr std::string_view kBlanks = " \t\r\v\f";

  static std::string_view Trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  }

  std::string_view TakeLine() {
    const std::size_t end = text_.find('\n');
    std::string_view line = text_.substr(0, end);
    text_ = end == std::string_view::npos ? std::string_view{} : text_.substr(end + 1);
    ++next_line_number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  std::string_view text_;
  std::string_view rest_;
  std::string joined_;
  std::string first_comment_;
  int line_number_ = 0;
  int next_line_number_ = 1;
};

/// Quotes at most 32 characters of a word for an error message.
inline std::string Quoted(std::string_view word) {
  std::string quoted(1, '"');
  quoted.append(word.substr(0, 32));
  quoted.append(1, '"');
  return quoted;
}

/// Parses a finite number of magnitude at most `max`. Returns nothing otherwise.
inline std::optional<double> ParseObjDouble(std::string_view word, double max) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  if (!std::isfinite(value) || std::fabs(value) > max) return std::nullopt;
  return value;
}

/// As above for numbers of magnitude at most 1e8, which a float can hold.
inline std::optional<float> ParseObjNumber(std::string_view word) {
  const std::optional<double> value = ParseObjDouble(word, 1e8);
  return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

}  // namespace pleinair::compositor
