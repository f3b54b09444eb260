#include "files/json_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>

namespace pleinair::files {
namespace {

const Json& NoObject() {
  static const Json none = Json::object();
  return none;
}

// Appends the numbers of a list and of its nested lists, to a depth of two.
bool AppendNumbers(const Json& list, int depth, std::vector<double>* numbers) {
  for (const Json& item : list) {
    if (item.is_number()) {
      numbers->push_back(item.get<double>());
    } else if (!item.is_array() || depth == 0 || !AppendNumbers(item, depth - 1, numbers)) {
      return false;
    }
  }
  return true;
}

}  // namespace

Result<Json> ParseJson(std::string_view bytes, const std::string& name) {
  try {
    return Json::parse(bytes.begin(), bytes.end());
  } catch (const Json::parse_error& error) {
    // `byte` counts from 1; behind the last byte the text ends within a value.
    if (error.byte > bytes.size()) {
      return InputError(name, "is not whole JSON: it ends within a value",
                        "the file is cut short: get a whole copy of it");
    }
    const std::string_view before = bytes.substr(0, error.byte > 0 ? error.byte - 1 : 0);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t start = before.rfind('\n');
    const std::size_t column =
        1 + (start == std::string_view::npos ? before.size() : before.size() - start - 1);
    return InputError(name,
                      "is not whole JSON: what stands at line " + std::to_string(line) +
                          ", column " + std::to_string(column) + " cannot be read",
                      "correct the file there");
  } catch (const std::exception&) {
    return InputError(name, "is not whole JSON: a number is too large to be read",
                      "correct the file");
  }
}

JsonFields::JsonFields(const Json& object, std::string name, std::string path)
    : object_(object.is_object() ? object : NoObject()),
      name_(std::move(name)),
      path_(std::move(path)) {}

const Json* JsonFields::Find(const char* key) const {
  const auto found = object_.find(key);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

JsonFields JsonFields::Object(const char* key) const {
  const Json* value = Find(key);
  return {value != nullptr ? *value : NoObject(), name_, path_ + key + "."};
}

tl::unexpected<Error> JsonFields::Fail(const std::string& key, const std::string& what,
                                       std::string remedy) const {
  return InputError(name_, "\"" + path_ + key + "\" " + what, std::move(remedy));
}

Result<std::optional<double>> JsonFields::Number(const char* key) const {
  const Json* value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number()) return Fail(key, "is not a number");
  const double number = value->get<double>();
  if (!std::isfinite(number)) return Fail(key, "is not a finite number");
  return number;
}

Result<std::optional<int>> JsonFields::Integer(const char* key) const {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> number, Number(key));
  if (!number) return std::nullopt;
  if (std::trunc(*number) != *number || std::fabs(*number) > std::numeric_limits<int>::max()) {
    return Fail(key, "is not a whole number of reasonable size");
  }
  return static_cast<int>(*number);
}

Result<std::optional<bool>> JsonFields::Flag(const char* key) const {
  const Json* value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (value->is_boolean()) return value->get<bool>();
  if (value->is_number()) return value->get<double>() != 0.0;
  return Fail(key, "is neither true nor false");
}

Result<std::optional<std::string>> JsonFields::Text(const char* key) const {
  const Json* value = Find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_string()) return Fail(key, "is not a text");
  auto text = value->get<std::string>();
  // The operating system would cut a file's name there.
  if (text.find('\0') != std::string::npos) return Fail(key, "holds a NUL character");
  return text;
}

Result<std::optional<std::vector<double>>> JsonFields::Numbers(const char* key) const {
  const Json* value = Find(key);
  if (value == nullptr) return std::nullopt;
  std::vector<double> numbers;
  if (!value->is_array() || !AppendNumbers(*value, 1, &numbers)) {
    return Fail(key, "is not a list of numbers");
  }
  for (const double number : numbers) {
    if (!std::isfinite(number)) return Fail(key, "holds a number that is not finite");
  }
  return numbers;
}

std::string JsonFields::TextOr(const char* key) const {
  const Json* value = Find(key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

}  // namespace pleinair::files
