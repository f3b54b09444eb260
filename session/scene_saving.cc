#include "session/scene_saving.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scene/scene_facts.h"
#include "scene/toml_text.h"

namespace pleinair::session {
namespace {

// Decimals of what is written, and half a step of each: numbers of the file that differ by less
// stay.
constexpr int kLengthDecimals = 4, kAngleDecimals = 3, kLocationDecimals = 7, kAirDecimals = 2;
constexpr int kScaleDigits = 6;

double HalfStep(int decimals) { return 0.5000001 * std::pow(10.0, -decimals); }

/// A TOML float, with a decimal point or an exponent.
std::string Float(const std::string& digits) {
  const bool is_float = digits.find_first_of(".e") != std::string::npos;
  return is_float ? digits : digits + ".0";
}

std::string Fixed(double value, int decimals) {
  std::array<char, 512> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, decimals);
  std::string text(digits.data(), end.ptr);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return Float(text == "-0" ? "0" : text);
}

std::string Significant(double value) {
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, kScaleDigits);
  return Float(std::string(digits.data(), end.ptr));
}

std::string Triple(Vec3 v, int decimals) {
  return "[" + Fixed(v.x, decimals) + ", " + Fixed(v.y, decimals) + ", " + Fixed(v.z, decimals) +
         "]";
}

std::string Triples(const std::vector<Vec3>& points, int decimals) {
  std::string text = "[";
  for (const Vec3& point : points) {
    text += (text.size() > 1 ? ", " : "") + Triple(point, decimals);
  }
  return text + "]";
}

bool IsWithin(double value, double limit) {
  return std::isfinite(value) && std::abs(value) <= limit;
}

bool IsWithin(Vec3 v, double limit) {
  return IsWithin(v.x, limit) && IsWithin(v.y, limit) && IsWithin(v.z, limit);
}

/// The word of a scene for a cloud cover (scene/cloudiness.h), quoted; a hazy sky stays hazy.
std::string CloudWord(double cover, scene::Cloudiness described) {
  constexpr double kMinPartly = 0.3, kMinOvercast = 0.8;
  if (cover >= kMinOvercast) return "\"overcast\"";
  if (cover >= kMinPartly) return "\"partly cloudy\"";
  return described == scene::Cloudiness::kHazy ? "\"hazy\"" : "\"clear\"";
}

void AddLocation(const SceneEdit& from, const SceneEdit& to,
                 std::vector<scene::TomlChange>* changes) {
  const double half = HalfStep(kLocationDecimals);
  if (to.latitude_deg != from.latitude_deg || to.longitude_deg != from.longitude_deg) {
    changes->push_back(
        {"place", 0, "latitude_deg", Fixed(to.latitude_deg, kLocationDecimals), half});
    changes->push_back(
        {"place", 0, "longitude_deg", Fixed(to.longitude_deg, kLocationDecimals), half});
  }
  if (to.heading_deg && to.heading_deg != from.heading_deg) {
    const double heading_deg = *to.heading_deg - 360.0 * std::floor(*to.heading_deg / 360.0);
    changes->push_back({"marker", 0, "heading_deg", Fixed(heading_deg, kAngleDecimals),
                        HalfStep(kAngleDecimals), "heading_magnetic_deg"});
  }
}

void AddAir(const scene::SceneDescription& scene, const SceneEdit& from, const SceneEdit& to,
            std::vector<scene::TomlChange>* changes) {
  if (!to.sky || to.sky == from.sky) return;
  const SceneEdit::Sky was = from.sky.value_or(DescribedAir(scene));
  if (to.sky->cloud_cover != was.cloud_cover) {
    changes->push_back({"", 0, "cloudiness", CloudWord(to.sky->cloud_cover, scene.cloudiness)});
  }
  changes->push_back(
      {"", 0, "turbidity", Fixed(to.sky->turbidity, kAirDecimals), HalfStep(kAirDecimals)});
}

void AddPlacement(std::size_t index, const ObjectPlace& from, const ObjectPlace& to,
                  std::vector<scene::TomlChange>* changes) {
  if (!(to.translation_m == from.translation_m)) {
    changes->push_back({"object", index, "translation_m", Triple(to.translation_m, kLengthDecimals),
                        HalfStep(kLengthDecimals)});
  }
  if (!(to.rotation_deg == from.rotation_deg)) {
    changes->push_back({"object", index, "rotation_deg", Triple(to.rotation_deg, kAngleDecimals),
                        HalfStep(kAngleDecimals)});
  }
  if (to.scale != from.scale) {
    changes->push_back({"object", index, "scale", Significant(to.scale), to.scale * 5e-7});
  }
}

/// Height of the marker above the ground.
double HeightAbove(const scene::ModelReference& ground, const SurfacePlace& place, bool upright) {
  const Vec3 corner = ground.surface->polygons.at(0).at(0) + place.translation_m;
  return upright ? -corner.y : -corner.z;
}

void AddSurfaces(const scene::SceneDescription& scene, const SceneEdit& from, const SceneEdit& to,
                 std::vector<scene::TomlChange>* changes) {
  const double half = HalfStep(kLengthDecimals);
  std::size_t box = 0, wall = 0;
  for (std::size_t i = 0; i < scene.phantoms.size(); ++i) {
    if (!scene.phantoms[i].surface) continue;
    const SurfacePlace& place = to.phantoms[i];
    const bool differs = place != from.phantoms[i];
    switch (scene.phantoms[i].surface->kind) {
      case scene::SurfaceKind::kGround:
        if (!differs) break;
        changes->push_back(
            {"ground", 0, "height_m",
             Fixed(HeightAbove(scene.phantoms[i], place, scene.marker.upright), kLengthDecimals),
             half});
        break;
      case scene::SurfaceKind::kBox:
        if (differs) {
          changes->push_back(
              {"box", box, "translation_m", Triple(place.translation_m, kLengthDecimals), half});
        }
        ++box;
        break;
      case scene::SurfaceKind::kWall:
        if (differs) {
          changes->push_back(
              {"wall", wall, "corners_m", Triples(place.corners_m, kLengthDecimals), half});
        }
        ++wall;
        break;
    }
  }
}

