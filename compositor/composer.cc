#include "compositor/composer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "compositor/aerial_fog.h"
#include "compositor/camera_picture.h"
#include "compositor/changing_triangles.h"
#include "compositor/embedded_shaders.h"
#include "compositor/environment_map.h"
#include "compositor/render_camera.h"
#include "compositor/render_targets.h"
#include "compositor/shadow_debug_view.h"
#include "compositor/surface_buffers.h"
#include "gl/egl_context.h"
#include "gl/program.h"
#include "shadows/fading_shadow_maps.h"
#include "shadows/splits.h"

namespace pleinair::compositor {
namespace {

constexpr double kNearM = 0.02;
constexpr double kWarpedSupersampling = 1.5;
// Sets of shadow maps, as the shaders number them.
constexpr int kPhantomsAlone = 0, kWithObjects = 1, kShadowSets = 2;

glm::vec3 ToGlm(Vec3 v) { return {v.x, v.y, v.z}; }
glm::vec3 ToGlm(LinearRgb c) { return {c.r, c.g, c.b}; }

glm::dmat4 CameraFromMarkerMatrix(const Transform<Camera, Marker>& camera_from_marker) {
  glm::dmat4 matrix(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix[column][row] = camera_from_marker.rotation(row, column);
    }
  }
  const Vec3 t = camera_from_marker.translation_m;
  matrix[3] = glm::dvec4(t.x, t.y, t.z, 1.0);
  return matrix;
}

/// OpenGL clip coordinates from camera coordinates (x right, y down, z forward). Row 0 of the
/// render picture is its top, so that y is not turned over.
glm::dmat4 ClipFromCamera(const RenderCamera& camera, double near_m, double far_m) {
  glm::dmat4 matrix(0.0);
  matrix[0][0] = 2.0 * camera.fx / camera.width;
  matrix[1][1] = 2.0 * camera.fy / camera.height;
  matrix[2][0] = 2.0 * (camera.cx + 0.5) / camera.width - 1.0;
  matrix[2][1] = 2.0 * (camera.cy + 0.5) / camera.height - 1.0;
  matrix[2][2] = (far_m + near_m) / (far_m - near_m);
  matrix[2][3] = 1.0;
  matrix[3][2] = -2.0 * far_m * near_m / (far_m - near_m);
  return matrix;
}

/// Nearest and farthest depth at which something of the scene can lie.
std::pair<double, double> DepthRange(const Transform<Camera, Marker>& camera_from_marker,
                                     const shadows::Box& bounds) {
  double nearest = 1e30, farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Point<Marker> point{{(corner & 1) ? bounds.max.x : bounds.min.x,
                               (corner & 2) ? bounds.max.y : bounds.min.y,
                               (corner & 4) ? bounds.max.z : bounds.min.z}};
    const double depth = (camera_from_marker * point).xyz.z;
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const double near_m = std::max(nearest * 0.99, kNearM);
  return {near_m, std::max(farthest * 1.01, 2 * near_m)};
}

shadows::View ViewOf(const RenderCamera& camera,
                     const Transform<Camera, Marker>& camera_from_marker,
                     const shadows::Box& bounds) {
  const auto [near_m, far_m] = DepthRange(camera_from_marker, bounds);
  shadows::View view;
  view.camera_from_marker = CameraFromMarkerMatrix(camera_from_marker);
  view.tan_left = (camera.cx + 0.5) / camera.fx;
  view.tan_right = (camera.width - 0.5 - camera.cx) / camera.fx;
  view.tan_up = (camera.cy + 0.5) / camera.fy;
  view.tan_down = (camera.height - 0.5 - camera.cy) / camera.fy;
  view.near_m = near_m;
  view.far_m = far_m;
  return view;
}

static_assert(std::tuple_size_v<decltype(ComposerOptions::fog)> == shadows::kMaxPartitions);

bool UsesMoments(ShadowMethod method) {
  const shadows::MapContent content = shadows::TraitsOf(method).content;
  return content == shadows::MapContent::kMoments || content == shadows::MapContent::kWarpedMoments;
}

shadows::ShadowMapOptions MapOptions(const ComposerOptions& options) {
  shadows::ShadowMapOptions map_options;
  map_options.method = options.shadow_method;
  map_options.partitions = options.shadow_partitions;
  map_options.split_weight = options.shadow_split_weight;
  map_options.blur_blocker_distance = Metres(options.shadow_blur_distance_m);
  return map_options;
}

/// Mean radiance that the phantoms send upwards, for reflections below the horizon.
LinearRgb MeanGroundRadiance(const std::vector<LitMesh>& lit, const std::vector<PlacedModel>& scene,
                             LinearRgb sun_normal, Vec3 to_sun) {
  LinearRgb sum;
  std::size_t count = 0;
  for (const LitMesh& mesh : lit) {
    if (!mesh.is_phantom) continue;
    const auto& color = scene[mesh.placed_model].model->materials[mesh.material].base_color;
    const LinearRgb albedo{color[0], color[1], color[2]};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& n = mesh.normals[i];
      if (n[2] < 0.5F) continue;
      const auto& ambient = mesh.ambient_without[i];
      const double cosine = std::max(0.0, n[0] * to_sun.x + n[1] * to_sun.y + n[2] * to_sun.z);
      const LinearRgb light = LinearRgb{ambient[0], ambient[1], ambient[2]} + sun_normal * cosine;
      sum = sum + albedo * light * std::numbers::inv_pi;
      ++count;
    }
  }
  return count > 0 ? sum * (1.0 / static_cast<double>(count)) : sum;
}

