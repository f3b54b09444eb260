#include <charconv>
#include <exception>
#include <limits>

#include <yaml-cpp/yaml.h>

#include "files/json_fields.h"

namespace pleinair::files {
namespace {

constexpr int kMaxDepth = 32;
constexpr int kMaxValues = 100'000;

Json ScalarAsJson(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  // yaml-cpp gives quoted scalars the tag "!"; they are always text.
  if (node.Tag() == "!") return text;
  if (text == ".nan" || text == ".NaN" || text == ".NAN" || text == ".Nan" || text == "nan" ||
      text == "NaN") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const bool negative = text.starts_with('-');
  const std::string_view magnitude =
      std::string_view(text).substr(negative || text.starts_with('+') ? 1 : 0);
  if (magnitude == ".inf" || magnitude == ".Inf" || magnitude == ".INF" || magnitude == "inf") {
    const double infinity = std::numeric_limits<double>::infinity();
    return negative ? -infinity : infinity;
  }
  double number = 0.0;
  const char* end = magnitude.data() + magnitude.size();
  // from_chars also reads "infinity" and "nan(…)", which are text in YAML.
  if (!magnitude.empty() && (magnitude[0] == '.' || (magnitude[0] >= '0' && magnitude[0] <= '9'))) {
    const auto [stop, error] = std::from_chars(magnitude.data(), end, number);
    if (stop == end && error == std::errc()) return negative ? -number : number;
    if (stop == end && error == std::errc::result_out_of_range) {
      return std::numeric_limits<double>::infinity();
    }
  }
  if (text == "true" || text == "True") return true;
  if (text == "false" || text == "False") return false;
  return text;
}

// Counts the converted values, because aliases can expand a page of YAML to billions of values.
bool Convert(const YAML::Node& node, int depth, int* values_left, Json* json) {
  if (depth == 0 || --*values_left < 0) return false;
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      *json = ScalarAsJson(node);
      return true;
    case YAML::NodeType::Sequence:
      *json = Json::array();
      for (const YAML::Node& item : node) {
        if (!Convert(item, depth - 1, values_left, &json->emplace_back())) return false;
      }
      return true;
    case YAML::NodeType::Map:
      *json = Json::object();
      for (const auto& item : node) {
        if (!item.first.IsScalar()) return false;
        if (!Convert(item.second, depth - 1, values_left, &(*json)[item.first.Scalar()])) {
          return false;
        }
      }
      return true;
    default:
      *json = nullptr;
      return true;
  }
}

}  // namespace

Result<Json> ParseYaml(std::string_view bytes, const std::string& name) {
  // OpenCV writes "%YAML:1.0", which is not a valid YAML directive.
  if (bytes.starts_with("%YAML:")) {
    const std::size_t line_end = bytes.find('\n');
    bytes.remove_prefix(line_end == std::string_view::npos ? bytes.size() : line_end + 1);
  }
  try {
    const YAML::Node document = YAML::Load(std::string(bytes));
    Json json;
    int values_left = kMaxValues;
    if (!Convert(document, kMaxDepth, &values_left, &json)) {
      return InputError(name, "is YAML too deep or too long for a calibration",
                        "check that it is the file you mean");
    }
    return json;
  } catch (const YAML::Exception& error) {
    return InputError(name,
                      "is not whole YAML: what stands at line " +
                          std::to_string(error.mark.line + 1) + ", column " +
                          std::to_string(error.mark.column + 1) + " cannot be read",
                      "correct the file there, or get a whole copy of it");
  } catch (const std::exception&) {
    return InputError(name, "is not whole YAML", "get a whole copy of it");
  }
}

}  // namespace pleinair::files
