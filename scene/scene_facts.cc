#include "scene/scene_facts.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "scene/magnetic_declination.h"

namespace pleinair::scene {
namespace {

// Uses `fallback` if `fact` is unset.
template <typename T>
void Fill(std::optional<T>& fact, const std::optional<T>& fallback) {
  if (!fact) fact = fallback;
}

bool Within(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

/// "95", "0.1": at most six digits.
std::string Short(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

/// Range of a value of a scene, in any of its formats.
struct FactRange {
  const char* name;
  double min, max;
  const char* meaning;
};
constexpr FactRange kLatitude{"latitude_deg", -90.0, 90.0, "degrees, north is positive"};
constexpr FactRange kLongitude{"longitude_deg", -180.0, 180.0, "degrees, east is positive"};
constexpr FactRange kHeight{"height_m", -1000.0, 20000.0, "metres above sea level"};
constexpr FactRange kHeading{"marker.heading_deg", -360.0, 360.0,
                             "degrees clockwise from true north"};
constexpr FactRange kMagneticHeading{"marker.heading_magnetic_deg", -360.0, 360.0,
                                     "degrees clockwise from magnetic north"};
// From a pinhead to a sports field.
constexpr FactRange kSize{"marker.size_m", 1e-4, 1e3, "the edge of the outer black square, metres"};
constexpr FactRange kId{"marker.id", 0.0, 1e9, "marker numbers count from 0"};
constexpr FactRange kOffset{"marker.offset_m", -10000.0, 10000.0,
                            "metres from [place] to the marker's origin: east, north, up"};
constexpr FactRange kPositionSd{"marker.position_sd_m", 0.0, 1000.0,
                                "the standard deviation of that place, metres"};
constexpr FactRange kTurbidity{"turbidity", 1.0, 64.0,
                               "2 is a clear sky, 3 an ordinary one, 6 haze"};

template <typename T>
Result<void> CheckFact(const std::optional<T>& value, const FactRange& range,
                       const std::string& file) {
  if (!value || Within(static_cast<double>(*value), range.min, range.max)) return {};
  return InputError(file,
                    std::string(range.name) + " is " + Short(static_cast<double>(*value)) +
                        ", outside " + Short(range.min) + " to " + Short(range.max),
                    range.meaning);
}

/// A target file defines number, kind and size, so the scene must not repeat them.
Result<void> CheckTarget(const MarkerFacts& facts, const std::string& name) {
  constexpr const char* kFamily = "picture";
  const bool is_picture = facts.family.value_or(kFamily) == kFamily;
  if (!facts.target) {
    if (!facts.family || !is_picture) return {};
    return InputError(name, "has a picture target as its marker but does not name it",
                      "add marker.target, a file that `pleinair target` made");
  }
  if (facts.target->empty()) {
    return InputError(name, "has a marker.target without a name", "name the target's file");
  }
  if (!is_picture || facts.id || facts.version || facts.size_m || facts.board_size_m) {
    return InputError(name, "has both a target and the number, kind or size of a marker",
                      "keep marker.target alone: its file knows how large the picture is");
  }
  return {};
}

/// From true north, clockwise.
Result<Radians> Heading(const MarkerFacts& facts, const PlaceTime& place_time,
                        const std::string& name) {
  if (facts.heading_deg && facts.heading_magnetic_deg) {
    return InputError(name, "has both heading_deg and heading_magnetic_deg", "keep one of them");
  }
  if (!facts.heading_deg && !facts.heading_magnetic_deg) {
    return InputError(name, "does not say which way the marker points",
                      "add marker.heading_deg: azimuth of its upper edge, clockwise from true "
                      "north; or marker.heading_magnetic_deg, as a compass shows it");
  }
  const double heading_deg = facts.heading_deg ? *facts.heading_deg : *facts.heading_magnetic_deg;
  if (facts.heading_deg) return FromDegrees(heading_deg);
  const Result<Radians> declination = MagneticDeclination(
      place_time.latitude_deg, place_time.longitude_deg, place_time.height_m, place_time.start);
  if (!declination) {
    return InputError(name, "has a heading_magnetic_deg, but " + declination.error().what,
                      declination.error().remedy);
  }
  return Radians(FromDegrees(heading_deg).value() + declination->value());
}

Result<MarkerDescription> CompleteMarker(const MarkerFacts& facts, const PlaceTime& place_time,
                                         const std::string& name) {
  MarkerDescription marker;
  PLEINAIR_RETURN_IF_ERROR(CheckTarget(facts, name));
  if (!facts.size_m && !facts.target) {
    return InputError(name, "does not say how large the marker is",
                      "add marker.size_mm: the edge of the outer black square");
  }
  PLEINAIR_ASSIGN_OR_RETURN(marker.heading, Heading(facts, place_time, name));
  marker.family = facts.family;
  marker.id = facts.id;
  marker.version = facts.version;
  marker.size_m = facts.size_m.value_or(0.0);
  if (facts.target) marker.target = *facts.target;
  marker.upright = facts.upright.value_or(false);
  marker.offset_m = facts.origin.offset_m.value_or(Vec3{});
  marker.position_sd_m = facts.origin.position_sd_m.value_or(0.0);
  marker.albedo_black = facts.albedo_black.value_or(marker.albedo_black);
  marker.albedo_white = facts.albedo_white.value_or(marker.albedo_white);
  if (!Within(marker.albedo_black, 0.0, 1.0) || !Within(marker.albedo_white, 0.0, 1.0) ||
      marker.albedo_black >= marker.albedo_white) {
    return InputError(name, "has marker reflectances that are not 0 <= black < white <= 1",
                      "leave marker.albedo_black and marker.albedo_white out when unsure");
  }
  // tag36h11's black square is ten modules wide; with one white module on each side the sheet is
  // 1.2 times as wide, and common sheets have 1.2 to 1.25.
  marker.board_size_m = facts.board_size_m.value_or(1.25 * marker.size_m);
  if (!Within(marker.board_size_m, marker.size_m, 1e4)) {
    return InputError(name, "has a marker board that is smaller than its black square",
                      "marker.board_size_mm is the edge of the white board around it");
  }
  return marker;
}

Result<PlaceTime> CompletePlaceTime(const PlaceTimeFacts& facts, const std::string& name) {
  if (!facts.latitude_deg || !facts.longitude_deg) {
    return InputError(name, "does not say where the recording was made",
                      "add latitude_deg (north positive) and longitude_deg (east positive)");
  }
  if (!facts.start) {
    return InputError(name, "does not say when the recording was made",
                      "add its time as RFC 3339, for example 2025-09-14T11:05:00Z");
  }
  const double height_m = facts.height_m.value_or(0.0);
  return PlaceTime{*facts.latitude_deg, *facts.longitude_deg, height_m, *facts.start,
                   facts.above_ellipsoid.value_or(false)};
}

constexpr const char* kOurFamily = "sg";  // Default family of a marker with anchors.

Result<std::vector<AnchorDescription>> CompleteAnchors(const std::vector<AnchorFacts>& facts,
                                                       const MarkerDescription& marker,
                                                       const std::string& name) {
  constexpr std::size_t kMaxAnchors = 64;
  std::vector<AnchorDescription> anchors;
  if (facts.empty()) return anchors;
  if (marker.target || !marker.id) {
    return InputError(name, "has anchors beside a marker without a number",
                      "add marker.id, the number of the marker that the models are placed on");
  }
  if (facts.size() > kMaxAnchors) {
    return InputError(name, "has more than 64 anchors", "keep those that the film shows");
  }
  const std::string family = marker.family.value_or(kOurFamily);
  std::set<std::pair<std::string, int>> taken{{family, *marker.id}};
  for (const AnchorFacts& each : facts) {
    AnchorDescription anchor{each.family.value_or(family),
                             each.id.value_or(-1),
                             each.size_m.value_or(marker.size_m),
                             {}};
    const std::string number = std::to_string(anchor.id);
    if (!each.id) return InputError(name, "has an anchor without an id", "add the marker's number");
    if (!taken.insert({anchor.family, anchor.id}).second) {
      return InputError(name, "has the marker " + anchor.family + " " + number + " twice",
                        "each marker is the reference marker or one anchor");
    }
    if (!Within(anchor.size_m, 1e-4, 1e3)) {
      return InputError(name, "has an anchor " + number + " of an impossible size",
                        "size_mm is the edge of the outer black square, 0.1 to 1000000");
    }
    if (each.rotation_deg && !each.translation_m) {
      return InputError(name, "has an anchor " + number + " with rotation_deg alone",
                        "add its translation_m, or leave both out: the film gives them");
    }
    if (each.translation_m) {
      anchor.place = AnchorPlace{*each.translation_m, each.rotation_deg.value_or(Vec3{})};
      for (const Vec3& v : {anchor.place->translation_m, anchor.place->rotation_deg}) {
        if (Within(v.x, -1e4, 1e4) && Within(v.y, -1e4, 1e4) && Within(v.z, -1e4, 1e4)) continue;
        return InputError(name, "places the anchor " + number + " beyond ten thousand metres",
                          "translation_m is its centre in the marker's coordinates");
      }
    }
    anchors.push_back(std::move(anchor));
  }
  return anchors;
}

bool IsReflectance(LinearRgb color) {
  return Within(color.r, 0.0, 1.0) && Within(color.g, 0.0, 1.0) && Within(color.b, 0.0, 1.0);
}

Result<void> CheckPlacement(const ModelReference& model, const std::string& name) {
  const std::string file = model.surface ? model.surface->name : model.file.string();
  if (model.surface && !IsReflectance(model.surface->reflectance)) {
    return InputError(name, "gives the " + file + " a color outside 0 to 1",
                      "color is the linear reflectance in red, green and blue");
  }
  if (model.surface) {
    for (const std::vector<Vec3>& polygon : model.surface->polygons) {
      for (const Vec3& v : polygon) {
        if (Within(v.x, -1e6, 1e6) && Within(v.y, -1e6, 1e6) && Within(v.z, -1e6, 1e6)) continue;
        return InputError(name, "places the " + file + " beyond a million metres",
                          "give its corners in metres");
      }
    }
  }
  if (file.empty()) return InputError(name, "has a model without a file name", "add its file");
  if (!Within(model.scale, 1e-9, 1e9)) {
    return InputError(name,
                      "scales " + file + " by " + Short(model.scale) + ", outside 1e-09 to 1e+09",
                      "scale enlarges the model");
  }
  for (const Vec3& v : {model.translation_m, model.rotation_deg}) {
    // Eastings and northings of surveys reach ten million metres.
    if (!Within(v.x, -1e7, 1e7) || !Within(v.y, -1e7, 1e7) || !Within(v.z, -1e7, 1e7)) {
      return InputError(name, "places " + file + " beyond ten million metres or degrees",
                        "check its translation_m and rotation_deg");
    }
  }
  return {};
}

/// Level ground, if the scene has it or may be given it.
Result<std::optional<ModelReference>> CompleteGround(const SceneFacts& facts, bool upright,
                                                     const std::string& name) {
  constexpr double kUsualSide_m = 30.0;
  constexpr double kPrint_m = 0.001;  // The thickness of a printed sheet.
  const GroundFacts& ground = facts.ground;
  const bool is_assumed = !ground.is_given && ground.may_be_assumed && facts.phantoms.empty();
  if (!ground.is_given && !is_assumed) return std::nullopt;
  if (upright && !ground.height_m) {
    // Nobody knows how high the marker hangs.
    if (is_assumed) return std::nullopt;
    return InputError(name, "has ground below an upright marker at no height",
                      "add ground.height_m: the marker's centre above the ground, metres");
  }
  const double side_m = ground.size_m.value_or(kUsualSide_m);
  const double height_m = ground.height_m.value_or(kPrint_m);
  if (!Within(side_m, 0.1, 1e4) || !Within(height_m, 0.0, 1e3)) {
    return InputError(name, "has ground of an impossible size or height",
                      "ground.size_m is its side, 0.1 to 10000; ground.height_m that of the marker "
                      "above it, 0 to 1000");
  }
  ModelReference model;
  model.surface = GroundSurface(side_m, height_m, upright);
  model.surface->is_assumed = is_assumed;
  model.surface->has_color = ground.color.has_value();
  model.surface->reflectance = ground.color.value_or(kUsualReflectance);
  return model;
}

Result<void> CheckLight(const SceneFacts& facts, const std::string& name) {
  if (facts.camera.exposure_scale) {
    for (const double exposure_scale :
         {facts.camera.exposure_scale->r, facts.camera.exposure_scale->g,
          facts.camera.exposure_scale->b}) {
      if (!Within(exposure_scale, 1e-12, 1e12)) {
        return InputError(
            name, "has an exposure_gain of " + Short(exposure_scale) + ", outside 1e-12 to 1e+12",
            "leave exposure_gain out to have it measured on the marker");
      }
    }
  }
  return {};
}

}  // namespace

Result<SceneFacts> ParseScene(std::string_view bytes, const std::string& name) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  // No TOML document begins with a brace.
  const bool json = first != std::string_view::npos && bytes[first] == '{';
  return json ? ParseSceneJson(bytes, name) : ParseSceneToml(bytes, name);
}

Result<void> CheckRanges(const SceneFacts& facts, const std::string& name) {
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.place_time.latitude_deg, kLatitude, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.place_time.longitude_deg, kLongitude, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.place_time.height_m, kHeight, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.marker.heading_deg, kHeading, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.marker.heading_magnetic_deg, kMagneticHeading, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.marker.size_m, kSize, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.marker.id, kId, name));
  PLEINAIR_RETURN_IF_ERROR(CheckFact(facts.marker.origin.position_sd_m, kPositionSd, name));
  const Vec3 offset_m = facts.marker.origin.offset_m.value_or(Vec3{});
  for (const double metres : {offset_m.x, offset_m.y, offset_m.z}) {
    PLEINAIR_RETURN_IF_ERROR(CheckFact(std::optional(metres), kOffset, name));
  }
  return CheckFact(facts.turbidity, kTurbidity, name);
}

