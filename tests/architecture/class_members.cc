#include "tests/architecture/class_members.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace pleinair::architecture {
namespace {

struct Token {
  int line = 0;
  std::string text;
};
using Tokens = std::vector<Token>;

bool IsWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Splits a text into words, numbers and punctuation. Omits comments and directives. A string or
/// character literal becomes an empty string.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  Tokens Run() {
    while (at_ < text_.size()) Next();
    return std::move(tokens_);
  }

 private:
  void Next() {
    const char c = text_[at_];
    const std::string_view rest = text_.substr(at_);
    if (c == '\n') line_begins_ = true;
    if (std::isspace(static_cast<unsigned char>(c))) {
      Skip(1);
    } else if (rest.starts_with("//")) {
      Skip(rest.find('\n'));
    } else if (rest.starts_with("/*")) {
      Skip(EndOf(rest, "*/", 2));
    } else if (c == '#' && line_begins_) {
      SkipDirective();
    } else if (rest.starts_with("R\"")) {
      const std::string end = ")" + std::string(rest.substr(2, rest.find('(') - 2)) + "\"";
      Add("\"\"", EndOf(rest, end, 2));
    } else if (c == '"' || c == '\'') {
      std::size_t length = 1;
      while (length < rest.size() && rest[length] != c) length += rest[length] == '\\' ? 2 : 1;
      Add("\"\"", length + 1);
    } else if (IsWordCharacter(c)) {
      // Digit separators belong to a number.
      const bool number = std::isdigit(static_cast<unsigned char>(c)) != 0;
      const auto end = std::find_if(rest.begin(), rest.end(), [&](char other) {
        return !IsWordCharacter(other) && !(number && (other == '\'' || other == '.'));
      });
      const auto length = static_cast<std::size_t>(end - rest.begin());
      Add(std::string(rest.substr(0, length)), length);
    } else {
      // ">>" may close two template argument lists; "<<" opens none.
      static constexpr std::array<std::string_view, 7> kPairs = {
          "::", "<<", "->", "<=", ">=", "==", "&&"};
      const bool pair = std::find(kPairs.begin(), kPairs.end(), rest.substr(0, 2)) != kPairs.end();
      Add(std::string(rest.substr(0, pair ? 2 : 1)), pair ? 2 : 1);
    }
  }

  static std::size_t EndOf(std::string_view text, std::string_view mark, std::size_t from) {
    const std::size_t at = text.find(mark, from);
    return at == std::string_view::npos ? text.size() : at + mark.size();
  }

  void Add(std::string token, std::size_t length) {
    tokens_.push_back({line_, std::move(token)});
    line_begins_ = false;
    Skip(length);
  }

  void Skip(std::size_t length) {
    const std::string_view skipped = text_.substr(at_, length);
    line_ += static_cast<int>(std::count(skipped.begin(), skipped.end(), '\n'));
    at_ += skipped.size();
  }

  void SkipDirective() {
    while (at_ < text_.size() && text_[at_] != '\n') Skip(text_[at_] == '\\' ? 2 : 1);
  }

  std::string_view text_;
  Tokens tokens_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool line_begins_ = true;
};

/// Index after the bracket that closes the one at `open`; the end if there is none.
std::size_t AfterClosing(const Tokens& tokens, std::size_t open, std::size_t end) {
  const std::string& opening = tokens[open].text;
  const std::string closing = opening == "(" ? ")" : opening == "[" ? "]" : "}";
  int depth = 0;
  for (std::size_t i = open; i < end; ++i) {
    if (tokens[i].text == opening) ++depth;
    if (tokens[i].text == closing && --depth == 0) return i + 1;
  }
  return end;
}

