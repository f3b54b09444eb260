#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/live/live_recorder.h"
#include "app/output/cloud_layer_toml.h"
#include "app/replay/report/report.h"
#include "base/up_axis.h"
#include "scene/leaf_contents.h"
#include "scene/length_units.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

/// Returns a TOML basic string: quotes, backslashes and control characters escaped (TOML 1.0,
/// "String").
std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

const char* Word(scene::Shading shading) {
  switch (shading) {
    case scene::Shading::kFromFile:
      return "file";
    case scene::Shading::kFlat:
      return "flat";
    case scene::Shading::kSmooth:
      return "smooth";
  }
  return "file";
}

/// Path of a file relative to the scene's folder.
std::string Beside(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path near = fs::proximate(file, folder, error);
  return Quoted((error ? fs::absolute(file, error) : near).string());
}

std::string Vector(Vec3 v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

/// A surface that the scene describes, as walls.
void AddSurface(const scene::ModelReference& model, std::string* text) {
  const scene::DescribedSurface& surface = *model.surface;
  for (const std::vector<Vec3>& polygon : surface.polygons) {
    *text += "\n[[wall]]\ncorners_m = [";
    for (std::size_t i = 0; i < polygon.size(); ++i)
      *text += (i == 0 ? "" : ", ") + Vector(polygon[i]);
    *text += "]\n";
    if (surface.has_color) {
      *text += fmt::format("color = [{}, {}, {}]\n", surface.reflectance.r, surface.reflectance.g,
                           surface.reflectance.b);
    }
    *text += fmt::format("translation_m = {}\nrotation_deg = {}\n", Vector(model.translation_m),
                         Vector(model.rotation_deg));
  }
}

void AddModel(const char* table, const scene::ModelReference& model, const fs::path& folder,
              std::string* text) {
  if (model.surface) return AddSurface(model, text);
  *text += fmt::format("\n[[{}]]\n", table);
  if (!model.name.empty()) *text += fmt::format("name = {}\n", Quoted(model.name));
  *text +=
      fmt::format("file = {}\nshading = \"{}\"\n", Beside(folder, model.file), Word(model.shading));
  if (model.up) *text += fmt::format("up = \"{}\"\n", *model.up == UpAxis::kY ? "y" : "z");
  if (model.unit_m) {
    *text += fmt::format("unit = \"{}\"\n", scene::NameOfUnit(*model.unit_m));
  }
  if (model.origin == scene::ModelOrigin::kBottomCentre) *text += "origin = \"bottom centre\"\n";
  if (!model.animation.empty()) {
    *text += fmt::format("animation = {}\nanimation_start_s = {}\n", Quoted(model.animation),
                         model.animation_start_s);
    if (model.loop) *text += "loop = true\n";
  }
  *text += fmt::format("translation_m = {}\nrotation_deg = {}\nscale = {}\n",
                       Vector(model.translation_m), Vector(model.rotation_deg), model.scale);
}

void AddDrape(const scene::DrapeDescription& drape, const fs::path& folder, std::string* text) {
  const scene::InkDescription& ink = drape.ink;
  *text += fmt::format("\n[[drape]]\nfile = {}\n", Beside(folder, drape.source.file));
  for (const auto& [key, value] : {std::pair("layer", &drape.source.layer),
                                   {"where", &drape.source.where},
                                   {"crs", &drape.source.crs},
                                   {"color_field", &ink.color_field},
                                   {"height_field", &drape.height_field}}) {
    if (!value->empty()) *text += fmt::format("{} = {}\n", key, Quoted(*value));
  }
  *text +=
      fmt::format("{} = {}\n", ink.width_in_px ? "line_width_px" : "line_width_m", ink.line_width);
  if (ink.color_field.empty()) {
    *text += fmt::format("color = \"{}\"\n", scene::HexColor(ink.color));
  }
  if (ink.fill) *text += fmt::format("fill = \"{}\"\n", scene::HexColor(*ink.fill));
  if (ink.dash_m) *text += fmt::format("dash_m = [{}, {}]\n", (*ink.dash_m)[0], (*ink.dash_m)[1]);
  if (drape.height_field != scene::kOwnHeights) *text += fmt::format("on = {}\n", Quoted(drape.on));
  *text += fmt::format(
      "opacity = {}\nblend = \"{}\"\noffset_m = {}\nhidden = \"{}\"\nlive = \"{}\"\n", ink.opacity,
      NameOf(ink.blend), drape.offset_m, NameOf(ink.hidden), NameOf(drape.search));
}

std::string ContentsText(const scene::LeafContents& contents) {
  std::string text;
  for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
    text += fmt::format("{} = {}\n", quantity.key, contents.*quantity.value);
  }
  return text;
}

