#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scene/cloudiness.h"
#include "scene/scene_facts.h"
#include "scene/toml_clouds.h"
#include "scene/toml_drapes.h"
#include "scene/toml_leaves.h"
#include "scene/toml_lens.h"
#include "scene/toml_surfaces.h"
#include "scene/toml_table.h"
#include "scene/toml_trajectory.h"
#include "scene/zoned_time.h"

namespace pleinair::scene {
namespace {

// A quoted time, optionally with a time zone, or TOML's own offset date-time.
Result<std::optional<UtcTime>> ReadTime(const TomlTable& table, const char* key) {
  const toml::node* node = table.Find(key);
  if (node == nullptr) return std::nullopt;
  std::string text;
  if (const toml::value<toml::date_time>* moment = node->as_date_time()) {
    // toml++ prints RFC 3339; the parser below rejects it if the offset is missing.
    std::ostringstream printed;
    printed << moment->get();
    text = printed.str();
  } else if (const std::optional<std::string> quoted = node->value_exact<std::string>()) {
    text = *quoted;
  } else {
    return table.Fail(key, "is not a date and time",
                      "write it as RFC 3339, for example 2025-09-14T11:05:00Z");
  }
  Result<ZonedTime> zoned = ParseZonedTime(text);
  if (zoned) return zoned->time;
  if (zoned.error().kind == ErrorKind::kSystem) {
    return tl::make_unexpected(std::move(zoned).error());
  }
  return table.Fail(key, "is no moment: " + zoned.error().what, zoned.error().remedy);
}

Result<void> ReadPlace(const TomlTable& place, PlaceTimeFacts* facts) {
  PLEINAIR_RETURN_IF_ERROR(place.AllowOnly(
      {"name", "latitude_deg", "longitude_deg", "height_m", "height_reference", "time"}));
  PLEINAIR_RETURN_IF_ERROR(place.Text("name"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->latitude_deg, place.Number("latitude_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->longitude_deg, place.Number("longitude_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->height_m, place.Number("height_m"));
  PLEINAIR_ASSIGN_OR_RETURN(const auto reference, place.Text("height_reference"));
  if (reference && *reference != "sea" && *reference != "ellipsoid") {
    return place.Fail("height_reference", "is not known", "known are sea and ellipsoid");
  }
  if (reference) facts->above_ellipsoid = *reference == "ellipsoid";
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<UtcTime> time, ReadTime(place, "time"));
  if (time && facts->start) {
    return place.Fail("time", "is given here and at the top", "keep one of them");
  }
  if (time) facts->start = time;
  return {};
}

Result<void> ReadMarker(const TomlTable& marker, MarkerFacts* facts) {
  PLEINAIR_RETURN_IF_ERROR(
      marker.AllowOnly({"family", "target", "id", "version", "size_m", "size_mm", "board_size_m",
                        "board_size_mm", "heading_deg", "heading_magnetic_deg", "upright",
                        "albedo_black", "albedo_white", "offset_m", "position_sd_m"}));
  PLEINAIR_ASSIGN_OR_RETURN(facts->family, marker.Text("family"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->target, marker.Text("target"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->id, marker.Integer("id"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->version, marker.Integer("version"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->size_m, marker.Length("size_m", "size_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->board_size_m, marker.Length("board_size_m", "board_size_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->heading_deg, marker.Number("heading_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->heading_magnetic_deg, marker.Number("heading_magnetic_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->upright, marker.Flag("upright"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->origin.offset_m, marker.Triple("offset_m"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->origin.position_sd_m, marker.Number("position_sd_m"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->albedo_black, marker.Number("albedo_black"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->albedo_white, marker.Number("albedo_white"));
  return {};
}

Result<std::vector<AnchorFacts>> ReadAnchors(const TomlTable& scene) {
  std::vector<AnchorFacts> anchors;
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables("anchor"));
  for (const TomlTable& table : tables) {
    PLEINAIR_RETURN_IF_ERROR(
        table.AllowOnly({"family", "id", "size_m", "size_mm", "translation_m", "rotation_deg"}));
    AnchorFacts& anchor = anchors.emplace_back();
    PLEINAIR_ASSIGN_OR_RETURN(anchor.family, table.Text("family"));
    PLEINAIR_ASSIGN_OR_RETURN(anchor.id, table.Integer("id"));
    PLEINAIR_ASSIGN_OR_RETURN(anchor.size_m, table.Length("size_m", "size_mm"));
    PLEINAIR_ASSIGN_OR_RETURN(anchor.translation_m, table.Triple("translation_m"));
    PLEINAIR_ASSIGN_OR_RETURN(anchor.rotation_deg, table.Triple("rotation_deg"));
  }
  return anchors;
}

Result<SceneFacts> ReadScene(const TomlTable& scene) {
  PLEINAIR_RETURN_IF_ERROR(
      scene.AllowOnly({"time", "cloudiness", "turbidity", "exposure_gain", "camera_response",
                       "place", "marker", "anchor", "ground", "box", "wall", "phantom", "object",
                       "leaf", "trajectory", "lens", "cloud_layer", "drape"}));
  SceneFacts facts;
  PLEINAIR_ASSIGN_OR_RETURN(facts.place_time.start, ReadTime(scene, "time"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> places, scene.Tables("place"));
  if (places.size() > 1) return scene.Fail("place", "is given more than once", "keep one place");
  if (!places.empty()) PLEINAIR_RETURN_IF_ERROR(ReadPlace(places[0], &facts.place_time));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> markers, scene.Tables("marker"));
  if (markers.size() > 1) {
    return scene.Fail("marker", "is given more than once",
                      "keep the marker that the models are placed on; the others are [[anchor]]");
  }
  if (!markers.empty()) PLEINAIR_RETURN_IF_ERROR(ReadMarker(markers[0], &facts.marker));
  PLEINAIR_ASSIGN_OR_RETURN(facts.anchors, ReadAnchors(scene));
  PLEINAIR_ASSIGN_OR_RETURN(facts.trajectory, ReadTrajectoryTable(scene));
  PLEINAIR_ASSIGN_OR_RETURN(facts.camera.lens, ReadLensTable(scene));
  PLEINAIR_ASSIGN_OR_RETURN(facts.phantoms, ReadModels(scene, "phantom"));
  PLEINAIR_RETURN_IF_ERROR(ReadDescribedSurfaces(scene, &facts.phantoms));
  PLEINAIR_RETURN_IF_ERROR(ReadGround(scene, &facts.ground));
  PLEINAIR_ASSIGN_OR_RETURN(facts.objects, ReadModels(scene, "object"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.leaves, ReadLeaves(scene));
  PLEINAIR_ASSIGN_OR_RETURN(facts.drapes, ReadDrapes(scene));
  PLEINAIR_ASSIGN_OR_RETURN(facts.cloud_layers, ReadCloudLayers(scene));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> sky, scene.Text("cloudiness"));
  if (sky) {
    facts.cloudiness = ParseCloudiness(*sky);
    if (!facts.cloudiness) {
      return scene.Fail("cloudiness", "is not known", std::string("known are ") + kCloudinessWords);
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(facts.turbidity, scene.Number("turbidity"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> exposure_scale,
                            scene.Triple("exposure_gain"));
  if (exposure_scale)
    facts.camera.exposure_scale =
        LinearRgb{exposure_scale->x, exposure_scale->y, exposure_scale->z};
  PLEINAIR_ASSIGN_OR_RETURN(const auto response, scene.Text("camera_response"));
  if (response) {
    facts.camera.response =
        (std::filesystem::path(scene.file()).parent_path() / *response).lexically_normal();
  }
  return facts;
}

}  // namespace

Result<SceneFacts> ParseSceneToml(std::string_view bytes, const std::string& name) {
  const toml::parse_result parsed = toml::parse(bytes);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    return InputError(name + ":" + std::to_string(error.source().begin.line),
                      "is not TOML: " + std::string(error.description()),
                      "correct that line, or get a whole copy of the file");
  }
  return ReadScene(TomlTable(parsed.table(), name));
}

}  // namespace pleinair::scene
