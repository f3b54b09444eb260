#include "export/trajectories/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "files/csv.h"

namespace pleinair::exports {
namespace {

constexpr std::string_view kSeparators = " \t,";
constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr double kMaxTime_s = 9e9;  // Max. of 64-bit nanoseconds.
constexpr std::size_t kShown = 40;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

TextLines::TextLines(std::string_view text, std::string name)
    : text_(text), name_(std::move(name)) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
}

bool TextLines::Next() {
  while (NextOfAnyKind()) {
    if (!IsComment() && !fields_.empty()) return true;
  }
  return false;
}

bool TextLines::NextOfAnyKind() {
  fields_.clear();
  line_ = {};
  if (text_.empty()) return false;
  ++number_;
  const std::size_t end = text_.find('\n');
  line_ = text_.substr(0, end);
  text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  line_ = files::Trimmed(line_);
  if (IsComment()) return true;
  for (std::size_t at = line_.find_first_not_of(kSeparators); at != std::string_view::npos;) {
    const std::size_t stop = std::min(line_.find_first_of(kSeparators, at), line_.size());
    fields_.push_back(line_.substr(at, stop - at));
    at = line_.find_first_not_of(kSeparators, stop);
  }
  return true;
}

tl::unexpected<Error> TextLines::Fail(std::size_t field, const char* what) const {
  if (field >= fields_.size()) {
    return InputError(Where(),
                      fmt::format("has {} fields, too few for what it should be", fields_.size()),
                      "mend the line, or get a whole copy of the file");
  }
  return InputError(
      Where(),
      fmt::format("field {} (\"{}\") {}", field + 1, fields_[field].substr(0, kShown), what),
      "mend the line, or get a whole copy of the file");
}

Result<double> TextLines::Number(std::size_t field) const {
  const std::optional<double> number =
      field < fields_.size() ? files::ParseNumber(fields_[field]) : std::nullopt;
  if (!number) return Fail(field, "is not a finite number");
  return *number;
}

Result<std::vector<double>> TextLines::Numbers(std::size_t first, std::size_t count) const {
  std::vector<double> numbers;
  for (std::size_t i = first; i < first + count; ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(const double number, Number(i));
    numbers.push_back(number);
  }
  return numbers;
}

Result<std::int64_t> TextLines::Integer(std::size_t field) const {
  std::int64_t number = 0;
  if (field >= fields_.size()) return Fail(field, "");
  const std::string_view text = fields_[field];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    return Fail(field, "is not a whole number");
  }
  return number;
}

std::string_view TextLines::Rest(std::size_t fields) const {
  if (fields >= fields_.size()) return {};
  const auto from = static_cast<std::size_t>(fields_[fields].data() - line_.data());
  return files::Trimmed(line_.substr(from));
}

Result<std::int64_t> NanosecondsFromSeconds(std::string_view seconds, const std::string& where) {
  const std::optional<double> about = files::ParseNumber(seconds);
  if (!about || std::abs(*about) > kMaxTime_s) {
    return InputError(where,
                      fmt::format("\"{}\" is not a time in seconds", seconds.substr(0, kShown)),
                      "write seconds and decimals, for example 1305031098.6659");
  }
  std::string_view digits = seconds;
  const bool negative = !digits.empty() && digits.front() == '-';
  if (!digits.empty() && (digits.front() == '-' || digits.front() == '+')) digits.remove_prefix(1);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::string_view whole = digits.substr(0, point);
  const std::string_view decimals = digits.substr(std::min(point + 1, digits.size()));
  const bool plain = !whole.empty() && std::all_of(whole.begin(), whole.end(), IsDigit) &&
                     std::all_of(decimals.begin(), decimals.end(), IsDigit);
  // With an exponent: use the precision of a double.
  if (!plain) return std::llround(*about * 1e9);
  std::int64_t nanoseconds = 0;
  for (const char digit : whole) nanoseconds = nanoseconds * 10 + (digit - '0');
  nanoseconds *= kNanoseconds;
  std::int64_t place = kNanoseconds / 10;
  for (const char digit : decimals.substr(0, 9)) {
    nanoseconds += (digit - '0') * place;
    place /= 10;
  }
  if (decimals.size() > 9 && decimals[9] >= '5') ++nanoseconds;
  return negative ? -nanoseconds : nanoseconds;
}

std::string SecondsText(std::int64_t nanoseconds) {
  const std::int64_t whole = nanoseconds / kNanoseconds, rest = nanoseconds % kNanoseconds;
  std::string text =
      fmt::format("{}{}.{:09}", nanoseconds < 0 ? "-" : "", std::abs(whole), std::abs(rest));
  constexpr std::size_t kMinDecimals = 6;
  const std::size_t shortest = text.size() - 9 + kMinDecimals;
  while (text.size() > shortest && text.back() == '0') text.pop_back();
  return text;
}

}  // namespace pleinair::exports