/// The scene's programs of one permutation.
struct SurfacePrograms {
  // By what may change of the light: ChangingTriangles::Change but for kNothing.
  std::array<gl::GlProgram, ChangingTriangles::kNothing> phantoms;
  gl::GlProgram objects;
};

class GlComposer : public Composer {
 public:
  static Result<std::unique_ptr<Composer>> Make(const CameraModel& camera,
                                                const std::vector<PlacedModel>& scene,
                                                const ComposerOptions& options);

  // What was made with the context goes with it.
  ~GlComposer() override { static_cast<void>(context_.MakeCurrent()); }

  Result<void> SetOptions(const ComposerOptions& options) override;
  void LetGo() override { context_.ReleaseCurrent(); }
  void MoveModel(int placed_model, const Mat3& linear, Vec3 translation_m) override;
  Result<void> SetLight(const std::vector<LitMesh>& lit, const sky::SkyModel& day,
                        const Mat3& marker_from_world) override;
  void SetSun(const sky::SkyModel& day, const Mat3& marker_from_world) override;
  Result<RgbImage> Compose(ImageView<const std::uint8_t> rgb,
                           const Transform<Camera, Marker>& camera_from_marker,
                           LinearRgb gain) override;
  void SetMarkerBoard(double board_size_m) override { board_size_m_ = board_size_m; }
  Result<void> SetLook(const std::optional<PictureLook>& look) override {
    PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
    look_ = look;
    return picture_.SetLook(look);
  }

 private:
  GlComposer(const CameraModel& camera, const std::vector<PlacedModel>& scene,
             gl::EglContext context)
      : context_(std::move(context)), camera_(camera), scene_(scene) {}

  bool HasSun() const { return Luminance(sun_normal_) > 0.0; }
  Result<void> SetRenderSize(const ComposerOptions& options);
  Result<void> MakeShadows(const ComposerOptions& options);
  void PlaceCasters();
  Result<void> DrawShadowMaps(const Transform<Camera, Marker>& camera_from_marker);
  bool Fades() const { return shadow_maps_.front().Fades(); }
  Result<void> MakeSurfacePrograms();
  void DrawScene(const Transform<Camera, Marker>& camera_from_marker, LinearRgb gain);
  void SetMaterial(const gl::GlProgram& program, const SurfaceBuffers& surface) const;
  void SortPhantoms();
  void DrawPhantoms(int change, const gl::GlProgram* shaded) const;
  void SetFog(const Transform<Camera, Marker>& camera_from_marker, double near_m,
              double far_m) const;
  Result<void> DrawDebugView(const Transform<Camera, Marker>& camera_from_marker);

