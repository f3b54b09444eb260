#include "scene/toml_surfaces.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "scene/described_surface.h"
#include "scene/length_units.h"

namespace pleinair::scene {
namespace {

Result<void> ReadPlacement(const TomlTable& table, ModelReference* model) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> translation, table.Triple("translation_m"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> rotation, table.Triple("rotation_deg"));
  model->translation_m = translation.value_or(Vec3{});
  model->rotation_deg = rotation.value_or(Vec3{});
  return {};
}

/// Axes, unit and origin of a model's file.
Result<void> ReadFrame(const TomlTable& table, ModelReference* model) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> up, table.Text("up"));
  if (up && *up != "y" && *up != "z") return table.Fail("up", "is not known", "known are y and z");
  if (up) model->up = *up == "y" ? UpAxis::kY : UpAxis::kZ;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> unit, table.Text("unit"));
  if (unit) {
    const std::optional<double> metres = MetresOfUnit(*unit);
    if (!metres) return table.Fail("unit", "is not known", "known are mm, cm, m, in and ft");
    model->unit_m = metres;
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> origin, table.Text("origin"));
  if (origin && *origin != "file" && *origin != "bottom centre") {
    return table.Fail("origin", "is not known", "known are file and bottom centre");
  }
  if (origin == "bottom centre") model->origin = ModelOrigin::kBottomCentre;
  return {};
}

Result<void> ReadAnimation(const TomlTable& table, ModelReference* model) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> animation, table.Text("animation"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> start_s, table.Number("animation_start_s"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<bool> loop, table.Flag("loop"));
  if (animation && animation->empty()) return table.Fail("animation", "names none");
  for (const auto& [key, is_given] :
       {std::pair{"animation_start_s", start_s.has_value()}, std::pair{"loop", loop.has_value()}}) {
    if (is_given && !animation) {
      return table.Fail(key, "needs an animation", "add animation = \"NAME\"");
    }
  }
  if (start_s && *start_s < 0.0) {
    return table.Fail("animation_start_s", "is before the animation's beginning",
                      "give 0 or more seconds");
  }
  model->animation = animation.value_or("");
  model->animation_start_s = start_s.value_or(0.0);
  model->loop = loop.value_or(false);
  return {};
}

Result<ModelReference> ReadModel(const TomlTable& table, const TomlTable& scene, const char* key) {
  PLEINAIR_RETURN_IF_ERROR(
      table.AllowOnly({"file", "shading", "up", "unit", "origin", "animation", "animation_start_s",
                       "loop", "translation_m", "rotation_deg", "scale", "name"}));
  if (key == std::string_view("phantom") && table.Find("loop") != nullptr) {
    return table.Fail("loop", "is for objects", "a phantom stands still: leave loop out");
  }
  if (key == std::string_view("object") && table.Find("name") != nullptr) {
    return table.Fail("name", "is for phantoms", "leave name out: nothing is draped on objects");
  }
  ModelReference model;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> name, table.Text("name"));
  model.name = name.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> file, table.Text("file"));
  if (!file || file->empty()) return scene.Fail(key, "has no file", "add file = \"name.obj\"");
  model.file = *file;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> shading, table.Text("shading"));
  if (shading) {
    if (*shading == "flat") {
      model.shading = Shading::kFlat;
    } else if (*shading == "smooth") {
      model.shading = Shading::kSmooth;
    } else if (*shading != "file") {
      return table.Fail("shading", "is not known", "known are file, flat and smooth");
    }
  }
  PLEINAIR_RETURN_IF_ERROR(ReadFrame(table, &model));
  PLEINAIR_RETURN_IF_ERROR(ReadAnimation(table, &model));
  PLEINAIR_RETURN_IF_ERROR(ReadPlacement(table, &model));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> scale, table.Number("scale"));
  model.scale = scale.value_or(1.0);
  return model;
}