SceneFacts WithFallback(SceneFacts facts, const SceneFacts& fallback) {
  Fill(facts.place_time.latitude_deg, fallback.place_time.latitude_deg);
  Fill(facts.place_time.longitude_deg, fallback.place_time.longitude_deg);
  // A height and what it is measured from belong together.
  if (!facts.place_time.height_m) {
    Fill(facts.place_time.above_ellipsoid, fallback.place_time.above_ellipsoid);
  }
  Fill(facts.place_time.height_m, fallback.place_time.height_m);
  Fill(facts.place_time.start, fallback.place_time.start);
  // The margin's size and the marker's identity describe one sheet of paper, so they are taken over
  // only together with the marker's size.
  if (!facts.marker.size_m && !facts.marker.target) {
    Fill(facts.marker.target, fallback.marker.target);
    Fill(facts.marker.size_m, fallback.marker.size_m);
    Fill(facts.marker.board_size_m, fallback.marker.board_size_m);
    Fill(facts.marker.family, fallback.marker.family);
    Fill(facts.marker.id, fallback.marker.id);
    Fill(facts.marker.version, fallback.marker.version);
    Fill(facts.marker.albedo_black, fallback.marker.albedo_black);
    Fill(facts.marker.albedo_white, fallback.marker.albedo_white);
  }
  if (!facts.marker.heading_magnetic_deg) {
    Fill(facts.marker.heading_deg, fallback.marker.heading_deg);
  }
  Fill(facts.marker.upright, fallback.marker.upright);
  Fill(facts.camera.recorded_lens, fallback.camera.recorded_lens);
  Fill(facts.cloudiness, fallback.cloudiness);
  if (facts.camera.response.empty()) facts.camera.response = fallback.camera.response;
  return facts;
}

