#include "scene/toml_text.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "scene/toml_layout.h"
#include "scene/toml_table.h"

namespace pleinair::scene {
namespace {

Result<void> CheckIsToml(std::string_view text, const std::string& name) {
  const toml::parse_result parsed = toml::parse(text);
  if (parsed) return {};
  return InputError(name + ":" + std::to_string(parsed.error().source().begin.line),
                    "is not TOML: " + std::string(parsed.error().description()),
                    "correct that line");
}

std::string_view TextOf(std::string_view text, const TomlEntry& value) {
  return text.substr(value.begin, value.end - value.begin);
}

std::optional<double> NumberIn(std::string_view written) {
  std::string digits;
  for (const char c : written) {
    if (c != '_') digits += c;
  }
  if (digits.starts_with('+')) digits.erase(0, 1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

/// Where the table of a change is in a text.
struct TableInText {
  const TomlSection* section = nullptr;  // Under a header, or the top.
  const TomlEntry* value = nullptr;      // Inline.
  const TomlSection* dotted = nullptr;   // The section with its dotted keys.
};

TableInText FindTable(const std::vector<TomlSection>& sections, const TomlChange& change) {
  if (change.table.empty()) return {.section = &sections[0]};
  std::size_t index = 0;
  for (const TomlSection& section : sections) {
    if (section.path.size() != 1 || section.path[0] != change.table) continue;
    if (index++ == change.index) return {.section = &section};
  }
  for (const TomlEntry& entry : sections[0].entries) {
    if (entry.keys[0] != change.table) continue;
    if (entry.keys.size() > 1) return {.dotted = &sections[0]};
    if (!entry.is_array) return {.value = &entry};
    if (change.index < entry.items.size()) return {.value = &entry.items[change.index]};
  }
  return {};
}

const TomlEntry* FindEntry(const TableInText& table, const TomlChange& change,
                           const std::string& key) {
  const std::vector<TomlEntry>& entries = table.section  ? table.section->entries
                                          : table.dotted ? table.dotted->entries
                                                         : table.value->items;
  for (const TomlEntry& entry : entries) {
    if (table.dotted ? entry.keys == std::vector{change.table, key}
                     : entry.keys == std::vector{key}) {
      return &entry;
    }
  }
  return nullptr;
}

/// One replacement of bytes.
struct Splice {
  std::size_t begin = 0, end = 0;
  std::string text;
};

/// Collects what differs between a value of the text and a new one.
void Compare(std::string_view text, const TomlEntry& old_value, std::string_view new_text,
             const TomlEntry& new_value, double tolerance, std::vector<Splice>* splices) {
  const std::string_view was = TextOf(text, old_value), is = TextOf(new_text, new_value);
  if (old_value.is_array && new_value.is_array &&
      old_value.items.size() == new_value.items.size()) {
    for (std::size_t i = 0; i < old_value.items.size(); ++i) {
      Compare(text, old_value.items[i], new_text, new_value.items[i], tolerance, splices);
    }
    return;
  }
  const auto old_number = NumberIn(was), new_number = NumberIn(is);
  if (was == is || (old_number && new_number && std::abs(*old_number - *new_number) <= tolerance)) {
    return;
  }
  splices->push_back({old_value.begin, old_value.end, std::string(is)});
}

/// Text of an additional line, with the line end that the text has.
Splice LineAt(std::string_view text, std::size_t at, const std::string& line) {
  const std::string line_end = text.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  const bool begins_line = at == 0 || text[at - 1] == '\n';
  return {at, at, (begins_line ? "" : line_end) + line + line_end};
}

Splice Addition(std::string_view text, const TableInText& table, const TomlChange& change) {
  const std::string line = change.key + " = " + change.value;
  if (table.section != nullptr) return LineAt(text, table.section->end, line);
  if (table.dotted != nullptr) {
    return LineAt(text, table.dotted->end, change.table + "." + line);
  }
  // `ground = true` becomes a table.
  if (!table.value->is_table) return {table.value->begin, table.value->end, "{ " + line + " }"};
  if (table.value->items.empty()) {
    return {table.value->begin, table.value->end, "{ " + line + " }"};
  }
  const std::size_t last = table.value->items.back().end;
  return {last, last, ", " + line};
}

Result<std::string> WithChange(std::string text, const std::string& name,
                               const TomlChange& change) {
  const std::vector<TomlSection> sections = LayoutOf(text);
  const TableInText table = FindTable(sections, change);
  std::vector<Splice> splices;
  if (table.section == nullptr && table.value == nullptr && table.dotted == nullptr) {
    if (change.index > 0) {
      return InputError(name, "has no " + change.table + " " + std::to_string(change.index + 1),
                        "read the scene again");
    }
    const Splice head = LineAt(text, text.size(), "[" + change.table + "]");
    text += head.text;
    const Splice body = LineAt(text, text.size(), change.key + " = " + change.value);
    return text + body.text;
  }
  if (const TomlEntry* entry = FindEntry(table, change, change.key)) {
    const std::string assigned = "x = " + change.value;
    const std::vector<TomlSection> given = LayoutOf(assigned);
    Compare(text, *entry, assigned, given[0].entries.at(0), change.tolerance, &splices);
  } else if (const TomlEntry* other =
                 change.replaces.empty() ? nullptr : FindEntry(table, change, change.replaces)) {
    const std::string key = (table.dotted ? change.table + "." : "") + change.key;
    splices = {{other->key_begin, other->key_end, key}, {other->begin, other->end, change.value}};
  } else {
    splices = {Addition(text, table, change)};
  }
  // From the end, so that the places before stay.
  for (auto splice = splices.rbegin(); splice != splices.rend(); ++splice) {
    text.replace(splice->begin, splice->end - splice->begin, splice->text);
  }
  return text;
}

}  // namespace

Result<std::string> ChangeToml(std::string_view text, const std::string& name,
                               const std::vector<TomlChange>& changes) {
  PLEINAIR_RETURN_IF_ERROR(CheckIsToml(text, name));
  std::string changed(text);
  for (const TomlChange& change : changes) {
    PLEINAIR_ASSIGN_OR_RETURN(changed, WithChange(std::move(changed), name, change));
  }
  PLEINAIR_RETURN_IF_ERROR(CheckIsToml(changed, name));
  return changed;
}

}  // namespace pleinair::scene