  gl::EglContext context_;  // First: GL objects go before it.
  CameraModel camera_;
  std::vector<PlacedModel> scene_;
  ComposerOptions options_;
  RenderCamera render_camera_;
  RenderTargets targets_;
  CameraPicture picture_;
  std::optional<PictureLook> look_;
  double board_size_m_ = 0.0;
  gl::GlTexture white_, environment_;
  gl::GlProgram depth_program_;
  // With shadows of one step of the sun, and of two that fade into one another; made when needed.
  std::array<std::optional<SurfacePrograms>, 2> surface_programs_;
  std::vector<std::vector<gl::GlTexture>> model_textures_;  // A list a placed model.
  std::vector<SurfaceBuffers> surfaces_;
  std::vector<shadows::Box> lit_bounds_;  // Of the surfaces, where they were lit.
  std::vector<glm::dmat4> moved_;         // By placed model: marker from where it was lit.
  std::vector<ChangingTriangles> phantom_triangles_;  // Of the phantoms among them, in order.
  std::optional<SunWindow> sorted_for_;
  std::vector<shadows::FadingShadowMaps> shadow_maps_;  // kShadowSets of them.
  std::array<std::vector<shadows::ShadowCaster>, kShadowSets> casters_;
  shadows::Box object_bounds_, scene_bounds_;
  std::uint64_t revision_ = 0;                 // Of the surfaces; the shadow maps follow it.
  std::optional<ShadowDebugView> debug_view_;  // Made when needed.
  AerialFog air_;
  Vec3 to_sun_;
  LinearRgb sun_normal_;
};

Result<std::unique_ptr<Composer>> GlComposer::Make(const CameraModel& camera,
                                                   const std::vector<PlacedModel>& scene,
                                                   const ComposerOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(gl::EglContext context, gl::EglContext::Create());
  RegisterShaders();
  std::unique_ptr<GlComposer> composer(new GlComposer(camera, scene, std::move(context)));
  GlComposer& c = *composer;
  PLEINAIR_ASSIGN_OR_RETURN(c.white_, gl::GlTexture::Create2D(GL_RGBA8, 1, 1));
  constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};
  c.white_.Upload(GL_RGBA, GL_UNSIGNED_BYTE, kWhite.data());
  PLEINAIR_ASSIGN_OR_RETURN(c.environment_, gl::GlTexture::Create2DArray(
                                                GL_RGB32F, EnvironmentMap::kWidth,
                                                EnvironmentMap::kHeight, EnvironmentMap::kLevels));
  c.environment_.SetWrap(GL_REPEAT);
  PLEINAIR_ASSIGN_OR_RETURN(
      c.depth_program_, gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                                               .fragment = "compositor/shaders/depth_only.frag"}));
  for (const PlacedModel& placed : scene) {
    PLEINAIR_ASSIGN_OR_RETURN(auto textures, UploadTextures(*placed.model));
    c.model_textures_.push_back(std::move(textures));
  }
  PLEINAIR_RETURN_IF_ERROR(c.SetRenderSize(options));
  PLEINAIR_RETURN_IF_ERROR(c.MakeShadows(options));
  PLEINAIR_RETURN_IF_ERROR(c.MakeSurfacePrograms());
  c.options_ = options;
  return composer;
}