/// The color of a described surface; nothing if it is to be measured.
Result<std::optional<LinearRgb>> ReadColor(const TomlTable& table) {
  const toml::node* node = table.Find("color");
  if (node == nullptr) return std::nullopt;
  if (node->is_string()) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> word, table.Text("color"));
    if (word == "measured") return std::nullopt;
    return table.Fail("color", "is not known",
                      "write \"measured\", or [red, green, blue]: linear reflectance, 0 to 1");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> color, table.Triple("color"));
  return LinearRgb{color->x, color->y, color->z};
}

/// The boxes or the walls of a scene, as phantoms.
template <typename ReadShape>
Result<void> ReadSurfaces(const TomlTable& scene, const char* key, const ReadShape& read_shape,
                          std::vector<ModelReference>* phantoms) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables(key));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string name = std::string(key) + " " + std::to_string(i + 1);
    Result<DescribedSurface> surface = read_shape(tables[i]);
    if (!surface && !surface.error().where.empty()) return tl::make_unexpected(surface.error());
    if (!surface) {
      return InputError(scene.file(), name + " " + surface.error().what, surface.error().remedy);
    }
    ModelReference& model = phantoms->emplace_back();
    model.surface = *std::move(surface);
    model.surface->name = name;
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<LinearRgb> color, ReadColor(tables[i]));
    model.surface->has_color = color.has_value();
    model.surface->reflectance = color.value_or(kUsualReflectance);
    PLEINAIR_RETURN_IF_ERROR(ReadPlacement(tables[i], &model));
  }
  return {};
}

Result<DescribedSurface> ReadBox(const TomlTable& table) {
  PLEINAIR_RETURN_IF_ERROR(
      table.AllowOnly({"from_m", "to_m", "color", "translation_m", "rotation_deg"}));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> from, table.Triple("from_m"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> to, table.Triple("to_m"));
  if (!from || !to) {
    return InputError("", "lacks a corner", "add from_m and to_m: two opposite corners, metres");
  }
  return BoxSurface(*from, *to);
}

Result<DescribedSurface> ReadWall(const TomlTable& table) {
  PLEINAIR_RETURN_IF_ERROR(
      table.AllowOnly({"corners_m", "color", "translation_m", "rotation_deg"}));
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<Vec3> corners, table.Triples("corners_m"));
  return WallSurface(std::move(corners));
}

}  // namespace

Result<std::vector<ModelReference>> ReadModels(const TomlTable& scene, const char* key) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables(key));
  std::vector<ModelReference> models;
  for (const TomlTable& table : tables) {
    PLEINAIR_ASSIGN_OR_RETURN(ModelReference model, ReadModel(table, scene, key));
    models.push_back(std::move(model));
  }
  return models;
}

Result<void> ReadDescribedSurfaces(const TomlTable& scene, std::vector<ModelReference>* phantoms) {
  PLEINAIR_RETURN_IF_ERROR(ReadSurfaces(scene, "box", ReadBox, phantoms));
  return ReadSurfaces(scene, "wall", ReadWall, phantoms);
}

Result<void> ReadGround(const TomlTable& scene, GroundFacts* facts) {
  facts->may_be_assumed = true;
  const toml::node* node = scene.Find("ground");
  if (node == nullptr) return {};
  if (node->is_boolean()) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<bool> wanted, scene.Flag("ground"));
    facts->is_given = wanted.value_or(false);
    facts->may_be_assumed = facts->is_given;
    return {};
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables("ground"));
  if (tables.size() != 1) return scene.Fail("ground", "is given more than once", "keep one ground");
  const TomlTable& ground = tables[0];
  PLEINAIR_RETURN_IF_ERROR(ground.AllowOnly({"size_m", "height_m", "color"}));
  facts->is_given = true;
  PLEINAIR_ASSIGN_OR_RETURN(facts->size_m, ground.Number("size_m"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->height_m, ground.Number("height_m"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->color, ReadColor(ground));
  return {};
}

}  // namespace pleinair::scene
