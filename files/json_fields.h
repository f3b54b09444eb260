#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace pleinair::files {

using Json = nlohmann::json;

/// Parses a JSON document. Errors give line and column, and report a truncated file as such.
Result<Json> ParseJson(std::string_view bytes, const std::string& name);

/// The first YAML document as JSON. Accepts OpenCV's "%YAML:1.0" header. Plain scalars that read as
/// numbers become numbers (.nan and .inf too). Errors: more than 32 levels, or more than 100,000
/// values after aliases are expanded.
Result<Json> ParseYaml(std::string_view bytes, const std::string& name);

/// Typed access to one JSON object of a foreign file. A field that is absent or null gives nullopt;
/// a field of the wrong type is an error that names file and field.
class JsonFields {
 public:
  /// `object` must outlive this. A value that is not an object is treated as an empty object.
  JsonFields(const Json& object, std::string name, std::string path = {});

  bool Has(const char* key) const { return Find(key) != nullptr; }
  /// The object under `key`, or an empty one.
  JsonFields Object(const char* key) const;
  /// The raw value under `key`, or null.
  const Json* Find(const char* key) const;

  Result<std::optional<double>> Number(const char* key) const;  ///< Finite.
  Result<std::optional<int>> Integer(const char* key) const;
  Result<std::optional<bool>> Flag(const char* key) const;  ///< true/false or 0/1.
  Result<std::optional<std::string>> Text(const char* key) const;
  /// A list of finite numbers. Nested lists are concatenated, so that a matrix may be written by
  /// rows.
  Result<std::optional<std::vector<double>>> Numbers(const char* key) const;

  /// The text under `key`, or "" where it is absent or of another type.
  std::string TextOr(const char* key) const;

  const std::string& name() const { return name_; }
  /// Makes an error about `key` of this object.
  tl::unexpected<Error> Fail(const std::string& key, const std::string& what,
                             std::string remedy = {}) const;

 private:
  const Json& object_;
  std::string name_;
  std::string path_;
};

}  // namespace pleinair::files