Result<void> CheckRange(const SceneEdit& edit, const std::string& name) {
  constexpr double kMax_m = 1e7, kMax_deg = 1e7;  // As scenes are read.
  if (!IsWithin(edit.latitude_deg, 90.0) || !IsWithin(edit.longitude_deg, 180.0)) {
    return InputError(name, "cannot hold this location", "latitude -90 to 90, longitude ±180");
  }
  if (edit.heading_deg && !IsWithin(*edit.heading_deg, kMax_deg)) {
    return InputError(name, "cannot hold this heading", "give the marker a heading of 0 to 360");
  }
  for (std::size_t i = 0; i < edit.objects.size(); ++i) {
    const ObjectPlace& place = edit.objects[i];
    if (IsWithin(place.translation_m, kMax_m) && IsWithin(place.rotation_deg, kMax_deg) &&
        IsWithin(place.scale, 1e9) && place.scale >= 1e-9) {
      continue;
    }
    return InputError(name, "cannot hold the place of object " + std::to_string(i + 1),
                      "reset the object (Home)");
  }
  for (const SurfacePlace& place : edit.phantoms) {
    bool is_good = IsWithin(place.translation_m, kMax_m);
    for (const Vec3& corner : place.corners_m) is_good = is_good && IsWithin(corner, kMax_m / 10.0);
    if (is_good) continue;
    return InputError(name, "cannot hold the place of a surface", "reset the surface (Home)");
  }
  return {};
}

/// True if the text has the placements of the edit.
bool HasPlacements(const scene::SceneFacts& facts, const SceneEdit& edit) {
  const double metres = HalfStep(kLengthDecimals) * 1.1, degrees = HalfStep(kAngleDecimals) * 1.1;
  for (std::size_t i = 0; i < edit.objects.size(); ++i) {
    const scene::ModelReference& written = facts.objects[i];
    const ObjectPlace& wanted = edit.objects[i];
    if (!IsWithin(written.translation_m - wanted.translation_m, metres) ||
        !IsWithin(written.rotation_deg - wanted.rotation_deg, degrees) ||
        !IsWithin(written.scale - wanted.scale, 1e-5 * wanted.scale)) {
      return false;
    }
  }
  // Ground is no phantom of the file.
  for (std::size_t i = 0; i < facts.phantoms.size(); ++i) {
    const scene::ModelReference& written = facts.phantoms[i];
    const SurfacePlace& wanted = edit.phantoms[i];
    if (!IsWithin(written.translation_m - wanted.translation_m, metres)) return false;
    for (std::size_t c = 0; c < wanted.corners_m.size(); ++c) {
      if (!IsWithin(written.surface->polygons[0][c] - wanted.corners_m[c], metres)) return false;
    }
  }
  return true;
}

}  // namespace

Result<std::string> WithSavedEdit(std::string_view text, const scene::SceneDescription& scene,
                                  const SceneEdit& from, const SceneEdit& to) {
  const std::string name = scene.file.string();
  PLEINAIR_RETURN_IF_ERROR(CheckRange(to, name));
  PLEINAIR_ASSIGN_OR_RETURN(const scene::SceneFacts read, scene::ParseSceneToml(text, name));
  const std::size_t grounds =
      !scene.phantoms.empty() && scene.phantoms.back().surface &&
              scene.phantoms.back().surface->kind == scene::SurfaceKind::kGround
          ? 1
          : 0;
  if (read.objects.size() != to.objects.size() || from.objects.size() != to.objects.size() ||
      read.phantoms.size() + grounds != to.phantoms.size() ||
      from.phantoms.size() != to.phantoms.size()) {
    return InputError(name, "has other objects than the scene that is shown",
                      "start the session again");
  }
  std::vector<scene::TomlChange> changes;
  AddAir(scene, from, to, &changes);
  AddLocation(from, to, &changes);
  for (std::size_t i = 0; i < to.objects.size(); ++i) {
    AddPlacement(i, from.objects[i], to.objects[i], &changes);
  }
  AddSurfaces(scene, from, to, &changes);
  PLEINAIR_ASSIGN_OR_RETURN(std::string changed, scene::ChangeToml(text, name, changes));
  // Whatever the form of the text, it is only returned if it reads back.
  const auto facts = scene::ParseSceneToml(changed, name);
  if (!facts || facts->objects.size() != read.objects.size() ||
      facts->phantoms.size() != read.phantoms.size() || !HasPlacements(*facts, to)) {
    return InputError(name, "is written in a form that cannot be changed in place",
                      "write its objects as [[object]] with one key a line");
  }
  return changed;
}

bool ChangesScene(const SceneEdit& from, const SceneEdit& to) {
  return to.latitude_deg != from.latitude_deg || to.longitude_deg != from.longitude_deg ||
         (to.heading_deg && to.heading_deg != from.heading_deg) || (to.sky && to.sky != from.sky) ||
         to.objects != from.objects || to.phantoms != from.phantoms;
}

}  // namespace pleinair::session
