#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/frame_record.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::app {

// Each record describes its fields once to a visitor. FieldWriter converts it to JSON and
// FieldReader parses it back. Numbers have the fewest digits that parse back to the same value.

using RecordJsonValue = nlohmann::ordered_json;

template <typename T>
RecordJsonValue ToJson(const T& value) {
  return value;
}
template <typename T>
RecordJsonValue ToJson(const std::optional<T>& value) {
  return value ? RecordJsonValue(*value) : RecordJsonValue();
}
inline RecordJsonValue ToJson(const std::array<Vec2, 4>& points) {
  RecordJsonValue json = RecordJsonValue::array();
  for (const Vec2 point : points) json.push_back({point.x, point.y});
  return json;
}
inline RecordJsonValue ToJson(const Transform<Camera, Marker>& pose) {
  const Vec3& t = pose.translation_m;
  return {{"rotation", pose.rotation.m}, {"translation_m", {t.x, t.y, t.z}}};
}

inline constexpr std::array<const char*, 3> kOutcomeNames{"hit", "misplaced", "missed"};

inline RecordJsonValue ToJson(accuracy::Outcome outcome) {
  return kOutcomeNames[static_cast<std::size_t>(outcome)];
}

template <typename T>
void FromJson(const RecordJsonValue& json, T* value) {
  json.get_to(*value);
}
template <typename T>
void FromJson(const RecordJsonValue& json, std::optional<T>* value) {
  *value = json.is_null() ? std::nullopt : std::optional(json.get<T>());
}
inline void FromJson(const RecordJsonValue& json, std::array<Vec2, 4>* points) {
  for (std::size_t i = 0; i < 4; ++i) {
    (*points)[i] = {json.at(i).at(0).get<double>(), json.at(i).at(1).get<double>()};
  }
}
inline void FromJson(const RecordJsonValue& json, Transform<Camera, Marker>* pose) {
  json.at("rotation").get_to(pose->rotation.m);
  const auto t = json.at("translation_m").get<std::array<double, 3>>();
  pose->translation_m = {t[0], t[1], t[2]};
}
inline void FromJson(const RecordJsonValue& json, accuracy::Outcome* outcome) {
  const auto name = json.get<std::string>();
  for (std::size_t i = 0; i < kOutcomeNames.size(); ++i) {
    if (name != kOutcomeNames[i]) continue;
    *outcome = static_cast<accuracy::Outcome>(i);
    return;
  }
  throw RecordJsonValue::type_error::create(302, "no outcome: " + name, &json);
}

/// Adds fields to a JSON object, in the order of the calls.
class FieldWriter {
 public:
  template <typename T>
  void Field(const char* name, const T& value) {
    json[name] = ToJson(value);
  }
  /// Written only if true.
  void Flag(const char* name, bool value) {
    if (value) json[name] = true;
  }
  /// Returns whether the fields of `part` follow. `first`: name of its first field.
  template <typename T>
  bool Part(const char* /*first*/, const std::optional<T>& part) {
    return part.has_value();
  }

  RecordJsonValue json = RecordJsonValue::object();
};

/// Reads fields from a JSON object. Throws nlohmann's exceptions for missing fields and wrong
/// types.
class FieldReader {
 public:
  explicit FieldReader(const RecordJsonValue& json) : json_(json) {}

  template <typename T>
  void Field(const char* name, T& value) {
    FromJson(json_.at(name), &value);
  }
  void Flag(const char* name, bool& value) { value = json_.value(name, false); }
  template <typename T>
  bool Part(const char* first, std::optional<T>& part) {
    if (!json_.contains(first)) return false;
    part.emplace();
    return true;
  }

 private:
  const RecordJsonValue& json_;
};

/// JSON as one line without its end. Invalid UTF-8 becomes U+FFFD.
inline std::string LineOf(const RecordJsonValue& json) {
  return json.dump(-1, ' ', false, RecordJsonValue::error_handler_t::replace);
}

/// Returns a discarded value if the text is not JSON or is nested deeper than any stored record.
RecordJsonValue ParseRecordJson(std::string_view text);

/// Parses a text with `tell(json, &record)`. Returns `refusal` if the text is not JSON, lacks a
/// field or has a wrong type.
template <typename Record, typename Tell>
Result<Record> ReadJson(std::string_view text, const tl::unexpected<Error>& refusal, Tell tell) {
  const RecordJsonValue json = ParseRecordJson(text);
  if (json.is_discarded()) return refusal;
  try {
    Record record;
    tell(json, &record);
    return record;
  } catch (const RecordJsonValue::exception&) {
    return refusal;
  }
}

}  // namespace pleinair::app