/// Index after the '>' that closes the '<' at `open`; open + 1 if the '<' is a comparison.
std::size_t AfterTemplateArguments(const Tokens& tokens, std::size_t open, std::size_t end) {
  int depth = 0;
  for (std::size_t i = open; i < end;) {
    const std::string& text = tokens[i].text;
    if (text == ";" || text == ")" || text == "]" || text == "}") break;
    if (text == "(" || text == "[" || text == "{") {
      i = AfterClosing(tokens, i, end);
      continue;
    }
    if (text == "<") ++depth;
    if (text == ">" && --depth == 0) return i + 1;
    ++i;
  }
  return open + 1;
}

/// Number of data members that a declaration in class scope declares. `declaration` contains
/// neither its ';' nor the braces of nested classes.
std::size_t CountDeclarators(const Tokens& declaration) {
  if (declaration.empty()) return 0;
  static constexpr std::array<std::string_view, 5> kNoMembers = {"using", "typedef", "friend",
                                                                 "static_assert", "template"};
  const auto is = [&](std::size_t i, std::string_view text) {
    return i < declaration.size() && declaration[i].text == text;
  };
  if (std::find(kNoMembers.begin(), kNoMembers.end(), declaration.front().text) !=
      kNoMembers.end()) {
    return 0;
  }
  // `class Worker;` declares no member, `struct tm start;` one.
  static constexpr std::array<std::string_view, 3> kTypes = {"class", "struct", "union"};
  if (is(0, "enum") ||
      (declaration.size() == 2 &&
       std::find(kTypes.begin(), kTypes.end(), declaration.front().text) != kTypes.end())) {
    return 0;
  }
  std::size_t declarators = 1;
  bool in_initializer = false;
  for (std::size_t i = 0; i < declaration.size();) {
    if (!in_initializer && (is(i, "static") || is(i, "operator"))) return 0;
    if (is(i, "alignas") || is(i, "decltype")) {
      i = AfterClosing(declaration, i + 1, declaration.size());
    } else if (is(i, "(") && !in_initializer && !is(i + 1, "*") && !is(i + 1, "&")) {
      return 0;  // A function.
    } else if (is(i, "(") || is(i, "[") || is(i, "{")) {
      i = AfterClosing(declaration, i, declaration.size());
      // The parameters of a pointer to a function.
      if (is(i - 1, ")") && is(i, "(")) i = AfterClosing(declaration, i, declaration.size());
    } else if (is(i, "<")) {
      i = AfterTemplateArguments(declaration, i, declaration.size());
    } else {
      if (is(i, "=")) in_initializer = true;
      if (is(i, ",")) {
        ++declarators;
        in_initializer = false;
      }
      ++i;
    }
  }
  return declarators;
}

/// The head of a class or struct.
struct ClassHead {
  std::string name;
  std::size_t open_brace = 0;  ///< Index of its token; 0: the keyword begins no definition.
};

ClassHead ParseHead(const Tokens& tokens, std::size_t keyword, std::size_t end) {
  ClassHead head;
  bool in_bases = false;
  for (std::size_t i = keyword + 1; i < end;) {
    const std::string& text = tokens[i].text;
    if (text == "{") {
      head.open_brace = i;
      return head;
    }
    if (text == "<") {
      i = AfterTemplateArguments(tokens, i, end);
    } else if (text == "[") {
      i = AfterClosing(tokens, i, end);
    } else if (text == "alignas") {
      i = AfterClosing(tokens, i + 1, end);
    } else if (in_bases || text == ":" || text == "final") {
      if (text == ";" || text == "(") return {};
      in_bases = in_bases || text == ":";
      ++i;
    } else if (text == "::" || IsWordCharacter(text.front())) {
      // `struct stat status{}` names a C type and a variable.
      if (text != "::" && !head.name.empty() && !head.name.ends_with("::")) return {};
      head.name += text;
      ++i;
    } else {
      return {};
    }
  }
  return {};
}

class Parser {
 public:
  explicit Parser(Tokens tokens) : tokens_(std::move(tokens)) {}

  std::vector<ClassMembers> Run() {
    FindClasses(0, tokens_.size(), "");
    return std::move(classes_);
  }

 private:
  bool Is(std::size_t i, std::string_view text) const {
    return i < tokens_.size() && tokens_[i].text == text;
  }