void AddLeaf(const scene::LeafDescription& leaf, const fs::path& folder, std::string* text) {
  *text += "\n[[leaf]]\nmaterials = [";
  for (std::size_t i = 0; i < leaf.materials.size(); ++i) {
    *text += (i == 0 ? "" : ", ") + Quoted(leaf.materials[i]);
  }
  *text += fmt::format("]\nmodel = \"{}\"\nroughness = {}\ngloss = {}\n",
                       scene::NameOf(leaf.leaf.model), leaf.roughness, leaf.gloss) +
           ContentsText(leaf.leaf.contents);
  for (const auto& [key, file] : {std::pair("structure_map", &leaf.maps.structure),
                                  {"pigment_map", &leaf.maps.pigment},
                                  {"gloss_map", &leaf.maps.gloss},
                                  {"thickness_map", &leaf.maps.thickness}}) {
    if (!file->empty()) *text += fmt::format("{} = {}\n", key, Beside(folder, *file));
  }
  for (const scene::LeafStage& stage : leaf.stages) {
    *text += "[[leaf.stage]]\ndate = " + stage.date.ToString().substr(0, 10) + "\n" +
             ContentsText(stage.contents);
  }
}

}  // namespace

std::string SceneToml(const scene::SceneDescription& scene, UtcTime start, const fs::path& folder) {
  const scene::MarkerDescription& marker = scene.marker;
  std::string text = fmt::format("time = {}\ncloudiness = \"{}\"\n", start.ToString(),
                                 CloudinessName(scene.cloudiness));
  if (scene.turbidity) text += fmt::format("turbidity = {}\n", *scene.turbidity);
  if (scene.camera.exposure_scale) {
    text += fmt::format("exposure_gain = [{}, {}, {}]\n", scene.camera.exposure_scale->r,
                        scene.camera.exposure_scale->g, scene.camera.exposure_scale->b);
  }
  if (!scene.camera.response.empty()) {
    text += fmt::format("camera_response = {}\n", Beside(folder, scene.camera.response));
  }
  if (scene.phantoms.empty()) text += "ground = false\n";
  text += fmt::format("\n[place]\nlatitude_deg = {}\nlongitude_deg = {}\nheight_m = {}\n",
                      scene.place_time.latitude_deg, scene.place_time.longitude_deg,
                      scene.place_time.height_m);
  if (scene.place_time.above_ellipsoid) text += "height_reference = \"ellipsoid\"\n";
  text += "\n[marker]\n";
  if (marker.family) text += fmt::format("family = {}\n", Quoted(*marker.family));
  if (marker.id) text += fmt::format("id = {}\n", *marker.id);
  if (marker.version) text += fmt::format("version = {}\n", *marker.version);
  if (marker.target) {
    text += fmt::format("target = {}\n", Beside(folder, *marker.target));
  } else {
    text += fmt::format("size_m = {}\n", marker.size_m);
  }
  if (marker.board_size_m > 0.0) text += fmt::format("board_size_m = {}\n", marker.board_size_m);
  text += fmt::format("heading_deg = {}\nupright = {}\nalbedo_black = {}\nalbedo_white = {}\n",
                      marker.heading.value() / kRadiansPerDegree, marker.upright,
                      marker.albedo_black, marker.albedo_white);
  if (marker.offset_m != Vec3{}) text += fmt::format("offset_m = {}\n", Vector(marker.offset_m));
  if (marker.position_sd_m > 0.0) {
    text += fmt::format("position_sd_m = {}\n", marker.position_sd_m);
  }
  for (const auto& phantom : scene.phantoms) AddModel("phantom", phantom, folder, &text);
  for (const auto& object : scene.objects) AddModel("object", object, folder, &text);
  for (const auto& leaf : scene.leaves) AddLeaf(leaf, folder, &text);
  for (const auto& drape : scene.drapes) AddDrape(drape, folder, &text);
  for (const auto& layer : scene.clouds.layers) text += "\n" + CloudLayerToml(layer);
  return text;
}

}  // namespace pleinair::app