/// How many pixels are drawn, and what they are drawn into.
Result<void> GlComposer::SetRenderSize(const ComposerOptions& options) {
  const double supersampling = options.supersampling > 0.0 ? options.supersampling
                               : camera_.HasDistortion()   ? kWarpedSupersampling
                                                           : 1.0;
  const RenderCamera render_camera = FitRenderCamera(camera_, supersampling);
  PLEINAIR_ASSIGN_OR_RETURN(targets_,
                            RenderTargets::Create(render_camera.width, render_camera.height));
  PLEINAIR_ASSIGN_OR_RETURN(
      picture_, CameraPicture::Create(camera_, render_camera, supersampling, options.response));
  render_camera_ = render_camera;
  debug_view_.reset();
  return picture_.SetLook(look_);
}

Result<void> GlComposer::MakeShadows(const ComposerOptions& options) {
  std::vector<shadows::FadingShadowMaps> made;
  for (int set = 0; set < kShadowSets; ++set) {
    PLEINAIR_ASSIGN_OR_RETURN(auto maps, shadows::FadingShadowMaps::Create(MapOptions(options)));
    made.push_back(std::move(maps));
  }
  shadow_maps_ = std::move(made);
  debug_view_.reset();
  sorted_for_.reset();
  return {};
}

Result<void> GlComposer::SetOptions(const ComposerOptions& options) {
  if (options == options_) return {};
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  if (options.supersampling != options_.supersampling || options.response != options_.response) {
    PLEINAIR_RETURN_IF_ERROR(SetRenderSize(options));
  }
  const bool other_shaders = options.shadow_method != options_.shadow_method ||
                             options.shadow_partitions != options_.shadow_partitions;
  if (other_shaders || options.shadow_split_weight != options_.shadow_split_weight ||
      options.shadow_blur_distance_m != options_.shadow_blur_distance_m) {
    PLEINAIR_RETURN_IF_ERROR(MakeShadows(options));
  }
  if (other_shaders) {
    for (auto& programs : surface_programs_) programs.reset();
    PLEINAIR_RETURN_IF_ERROR(MakeSurfacePrograms());
  }
  options_ = options;
  return {};
}

void GlComposer::MoveModel(int placed_model, const Mat3& linear, Vec3 translation_m) {
  glm::dmat4 moved(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) moved[column][row] = linear(row, column);
  }
  moved[3] = glm::dvec4(translation_m.x, translation_m.y, translation_m.z, 1.0);
  moved_[placed_model] = moved;
  PlaceCasters();
}

/// Casters and bounds with the models where they were moved to.
void GlComposer::PlaceCasters() {
  for (auto& casters : casters_) casters.clear();
  object_bounds_ = scene_bounds_ = {};
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const SurfaceBuffers& surface = surfaces_[i];
    shadows::ShadowCaster caster;
    caster.vertices = &surface.vertex_array();
    caster.index_count = surface.index_count();
    caster.revision = revision_;
    caster.marker_from_model = moved_[surface.placed_model()];
    const shadows::Box& lit = lit_bounds_[i];
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 point((corner & 1) != 0 ? lit.max.x : lit.min.x,
                             (corner & 2) != 0 ? lit.max.y : lit.min.y,
                             (corner & 4) != 0 ? lit.max.z : lit.min.z, 1.0);
      caster.bounds.Include(glm::dvec3(caster.marker_from_model * point));
    }
    scene_bounds_.Include(caster.bounds);
    if (surface.is_phantom()) {
      casters_[kPhantomsAlone].push_back(caster);
    } else {
      object_bounds_.Include(caster.bounds);
    }
    casters_[kWithObjects].push_back(caster);
  }
}

