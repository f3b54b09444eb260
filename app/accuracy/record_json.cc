#include "app/accuracy/record_json.h"

#include <utility>

#include "app/accuracy/record_fields.h"

namespace pleinair::app {
namespace {

using Json = RecordJsonValue;
using accuracy::FrameRecord;
using accuracy::MarkerRecord;
using accuracy::Outcome;

// Records are const when they are written.

template <typename Visitor, typename Pose>
void TellPose(Visitor& visit, Pose& pose) {
  visit.Field("pose", pose.camera_from_marker);
  visit.Field("rotation_error_deg", pose.rotation_error_deg);
  visit.Field("translation_error_m", pose.translation_error_m);
  visit.Field("nees", pose.nees);
  visit.Field("ambiguity_ratio", pose.ambiguity_ratio);
  visit.Field("alternative_error_deg", pose.alternative_error_deg);
}

template <typename Visitor, typename Marker>
void TellMarker(Visitor& visit, Marker& marker) {
  visit.Field("number", marker.number);
  visit.Field("true_pose", marker.true_camera_from_marker);
  visit.Field("true_corners", marker.true_corners_px);
  visit.Field("border_covered", marker.border_covered);
  visit.Field("content_covered", marker.content_covered);
  visit.Field("outcome", marker.outcome);
  if (marker.outcome == Outcome::kMissed) return;
  visit.Field("corner_error", marker.corner_error_px);
  visit.Field("visible_fraction", marker.visible_fraction);
  visit.Field("path", marker.path);
  if (visit.Part("pose", marker.pose)) TellPose(visit, *marker.pose);
}

template <typename Visitor, typename Record>
void TellFrame(Visitor& visit, Record& record) {
  visit.Field("frame", record.frame);
  visit.Field("name", record.name);
  visit.Field("sweep", record.sweep);
  visit.Field("pattern", record.pattern);
  visit.Field("level", record.level);
  visit.Field("repeat", record.repeat);
  visit.Field("detector", record.detector);
  visit.Flag("truth_aligned", record.truth_aligned);
  visit.Field("false_numbers", record.false_numbers);
  visit.Field("lost", record.lost);
}

template <typename Visitor, typename Record>
void TellPicture(Visitor& visit, Record& record) {
  visit.Field("recording", record.recording);
  visit.Field("picture", record.picture);
  for (std::size_t i = 0; i < accuracy::kImageMeasures.size(); ++i) {
    visit.Field(accuracy::kImageMeasures[i].name, record.scores[i]);
  }
}

tl::unexpected<Error> NoRecord(const std::string& where) {
  return InputError(where, "is no record of an accuracy run",
                    "run 'pleinair accuracy' again with the same -o");
}

}  // namespace

RecordJsonValue ParseRecordJson(std::string_view text) {
  // nlohmann's copies and dump() recurse once per level: a file must not control the depth.
  constexpr int kMostLevels = 32;
  bool too_deep = false;
  RecordJsonValue json = RecordJsonValue::parse(
      text,
      [&too_deep](int depth, RecordJsonValue::parse_event_t, const RecordJsonValue&) {
        too_deep |= depth > kMostLevels;
        return !too_deep;
      },
      false);
  return too_deep ? RecordJsonValue(RecordJsonValue::value_t::discarded) : std::move(json);
}

std::string RecordJson(const FrameRecord& record, bool with_times) {
  FieldWriter frame;
  TellFrame(frame, record);
  frame.json["markers"] = Json::array();
  for (const MarkerRecord& marker : record.markers) {
    FieldWriter writer;
    TellMarker(writer, marker);
    frame.json["markers"].push_back(std::move(writer.json));
  }
  if (with_times) {
    for (const auto& [stage, ms] : record.stages_ms) frame.json["stages_ms"][stage] = ms;
  }
  return LineOf(frame.json);
}

Result<FrameRecord> ParseRecord(std::string_view line, const std::string& where) {
  return ReadJson<FrameRecord>(line, NoRecord(where), [](const Json& json, FrameRecord* record) {
    FieldReader frame(json);
    TellFrame(frame, *record);
    for (const Json& marker : json.at("markers")) {
      FieldReader reader(marker);
      TellMarker(reader, record->markers.emplace_back());
    }
    if (!json.contains("stages_ms")) return;
    for (const auto& [stage, ms] : json.at("stages_ms").items()) {
      record->stages_ms.emplace_back(stage, ms.get<double>());
    }
  });
}

std::string PictureJson(const accuracy::ImageRecord& record) {
  FieldWriter picture;
  TellPicture(picture, record);
  return LineOf(picture.json);
}

Result<accuracy::ImageRecord> ParsePicture(std::string_view line, const std::string& where) {
  return ReadJson<accuracy::ImageRecord>(line, NoRecord(where),
                                         [](const Json& json, accuracy::ImageRecord* record) {
                                           FieldReader picture(json);
                                           TellPicture(picture, *record);
                                         });
}

}  // namespace pleinair::app
