#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "files/json_fields.h"
#include "scene/cloudiness.h"
#include "scene/scene_facts.h"

namespace pleinair::scene {
namespace {

// Names of marker families in descriptions, and ours: AprilTag 3's families and S-G markers.
constexpr std::array<std::pair<const char*, const char*>, 9> kFamilies = {{
    {"tag36h11", "tag36h11"},
    {"tag25h9", "tag25h9"},
    {"tag16h5", "tag16h5"},
    {"tagCircle21h7", "tagCircle21h7"},
    {"tagCircle49h12", "tagCircle49h12"},
    {"tagCustom48h12", "tagCustom48h12"},
    {"tagStandard41h12", "tagStandard41h12"},
    {"tagStandard52h13", "tagStandard52h13"},
    {"S-G", "sg"},
}};

// Family and id from a text such as "AprilTag tag36h11 id 0, 10x10 modules".
void ParseMarkerDescription(const std::string& words, MarkerFacts* facts) {
  for (const auto& [said, family] : kFamilies) {
    if (words.find(said) == std::string::npos) continue;
    facts->family = family;
    const std::size_t id = words.find(" id ");
    if (id == std::string::npos) return;
    const std::string digits = words.substr(id + 4, 6);
    if (!digits.empty() && std::isdigit(static_cast<unsigned char>(digits[0])) != 0) {
      facts->id = std::atoi(digits.c_str());
    }
    return;
  }
}

// The value of the first of several alternative keys that is present.
Result<std::optional<double>> NumberOf(const files::JsonFields& fields,
                                       std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (fields.Has(key)) return fields.Number(key);
  }
  return std::nullopt;
}

Result<void> ReadMarker(const files::JsonFields& marker, MarkerFacts* facts) {
  ParseMarkerDescription(marker.TextOr("what"), facts);
  if (marker.Has("family")) {
    PLEINAIR_ASSIGN_OR_RETURN(facts->family, marker.Text("family"));
    const std::string family = facts->family.value_or("picture");
    const bool known =
        family == "picture" || std::any_of(kFamilies.begin(), kFamilies.end(),
                                           [&](const auto& of) { return family == of.second; });
    if (!known) {
      return marker.Fail("family", "is unknown: \"" + family.substr(0, 64) + "\"",
                         "S-G markers are \"sg\", usual AprilTags \"tag36h11\"");
    }
  }
  if (marker.Has("id")) {
    PLEINAIR_ASSIGN_OR_RETURN(facts->id, marker.Integer("id"));
  }
  PLEINAIR_ASSIGN_OR_RETURN(facts->target, marker.Text("target"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->version, marker.Integer("version"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->size_m, NumberOf(marker, {"size_m", "black_square_side_m"}));
  PLEINAIR_ASSIGN_OR_RETURN(facts->board_size_m, marker.Number("board_size_m"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->heading_deg, marker.Number("heading_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->upright, marker.Flag("upright"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->albedo_black, marker.Number("albedo_black"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->albedo_white, marker.Number("albedo_white"));
  return {};
}

Result<void> ReadPlaceTime(const files::JsonFields& fields, PlaceTimeFacts* facts) {
  PLEINAIR_ASSIGN_OR_RETURN(facts->latitude_deg, fields.Number("latitude_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->longitude_deg, fields.Number("longitude_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->height_m, fields.Number("height_m"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> utc, fields.Text("utc"));
  if (utc) {
    Result<UtcTime> start = UtcTime::Parse(*utc);
    if (!start) return fields.Fail("utc", start.error().what, start.error().remedy);
    facts->start = *start;
  }
  return {};
}

Result<void> ReadModel(const files::JsonFields& model, std::vector<ModelReference>* models) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> file, model.Text("file"));
  if (!file) return {};
  ModelReference reference;
  reference.file = *file;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> shading, model.Text("shading"));
  if (shading) {
    const bool flat = shading->starts_with("flat"), smooth = shading->starts_with("smooth");
    if (!flat && !smooth && !shading->starts_with("file")) {
      return model.Fail("shading", "is not known", "known are file, flat, smooth");
    }
    if (flat) reference.shading = Shading::kFlat;
    if (smooth) reference.shading = Shading::kSmooth;
  }
  models->push_back(std::move(reference));
  return {};
}

// A number, or a list with one a frame.
Result<std::optional<std::vector<double>>> NumbersOf(const files::JsonFields& fields,
                                                     const char* key) {
  const files::Json* value = fields.Find(key);
  if (value == nullptr) return std::nullopt;
  if (value->is_array()) return fields.Numbers(key);
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> number, fields.Number(key));
  if (!number) return std::nullopt;
  return std::vector<double>{*number};
}

// Metadata of the lens, under the keys of [lens] in a scene.toml. `focus_dioptres` may stand in
// place of `focus_m`.
Result<LensDescription> ReadLens(const files::JsonFields& lens) {
  LensFacts facts;
  if (lens.TextOr("focus_m") == "infinity") {
    facts.focus_m = {std::numeric_limits<double>::infinity()};
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(facts.focus_m, NumbersOf(lens, "focus_m"));
  }
  PLEINAIR_ASSIGN_OR_RETURN(facts.focus_dioptres, NumbersOf(lens, "focus_dioptres"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.aperture_mm, lens.Number("aperture_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.f_number, lens.Number("f_number"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.focal_length_mm, lens.Number("focal_length_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.blades, lens.Integer("blades"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.blade_rotation_deg, lens.Number("blade_rotation_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.exposure_ms, NumbersOf(lens, "exposure_ms"));
  return CompleteLens(facts, lens.name());
}

// The verbal weather description. The amounts and the model in `sky` are ground truth and are not
// read.
std::optional<Cloudiness> ReadCloudiness(const files::JsonFields& fields) {
  std::string words = fields.TextOr("name");
  for (const char* key : {"cloudiness", "weather", "sky"}) words += "; " + fields.TextOr(key);
  for (const char* block : {"sky", "place_time"}) {
    for (const char* key : {"clouds", "cloudiness", "condition", "weather"}) {
      words += "; " + fields.Object(block).TextOr(key);
    }
  }
  return ParseCloudiness(words);
}

}  // namespace

Result<SceneFacts> ParseSceneJson(std::string_view bytes, const std::string& name) {
  PLEINAIR_ASSIGN_OR_RETURN(const files::Json document, files::ParseJson(bytes, name));
  const files::JsonFields fields(document, name);
  SceneFacts facts;
  // scene.json nests these fields in a block, recording.json has them at the top level.
  PLEINAIR_RETURN_IF_ERROR(ReadPlaceTime(
      fields.Has("place_time") ? fields.Object("place_time") : fields, &facts.place_time));
  PLEINAIR_RETURN_IF_ERROR(ReadMarker(fields.Object("marker"), &facts.marker));
  PLEINAIR_RETURN_IF_ERROR(ReadModel(fields.Object("real_geometry"), &facts.phantoms));
  PLEINAIR_RETURN_IF_ERROR(ReadModel(fields.Object("virtual_object"), &facts.objects));
  facts.cloudiness = ReadCloudiness(fields);
  if (fields.Has("lens")) {
    PLEINAIR_ASSIGN_OR_RETURN(facts.camera.recorded_lens, ReadLens(fields.Object("lens")));
  }
  for (const files::JsonFields& block : {fields, fields.Object("calibration")}) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> response,
                              block.Text("camera_response"));
    if (!response || response->empty()) continue;
    facts.camera.response =
        (std::filesystem::path(name).parent_path() / *response).lexically_normal();
  }
  PLEINAIR_RETURN_IF_ERROR(CheckRanges(facts, name));
  return facts;
}

}  // namespace pleinair::scene