Result<void> GlComposer::MakeSurfacePrograms() {
  std::optional<SurfacePrograms>& made = surface_programs_[Fades() ? 1 : 0];
  if (made) return {};
  const auto make = [&](const std::string& fragment, const char* change) {
    std::vector<std::string> defines = shadows::FadingShadowMaps::ShaderDefines(
        shadow_maps_.front().options(), kShadowSets, Fades());
    if (change != nullptr) defines.emplace_back(change);
    return gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                                  .fragment = fragment,
                                  .defines = std::move(defines)});
  };
  SurfacePrograms programs;
  constexpr std::array<const char*, ChangingTriangles::kNothing> kChangeDefines{
      "SUN_MAY_CHANGE", "SKY_CHANGES", "NO_SUN"};
  for (std::size_t change = 0; change < kChangeDefines.size(); ++change) {
    PLEINAIR_ASSIGN_OR_RETURN(
        programs.phantoms[change],
        make("compositor/shaders/phantom_ratio.frag", kChangeDefines[change]));
  }
  PLEINAIR_ASSIGN_OR_RETURN(programs.objects,
                            make("compositor/shaders/virtual_object.frag", nullptr));
  made.emplace(std::move(programs));
  return {};
}

Result<void> GlComposer::SetLight(const std::vector<LitMesh>& lit, const sky::SkyModel& day,
                                  const Mat3& marker_from_world) {
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  SetSun(day, marker_from_world);
  air_ = AerialFog(day, marker_from_world);
  surfaces_.clear();
  surfaces_.reserve(lit.size());  // The casters point into it.
  lit_bounds_.clear();
  moved_.assign(scene_.size(), glm::dmat4(1.0));
  phantom_triangles_.clear();
  sorted_for_.reset();
  ++revision_;
  for (const LitMesh& mesh : lit) {
    PLEINAIR_ASSIGN_OR_RETURN(SurfaceBuffers surface, SurfaceBuffers::Create(mesh));
    surfaces_.push_back(std::move(surface));
    lit_bounds_.emplace_back();
    for (const auto& p : mesh.positions) lit_bounds_.back().Include({p[0], p[1], p[2]});
    if (mesh.is_phantom) phantom_triangles_.emplace_back(mesh);
  }
  PlaceCasters();
  const EnvironmentMap map = BuildEnvironmentMap(
      day, marker_from_world, MeanGroundRadiance(lit, scene_, sun_normal_, to_sun_));
  for (int level = 0; level < EnvironmentMap::kLevels; ++level) {
    environment_.UploadLayer(level, GL_RGB, GL_FLOAT, map.levels[level].data());
  }
  return {};
}

Result<void> GlComposer::DrawShadowMaps(const Transform<Camera, Marker>& camera_from_marker) {
  for (int set = 0; set < kShadowSets; ++set) {
    shadows::FadingShadowMaps& maps = shadow_maps_[set];
    if (!UsesMoments(maps.options().method)) {
      // Around the objects, whatever the camera does: drawn once a light.
      PLEINAIR_RETURN_IF_ERROR(maps.UpdateForRegion(casters_[set], {to_sun_}, object_bounds_));
    } else {
      PLEINAIR_RETURN_IF_ERROR(maps.UpdateForView(
          casters_[set], {to_sun_}, ViewOf(render_camera_, camera_from_marker, scene_bounds_)));
    }
    maps.Bind(set);
  }
  return MakeSurfacePrograms();
}

void GlComposer::SetSun(const sky::SkyModel& day, const Mat3& marker_from_world) {
  to_sun_ = marker_from_world * day.ToSun().xyz;
  sun_normal_ = day.SunNormalIrradiance();
}

void GlComposer::SetMaterial(const gl::GlProgram& program, const SurfaceBuffers& surface) const {
  const Model& model = *scene_[surface.placed_model()].model;
  const Material& material = model.materials[surface.material()];
  const gl::GlTexture& texture =
      material.base_color_texture >= 0
          ? model_textures_[surface.placed_model()][material.base_color_texture]
          : white_;
  texture.Bind(0);
  program.Set("u_base_color",
              glm::vec3(material.base_color[0], material.base_color[1], material.base_color[2]));
  program.Set("u_metallic", material.metallic);
  program.Set("u_roughness", material.roughness);
  program.Set("u_dielectric_f0", material.specular_f0);
}

