#include "app/sun_table.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

namespace pleinair::app {
namespace {

std::string_view Trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A whole decimal number, finite; nothing otherwise.
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

constexpr std::size_t kRequiredFields = 2;  // Latitude and longitude.

/// Splits CSV records (RFC 4180) one by one.
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
  }

  /// Reads the next record that is not blank; false at the end.
  Result<bool> Next() {
    do {
      if (at_ >= text_.size()) return false;
      PLEINAIR_RETURN_IF_ERROR(ReadRecord());
    } while (Trimmed(record_).empty());
    return true;
  }

  std::string_view record() const { return record_; }
  const std::vector<std::string>& fields() const { return fields_; }
  std::string Where() const { return name_ + ":" + std::to_string(line_); }

 private:
  Result<void> ReadRecord() {
    line_ = next_line_;
    // The strings are used again: a million rows allocate once.
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

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 0;
  int next_line_ = 1;
  std::string_view record_;
  std::vector<std::string> fields_;
};

/// Column of a name in the header; nothing when it is not there.
Result<std::optional<std::size_t>> FindColumn(const CsvReader& header, std::string_view name) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < header.fields().size(); ++i) {
    if (Trimmed(header.fields()[i]) != name) continue;
    if (found) {
      return InputError(header.Where(), "two columns are called " + std::string(name),
                        "keep one of them");
    }
    found = i;
  }
  return found;
}

}  // namespace

Result<void> SetObserverField(const ObserverField& field, std::string_view text,
                              const std::string& where, sky::Observer* observer) {
  const std::optional<double> value = ParseNumber(text);
  if (!value || *value < field.lowest || *value > field.highest) {
    std::array<char, 96> range;
    std::snprintf(range.data(), range.size(), "give a number from %g to %g (%s)", field.lowest,
                  field.highest, field.unit);
    return InputError(
        where,
        std::string(field.name) + " \"" + std::string(text.substr(0, 40)) + "\" is not possible",
        range.data());
  }
  field.set(*observer, *value);
  return {};
}

Result<SunTable> ParseSunTable(std::string_view text, const std::string& name,
                               const sky::Observer& defaults) {
  CsvReader reader(text, name);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, reader.Next());
  constexpr const char* kHeaderHelp =
      "start it with the line utc,lat,lon or utc,lat,lon,height_m,pressure_mbar,temperature_c";
  if (!has_header) return InputError(name, "is empty", kHeaderHelp);
  SunTable table;
  table.header = reader.record();
  const std::size_t columns = reader.fields().size();
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::size_t> time_column,
                            FindColumn(reader, "utc"));
  if (!time_column) return InputError(reader.Where(), "the column utc is missing", kHeaderHelp);
  std::vector<std::pair<std::size_t, const ObserverField*>> field_columns;
  for (std::size_t i = 0; i < kObserverFields.size(); ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::size_t> column,
                              FindColumn(reader, kObserverFields[i].name));
    if (column) {
      field_columns.emplace_back(*column, &kObserverFields[i]);
    } else if (i < kRequiredFields) {
      return InputError(reader.Where(),
                        std::string("the column ") + kObserverFields[i].name + " is missing",
                        kHeaderHelp);
    }
  }
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, reader.Next());
    if (!more) return table;
    if (reader.fields().size() != columns) {
      return InputError(reader.Where(),
                        "has " + std::to_string(reader.fields().size()) + " fields, the header " +
                            std::to_string(columns),
                        "correct the row");
    }
    SunTableRow row;
    row.text = reader.record();
    row.observer = defaults;
    Result<UtcTime> time = UtcTime::Parse(Trimmed(reader.fields()[*time_column]));
    if (!time) {
      Error error = std::move(time).error();
      error.where = reader.Where();
      return tl::make_unexpected(std::move(error));
    }
    row.time = *time;
    for (const auto& [column, field] : field_columns) {
      const std::string& value = reader.fields()[column];
      const bool required = field < &kObserverFields[kRequiredFields];
      if (!required && Trimmed(value).empty()) continue;
      PLEINAIR_RETURN_IF_ERROR(SetObserverField(*field, value, reader.Where(), &row.observer));
    }
    table.rows.push_back(row);
  }
}

}  // namespace pleinair::app
