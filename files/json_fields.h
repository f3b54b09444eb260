#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace pleinair::files {

using Json = nlohmann::json;

/// A JSON document. Errors name line and column; a file cut short says so.
Result<Json> ParseJson(std::string_view bytes, const std::string& name);

/// The first YAML document as JSON; OpenCV's "%YAML:1.0" header is taken too. Plain scalars that
/// read as numbers become numbers (also .nan and .inf). At most 32 levels and 100,000 values
/// after following aliases.
Result<Json> ParseYaml(std::string_view bytes, const std::string& name);

/// Typed look at one JSON object for reading foreign files: a field that is absent (or null) is
/// nothing, one of the wrong type is an error that names file and field.
class JsonFields {
 public:
  /// `object` must outlive this; what is not an object counts as one without fields.
  JsonFields(const Json& object, std::string name, std::string path = {});

  bool Has(const char* key) const { return Find(key) != nullptr; }
  /// The object under `key`; without fields where there is none.
  JsonFields Object(const char* key) const;
  /// The raw value under `key`, or null.
  const Json* Find(const char* key) const;

  Result<std::optional<double>> Number(const char* key) const;  ///< Finite.
  Result<std::optional<int>> Integer(const char* key) const;
  Result<std::optional<bool>> Flag(const char* key) const;  ///< true/false or 0/1.
  Result<std::optional<std::string>> Text(const char* key) const;
  /// A list of finite numbers; lists in it are joined, so that a matrix may be written by rows.
  Result<std::optional<std::vector<double>>> Numbers(const char* key) const;

  /// The text under `key`, or "" where it is absent or of another type.
  std::string TextOr(const char* key) const;

  const std::string& name() const { return name_; }
  /// An error about `key` of this object.
  tl::unexpected<Error> Fail(const std::string& key, const std::string& what,
                             std::string remedy = {}) const;

 private:
  const Json& object_;
  std::string name_;
  std::string path_;
};

}  // namespace pleinair::files
