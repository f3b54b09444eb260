#include "scene/toml_layout.h"

#include <algorithm>
#include <utility>

namespace pleinair::scene {
namespace {

// The parser that checks the text allows no more.
constexpr int kMaxDepth = 256;

/// Walks through a TOML text (TOML 1.0). Every step ends inside the text.
class TomlWalk {
 public:
  explicit TomlWalk(std::string_view text) : text_(text) {}

  std::vector<TomlSection> Sections() {
    std::vector<TomlSection> sections(1);
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // Byte order mark.
    sections[0].end = at_;
    SkipBlank(true);
    while (!IsOver()) {
      if (Peek() == '[') {
        sections.push_back({Header(), 0, {}});
      } else {
        sections.back().entries.push_back(Entry(0));
      }
      SkipLine();
      sections.back().end = at_;
      SkipBlank(true);
    }
    return sections;
  }

 private:
  bool IsOver() const { return at_ >= text_.size(); }
  char Peek() const { return IsOver() ? '\0' : text_[at_]; }
  bool Take(char wanted) {
    if (Peek() != wanted || IsOver()) return false;
    ++at_;
    return true;
  }

  /// Skips white space and, with `lines`, line ends and comments.
  void SkipBlank(bool lines) {
    while (!IsOver()) {
      const char c = Peek();
      if (c == ' ' || c == '\t' || (lines && (c == '\n' || c == '\r'))) {
        ++at_;
      } else if (lines && c == '#') {
        SkipLine();
      } else {
        return;
      }
    }
  }

  /// Goes to the beginning of the next line.
  void SkipLine() {
    const std::size_t line_end = text_.find('\n', at_);
    at_ = line_end == std::string_view::npos ? text_.size() : line_end + 1;
  }

  std::vector<std::string> Header() {
    while (Take('[')) {
    }
    std::vector<std::string> path = Keys();
    while (Take(']')) {
    }
    return path;
  }

  /// A key, dotted or not, with the white space that follows it.
  std::vector<std::string> Keys() {
    std::vector<std::string> keys;
    do {
      SkipBlank(false);
      const std::size_t begin = at_;
      if (Peek() == '"' || Peek() == '\'') {
        SkipQuoted();
        keys.emplace_back(text_.substr(begin + 1, at_ - begin > 1 ? at_ - begin - 2 : 0));
      } else {
        at_ = std::min(text_.find_first_of(" \t.=]\r\n", at_), text_.size());
        keys.emplace_back(text_.substr(begin, at_ - begin));
      }
      key_end_ = at_;
      SkipBlank(false);
    } while (Take('.'));
    return keys;
  }

  TomlEntry Entry(int depth) {
    TomlEntry entry;
    entry.key_begin = at_;
    entry.keys = Keys();
    entry.key_end = key_end_;
    Take('=');
    SkipBlank(false);
    Value(depth, &entry);
    return entry;
  }

  void Value(int depth, TomlEntry* value) {
    value->begin = at_;
    if (depth > kMaxDepth) {
      at_ = text_.size();
    } else if (Peek() == '"' || Peek() == '\'') {
      SkipQuoted();
    } else if (Peek() == '[' || Peek() == '{') {
      Container(depth, value);
    } else {
      // A date and time may contain a space.
      at_ = std::min(text_.find_first_of(",]}#\r\n", at_), text_.size());
    }
    value->end = at_;
    while (value->end > value->begin &&
           (text_[value->end - 1] == ' ' || text_[value->end - 1] == '\t')) {
      --value->end;
    }
  }

  void Container(int depth, TomlEntry* value) {
    value->is_table = Peek() == '{';
    value->is_array = !value->is_table;
    const char closing = value->is_table ? '}' : ']';
    ++at_;
    while (true) {
      SkipBlank(true);
      if (IsOver() || Take(closing)) return;
      const std::size_t before = at_;
      if (value->is_table) {
        value->items.push_back(Entry(depth + 1));
      } else {
        Value(depth + 1, &value->items.emplace_back());
      }
      SkipBlank(true);
      Take(',');
      if (at_ == before) ++at_;  // Only in text that is not TOML.
    }
  }

  /// Goes behind a text in quotes, also one of several lines.
  void SkipQuoted() {
    const char quote = Peek();
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_).starts_with(three);
    at_ += is_long ? 3 : 1;
    while (!IsOver()) {
      if (quote == '"' && Take('\\')) {
        at_ = std::min(at_ + 1, text_.size());
        continue;
      }
      const bool closes = is_long ? text_.substr(at_).starts_with(three) : Peek() == quote;
      at_ += closes && is_long ? 3 : 1;
      if (!closes) continue;
      // Up to two quotes may stand before the three that close.
      while (is_long && Take(quote)) {
      }
      return;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t key_end_ = 0;  // End of the last key, without the white space after it.
};

}  // namespace

std::vector<TomlSection> LayoutOf(std::string_view text) { return TomlWalk(text).Sections(); }

}  // namespace pleinair::scene