/// Tells what of the phantoms the objects may change, after the shadow maps were updated.
void GlComposer::SortPhantoms() {
  SunWindow window;
  if (HasSun()) {
    // Of two steps of the sun one will do: a window's margin is wider than a step moves it.
    const shadows::ShadowMaps& maps = shadow_maps_[kWithObjects].maps();
    const shadows::ShadowSliceUniforms& finest = maps.uniforms().slices[0];
    const glm::vec3 to_sun(maps.uniforms().to_sun);
    window = UsesMoments(maps.options().method)
                 ? SunWindow::Everywhere(to_sun)
                 : SunWindow{finest.u_from_marker, finest.v_from_marker, finest.size.z, to_sun};
  }
  if (window == sorted_for_) return;
  sorted_for_ = window;
  auto triangles = phantom_triangles_.begin();
  for (SurfaceBuffers& surface : surfaces_) {
    if (!surface.is_phantom()) continue;
    triangles->Sort(window);
    surface.SetIndices(triangles->indices());
    ++triangles;
  }
}

/// `shaded`: the program that looks for real shade, to be told each surface's reflectance.
void GlComposer::DrawPhantoms(int change, const gl::GlProgram* shaded) const {
  auto triangles = phantom_triangles_.begin();
  for (const SurfaceBuffers& surface : surfaces_) {
    if (!surface.is_phantom()) continue;
    if (shaded != nullptr) {
      const Material& material =
          scene_[surface.placed_model()].model->materials[surface.material()];
      const bool even = material.base_color_texture < 0 && material.metallic == 0.0F;
      shaded->Set("u_green_albedo", even ? material.base_color[1] : 0.0F);
    }
    surface.Draw(change == 0 ? 0 : triangles->ends()[change - 1], triangles->ends()[change]);
    ++triangles;
  }
}

void GlComposer::SetFog(const Transform<Camera, Marker>& camera_from_marker, double near_m,
                        double far_m) const {
  const Vec3 eye = camera_from_marker.Inverse().translation_m;
  const glm::dvec3 to_objects =
      0.5 * (object_bounds_.min + object_bounds_.max) - glm::dvec3(eye.x, eye.y, eye.z);
  const double far_off = glm::length(to_objects);
  const FogSplits fog =
      air_.Along(far_off > 0.0 ? to_objects / far_off : glm::dvec3(0.0, 1.0, 0.0),
                 shadows::PracticalSplits(near_m, far_m, options_.shadow_partitions,
                                          options_.shadow_split_weight),
                 options_.fog);
  const gl::GlProgram& program = surface_programs_[Fades() ? 1 : 0]->objects;
  program.SetArray("u_fog_split_m",
                   std::vector<float>(fog.distance_m.begin(), fog.distance_m.end()));
  program.SetArray("u_fog_optical_depth",
                   std::vector<glm::vec3>(fog.optical_depth.begin(), fog.optical_depth.end()));
  program.SetArray("u_fog_inscattered",
                   std::vector<glm::vec3>(fog.inscattered.begin(), fog.inscattered.end()));
}

/// Over the picture just composed.
Result<void> GlComposer::DrawDebugView(const Transform<Camera, Marker>& camera_from_marker) {
  const shadows::ShadowMaps& maps = shadow_maps_[kWithObjects].maps();
  if (!debug_view_) {
    PLEINAIR_ASSIGN_OR_RETURN(
        debug_view_,
        ShadowDebugView::Create(maps.options(), render_camera_.width, render_camera_.height));
  }
  const shadows::View view = ViewOf(render_camera_, camera_from_marker, scene_bounds_);
  debug_view_->Draw(
      maps, glm::mat4(view.ClipFromMarker()),
      [&](const gl::GlProgram& program) {
        for (const SurfaceBuffers& surface : surfaces_) {
          program.Set("u_marker_from_lit", glm::mat4(moved_[surface.placed_model()]));
          surface.Draw();
        }
      },
      picture_.positions(), picture_.framebuffer());
  return {};
}