  /// Index after the class whose keyword is at `i`; `i` if it defines none.
  std::size_t ParseClass(std::size_t i, std::size_t end, const std::string& around) {
    if (!(Is(i, "class") || Is(i, "struct")) || (i > 0 && Is(i - 1, "enum"))) return i;
    const ClassHead head = ParseHead(tokens_, i, end);
    if (head.open_brace == 0) return i;
    const std::string name = around.empty() ? head.name : around + "::" + head.name;
    const std::size_t after = AfterClosing(tokens_, head.open_brace, end);
    const std::size_t members = CountMembers(head.open_brace + 1, after - 1, name);
    classes_.push_back({tokens_[i].line, name, members});
    return after;
  }

  void FindClasses(std::size_t begin, std::size_t end, const std::string& around) {
    for (std::size_t i = begin; i < end;) {
      const std::size_t after = ParseClass(i, end, around);
      i = after == i ? i + 1 : after;
    }
  }

  /// True if the '{' after `declaration` opens a function body, enumeration, union or extern block,
  /// and not an initialiser.
  static bool OpensBody(const Tokens& declaration) {
    for (std::size_t i = 0; i < declaration.size();) {
      const std::string& text = declaration[i].text;
      if ((text == "alignas" || text == "decltype") && i + 1 < declaration.size()) {
        i = AfterClosing(declaration, i + 1, declaration.size());
        continue;
      }
      // A pointer to a function, not the parameters of one.
      if (text == "(" && i + 1 < declaration.size() && declaration[i + 1].text == "*") return false;
      if (text == "enum" || text == "union" || text == "(" || text == "operator") return true;
      if (text == "=") return false;
      i = text == "<" ? AfterTemplateArguments(declaration, i, declaration.size()) : i + 1;
    }
    return false;
  }

  std::size_t CountMembers(std::size_t begin, std::size_t end, const std::string& name) {
    std::size_t members = 0;
    Tokens declaration;
    const auto finish = [&] {
      members += CountDeclarators(declaration);
      declaration.clear();
    };
    for (std::size_t i = begin; i < end;) {
      const std::size_t after_class = ParseClass(i, end, name);
      if (after_class != i) {
        i = after_class;
        // `struct A {…};` declares no member, `struct {…} a;` one.
        declaration.clear();
        continue;
      }
      if (Is(i, ";")) {
        finish();
        ++i;
      } else if (Is(i, ":") && declaration.size() == 1 &&
                 (declaration[0].text == "public" || declaration[0].text == "private" ||
                  declaration[0].text == "protected")) {
        declaration.clear();
        ++i;
      } else if (Is(i, "{") && OpensBody(declaration)) {
        const std::size_t after = AfterClosing(tokens_, i, end);
        FindClasses(i, after, name);
        // Constructor initialisers with braces precede the body.
        const bool initialiser = Is(after, ",") || Is(after, "{");
        const bool type = declaration.front().text == "enum" || declaration.front().text == "union";
        if (!initialiser || type) declaration.clear();
        i = after;
      } else if (Is(i, "{") || Is(i, "(") || Is(i, "[")) {
        const std::size_t after = AfterClosing(tokens_, i, end);
        FindClasses(i, after, name);
        declaration.insert(declaration.end(), tokens_.begin() + static_cast<std::ptrdiff_t>(i),
                           tokens_.begin() + static_cast<std::ptrdiff_t>(after));
        i = after;
      } else {
        declaration.push_back(tokens_[i++]);
      }
    }
    return members;
  }

  Tokens tokens_;
  std::vector<ClassMembers> classes_;
};

}  // namespace

std::vector<ClassMembers> ParseClasses(std::string_view text) {
  return Parser(Lexer(text).Run()).Run();
}

bool IsSimdCode(std::string_view text) {
  return text.find("#include \"hwy/highway.h\"") != std::string_view::npos ||
         text.find("#include <hwy/highway.h>") != std::string_view::npos;
}

}  // namespace pleinair::architecture