Result<SceneDescription> CompleteScene(const SceneFacts& facts, const std::filesystem::path& file) {
  const std::string name = file.string();
  PLEINAIR_RETURN_IF_ERROR(CheckRanges(facts, name));
  SceneDescription scene;
  scene.file = file;
  PLEINAIR_ASSIGN_OR_RETURN(scene.place_time, CompletePlaceTime(facts.place_time, name));
  PLEINAIR_ASSIGN_OR_RETURN(scene.marker, CompleteMarker(facts.marker, scene.place_time, name));
  scene.trajectory = facts.trajectory;
  scene.camera.lens = facts.camera.lens;
  scene.camera.recorded_lens = facts.camera.recorded_lens;
  PLEINAIR_ASSIGN_OR_RETURN(scene.anchors, CompleteAnchors(facts.anchors, scene.marker, name));
  // Otherwise an anchor of another family with the same number could pass for the marker.
  if (!scene.anchors.empty() && !scene.marker.family) scene.marker.family = kOurFamily;
  if (scene.marker.target) {
    scene.marker.target = (file.parent_path() / *scene.marker.target).lexically_normal();
  }
  PLEINAIR_RETURN_IF_ERROR(CheckLight(facts, name));
  static_cast<SceneContent&>(scene) = facts;
  PLEINAIR_ASSIGN_OR_RETURN(auto ground, CompleteGround(facts, scene.marker.upright, name));
  if (ground) scene.phantoms.push_back(*std::move(ground));
  for (std::vector<ModelReference>* models : {&scene.phantoms, &scene.objects}) {
    for (ModelReference& model : *models) {
      PLEINAIR_RETURN_IF_ERROR(CheckPlacement(model, name));
      if (model.surface) continue;
      model.file = (file.parent_path() / model.file).lexically_normal();
    }
  }
  PLEINAIR_RETURN_IF_ERROR(CompleteDrapes(file.parent_path(), &scene));
  scene.cloudiness = facts.cloudiness.value_or(Cloudiness::kClear);
  scene.clouds.layers = facts.cloud_layers;
  if (!scene.clouds.layers.empty()) {
    scene.clouds.ignored_word = facts.cloudiness;
    scene.cloudiness = Cloudiness::kClear;
  }
  scene.turbidity = facts.turbidity;
  scene.camera.exposure_scale = facts.camera.exposure_scale;
  scene.camera.response = facts.camera.response;
  return scene;
}

}  // namespace pleinair::scene