void GlComposer::DrawScene(const Transform<Camera, Marker>& camera_from_marker, LinearRgb gain) {
  const auto [near_m, far_m] = DepthRange(camera_from_marker, scene_bounds_);
  const auto clip_from_marker = glm::mat4(ClipFromCamera(render_camera_, near_m, far_m) *
                                          CameraFromMarkerMatrix(camera_from_marker));
  SortPhantoms();
  const SurfacePrograms& programs = *surface_programs_[Fades() ? 1 : 0];
  targets_.BeginDrawing();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  // Open surfaces come as two, one a side. Clockwise, because the picture's rows go down.
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CW);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  depth_program_.Use();
  depth_program_.Set("u_clip_from_marker", clip_from_marker);
  DrawPhantoms(ChangingTriangles::kNothing, nullptr);
  glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  for (int change = 0; change < ChangingTriangles::kNothing; ++change) {
    const gl::GlProgram& program = programs.phantoms[change];
    program.Use();
    program.Set("u_clip_from_marker", clip_from_marker);
    program.Set("u_to_sun", ToGlm(to_sun_));
    program.Set("u_sun_normal_lux", ToGlm(sun_normal_));
    if (change == ChangingTriangles::kSun) {
      program.Set("u_green_gain", static_cast<float>(gain.g));
      program.Set("u_board_half_m", static_cast<float>(board_size_m_ / 2));
      picture_.BindForShading(2, 3, 4);
    }
    DrawPhantoms(change, change == ChangingTriangles::kSun ? &program : nullptr);
  }
  glColorMaski(0, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  programs.objects.Use();
  programs.objects.Set("u_clip_from_marker", clip_from_marker);
  // Without a sun no surface faces it, and the shader leaves the shadow maps alone.
  programs.objects.Set("u_to_sun", HasSun() ? ToGlm(to_sun_) : glm::vec3(0.0F));
  programs.objects.Set("u_sun_normal_lux", ToGlm(sun_normal_));
  programs.objects.Set("u_eye_m", ToGlm(camera_from_marker.Inverse().translation_m));
  programs.objects.Set("u_gain", ToGlm(gain));
  SetFog(camera_from_marker, near_m, far_m);
  environment_.Bind(1);
  for (const SurfaceBuffers& surface : surfaces_) {
    if (surface.is_phantom()) continue;
    SetMaterial(programs.objects, surface);
    programs.objects.Set("u_marker_from_lit", glm::mat4(moved_[surface.placed_model()]));
    surface.Draw();
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  targets_.Resolve();
}

Result<RgbImage> GlComposer::Compose(ImageView<const std::uint8_t> rgb,
                                     const Transform<Camera, Marker>& camera_from_marker,
                                     LinearRgb gain) {
  CHECK_EQ(rgb.width(), camera_.width);
  CHECK_EQ(rgb.height(), camera_.height);
  CHECK_EQ(rgb.channels(), 3);
  CHECK_EQ(rgb.stride(), static_cast<std::ptrdiff_t>(rgb.width()) * 3);
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  picture_.SetBackground(rgb);
  // A sun below the horizon lights nothing and casts no shadow.
  if (HasSun()) {
    PLEINAIR_RETURN_IF_ERROR(DrawShadowMaps(camera_from_marker));
  }
  DrawScene(camera_from_marker, gain);
  picture_.Draw(targets_);
  if (options_.show_shadow_maps && HasSun()) {
    PLEINAIR_RETURN_IF_ERROR(DrawDebugView(camera_from_marker));
  }
  return picture_.Read();
}

}  // namespace

Result<std::unique_ptr<Composer>> Composer::Create(const CameraModel& camera,
                                                   const std::vector<PlacedModel>& scene,
                                                   const ComposerOptions& options) {
  return GlComposer::Make(camera, scene, options);
}

}  // namespace pleinair::compositor
