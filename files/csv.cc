#include "files/csv.h"

#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace pleinair::files {

std::string_view Trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A decimal number that fills all of `text` and is finite; nullopt otherwise.
std::optional<double> ParseNumber(std::string_view text) {
  text = Trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

CsvReader::CsvReader(std::string_view text, std::string name)
    : text_(text), name_(std::move(name)) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
}

Result<bool> CsvReader::Next() {
  int blank_line = 0;
  while (at_ < text_.size()) {
    PLEINAIR_RETURN_IF_ERROR(ReadRecord());
    if (!Trimmed(record_).empty()) {
      if (blank_line == 0) return true;
      line_ = blank_line;
      return InputError(Where(), "the line is blank", "delete it, or write what it lacks");
    }
    if (blank_line == 0) blank_line = line_;
  }
  return false;
}

Result<std::optional<std::size_t>> CsvReader::FindColumn(std::string_view name) const {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (Trimmed(fields_[i]) != name) continue;
    if (found) {
      return InputError(Where(), "two columns are called " + std::string(name), "keep one of them");
    }
    found = i;
  }
  return found;
}

Result<void> CsvReader::CheckFieldCount(std::size_t columns) const {
  if (fields_.size() == columns) return {};
  return InputError(
      Where(),
      "has " + std::to_string(fields_.size()) + " fields, the header " + std::to_string(columns),
      "correct the row");
}

Result<void> CsvReader::ReadRecord() {
  line_ = next_line_;
  // Reuses the field strings, so that a million records do not allocate a million times.
  std::size_t count = 0;
  const auto next_field = [&]() -> std::string& {
    if (count == fields_.size()) fields_.emplace_back();
    fields_[count].clear();
    return fields_[count++];
  };
  std::string* field = &next_field();
  const std::size_t begin = at_;
  bool quoted = false;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (quoted) {
      if (c == '\n') ++next_line_;
      if (c != '"') {
        *field += c;
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        *field += '"';
        ++at_;
      } else {
        quoted = false;
      }
    } else if (c == '"' && Trimmed(*field).empty()) {
      field->clear();
      quoted = true;
    } else if (c == ',') {
      field = &next_field();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      *field += c;
    }
  }
  if (quoted) {
    return InputError(Where(), "a quoted field is not closed", "end it with a quotation mark");
  }
  record_ = text_.substr(begin, at_ - begin);
  if (!record_.empty() && record_.back() == '\r') record_.remove_suffix(1);
  fields_.resize(count);
  ++next_line_;
  ++at_;  // The line feed.
  return {};
}

}  // namespace pleinair::files
