#include "compositor/composer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "compositor/canvas.h"
#include "compositor/embedded_shaders.h"
#include "compositor/ink_drawing.h"
#include "compositor/lens_drawing.h"
#include "compositor/light/changing/changing_bodies.h"
#include "compositor/passes/frame_daylight.h"
#include "compositor/passes/frame_programs.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/glm_vectors.h"
#include "compositor/passes/object_pass.h"
#include "compositor/passes/scene_shadows.h"
#include "compositor/passes/scene_view.h"
#include "compositor/passes/shadow_debug_view.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/egl_context.h"
#include "gl/program.h"

namespace pleinair::compositor {
namespace {

struct Passes {
  ShadowRatioPass ratio;
  ObjectPass objects;
  InkDrawing ink;
  FramePrograms programs;
  std::optional<ShadowDebugView> debug_view;  // Created on first use, for one canvas.
};

class GlComposer : public Composer {
 public:
  static Result<std::unique_ptr<Composer>> Make(const CameraModel& camera,
                                                const std::vector<PlacedModel>& scene,
                                                const ComposerOptions& options);

  // The members' GL objects need the context for their destruction.
  ~GlComposer() override { static_cast<void>(context_.MakeCurrent()); }

  Result<void> SetOptions(const ComposerOptions& options) override;
  void LetGo() override { context_.ReleaseCurrent(); }
  int samples() const override { return canvas_.targets.ids().samples(); }
  double MixedPixels() const override { return canvas_.coverage.MeasuredShare(); }
  void MoveModel(int placed_model, const Mat3& linear, Vec3 translation_m) override {
    if (changing_ && changing_->Has(placed_model)) {
      changing_->Move(placed_model, linear, translation_m);
    } else {
      surfaces_.Move(placed_model, linear, translation_m);
    }
  }
  void SetShape(int placed_model, std::span<const MeshShape> shape) override {
    if (changing_) changing_->SetShape(placed_model, shape);
  }
  Result<void> SetLight(const std::vector<LitMesh>& lit, const sky::SkyModel& day,
                        const Mat3& marker_from_world, LinearRgb from_below) override;
  Result<void> SetResponse(const CameraResponse& response) override;
  Result<void> SetLightMix(const std::vector<LitMesh>& lit, const LightMix& mix) override;
  Result<void> SetAmbient(const std::vector<LitMesh>& lit) override;
  void SetSun(const sky::SkyModel& day, const Mat3& marker_from_world) override;
  Result<RgbImage> Compose(CameraImageView image,
                           const Transform<Camera, Marker>& camera_from_marker,
                           LinearRgb exposure_scale) override;
  void SetMarkerMargin(double board_size_m) override { unmodelled_.margin_size_m = board_size_m; }
  void AssumeUnmodelledShadows(bool look) override { unmodelled_.assume_unmodelled = look; }
  Result<void> SetSunTransmittance(const SunShade& shade) override;
  void SetLens(const std::optional<ThinLens>& lens, int places) override {
    lens_.SetLens(lens, places);
  }
  void SetMotion(const CameraMotion& motion, int max_views) override {
    lens_.SetMotion(motion, max_views);
  }
  Result<void> SetInk(std::span<const InkShape> shapes, const Mat3& marker_from_world) override {
    PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
    return passes_.ink.SetShapes(shapes, marker_from_world, &surfaces_, &canvas_);
  }
  LensFigures DrawnLens() const override { return lens_.figures(); }
  Result<void> SkipImage(const Transform<Camera, Marker>& camera_from_marker) override;
  Result<void> SetCameraLook(const std::optional<CameraLook>& look) override {
    PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
    look_ = look;
    return canvas_.picture.SetCameraLook(look);
  }

 private:
  GlComposer(const CameraModel& camera, gl::EglContext context)
      : context_(std::move(context)), camera_(camera) {}

  /// Leaves change their color with those of sun and sky.
  void SetLightColors(const sky::SkyModel& day) {
    surfaces_.SetLightColors(day.SunNormalIrradiance(), day.SkyHorizontalIrradiance());
  }
  Result<void> SetRenderSize(const ComposerOptions& options);
  shadows::ShadowMapOptions MapOptions(const ComposerOptions& options) const;
  Result<void> MakeShadows(const shadows::ShadowMapOptions& options);
  /// Programs for the current shadow maps and the frame's airlight.
  Result<const SurfacePrograms*> ProgramsFor(const FrameUniforms& frame);
  Result<void> SortSurfaces();
  Result<shadows::View> UpdateScene(const Transform<Camera, Marker>& camera_from_marker);
  void DrawScene(const SurfacePrograms& programs, const FrameUniforms& frame,
                 const AffectedTiles& tiles);
  FrameUniforms FrameOf(const shadows::View& view,
                        const Transform<Camera, Marker>& camera_from_marker,
                        LinearRgb exposure_scale) const;
  AffectedTiles DrawCoarse(const SurfacePrograms& programs, const shadows::View& view,
                           const FrameUniforms& frame, int lens_spread_px);
  Result<void> DrawDebugView(const shadows::View& view);

  gl::EglContext context_;  // First, so that it outlives the GL objects.
  CameraModel camera_;
  ComposerOptions options_;
  Canvas canvas_;
  std::optional<CameraLook> look_;
  LensDrawing lens_;
  ShadowRatioPass::ShadowOptions unmodelled_;
  FrameDaylight light_;
  Passes passes_;
  SceneSurfaces surfaces_;
  SceneShadows shadows_;
  std::unique_ptr<ChangingBodies> changing_;  // Null if no model changes its shape.
};

Result<std::unique_ptr<Composer>> GlComposer::Make(const CameraModel& camera,
                                                   const std::vector<PlacedModel>& scene,
                                                   const ComposerOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(gl::EglContext context, gl::EglContext::Create());
  RegisterShaders();
  std::unique_ptr<GlComposer> composer(new GlComposer(camera, std::move(context)));
  GlComposer& c = *composer;
  PLEINAIR_ASSIGN_OR_RETURN(c.light_, FrameDaylight::Create());
  PLEINAIR_ASSIGN_OR_RETURN(c.surfaces_, SceneSurfaces::Create(scene));
  PLEINAIR_ASSIGN_OR_RETURN(c.passes_.ratio,
                            ShadowRatioPass::Create(c.surfaces_.materials().HasBlended()));
  PLEINAIR_ASSIGN_OR_RETURN(c.changing_, ChangingBodies::Create(scene));
  PLEINAIR_RETURN_IF_ERROR(c.SetRenderSize(options));
  PLEINAIR_RETURN_IF_ERROR(c.MakeShadows(c.MapOptions(options)));
  PLEINAIR_RETURN_IF_ERROR(c.ProgramsFor({}));
  c.surfaces_.Use(options.reductions);
  c.options_ = options;
  return composer;
}

/// Sets the number of render pixels and creates the render targets.
Result<void> GlComposer::SetRenderSize(const ComposerOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(canvas_, Canvas::Create(camera_, options, surfaces_.materials()));
  PLEINAIR_ASSIGN_OR_RETURN(passes_.objects,
                            ObjectPass::Create(surfaces_.materials().HasDetails(),
                                               options.antialiasing.DrawnPlaces() > 1));
  passes_.debug_view.reset();
  return canvas_.picture.SetCameraLook(look_);
}

shadows::ShadowMapOptions GlComposer::MapOptions(const ComposerOptions& options) const {
  return SceneShadows::MapOptions(options, std::max(canvas_.camera.width, canvas_.camera.height));
}

Result<void> GlComposer::MakeShadows(const shadows::ShadowMapOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(shadows_, SceneShadows::Create(options));
  passes_.debug_view.reset();
  return {};
}

Result<void> GlComposer::SetOptions(const ComposerOptions& options) {
  if (options == options_) return {};
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  if (options.supersampling != options_.supersampling || options.response != options_.response ||
      options.antialiasing != options_.antialiasing) {
    PLEINAIR_RETURN_IF_ERROR(SetRenderSize(options));
  }
  // Another image size mostly needs the same maps, whose content stays valid.
  const shadows::ShadowMapOptions maps = MapOptions(options);
  const bool other_shaders = maps.method != shadows_.options().method ||
                             maps.sun_disc_filter != shadows_.options().sun_disc_filter ||
                             maps.partitions != shadows_.options().partitions;
  if (maps != shadows_.options()) PLEINAIR_RETURN_IF_ERROR(MakeShadows(maps));
  if (other_shaders) {
    passes_.programs.Clear();
    passes_.ink.ClearPrograms();
    PLEINAIR_RETURN_IF_ERROR(ProgramsFor({}));
  }
  surfaces_.Use(options.reductions);
  options_ = options;
  return {};
}

Result<const SurfacePrograms*> GlComposer::ProgramsFor(const FrameUniforms& frame) {
  return passes_.programs.For(shadows_.options(), surfaces_.materials(),
                              {shadows_.Fades(), frame.needs_airlight});
}

Result<void> GlComposer::SetLight(const std::vector<LitMesh>& lit, const sky::SkyModel& day,
                                  const Mat3& marker_from_world, LinearRgb from_below) {
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  light_.SetDay(day, marker_from_world);
  SetLightColors(day);
  if (changing_) PLEINAIR_RETURN_IF_ERROR(changing_->SetLight(lit, day, marker_from_world));
  PLEINAIR_RETURN_IF_ERROR(surfaces_.SetLit(changing_ ? changing_->meshes() : lit));
  // Otherwise no program samples it.
  if (surfaces_.materials().HasGloss()) light_.SetEnvironment(day, marker_from_world, from_below);
  return {};
}

Result<void> GlComposer::SetResponse(const CameraResponse& response) {
  ComposerOptions options = options_;
  options.response = response;
  return SetOptions(options);
}

Result<void> GlComposer::SetLightMix(const std::vector<LitMesh>& lit, const LightMix& mix) {
  if (mix == light_.mix()) return {};
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  light_.SetMix(mix);
  return surfaces_.SetMix(changing_ ? changing_->meshes() : lit, mix);
}

Result<void> GlComposer::SetAmbient(const std::vector<LitMesh>& lit) {
  if (changing_) return {};
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  return surfaces_.SetMix(lit, light_.mix());
}

void GlComposer::SetSun(const sky::SkyModel& day, const Mat3& marker_from_world) {
  light_.SetSun(day, marker_from_world);
  SetLightColors(day);
}

Result<void> GlComposer::SetSunTransmittance(const SunShade& shade) {
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  return light_.SetShade(shade);
}

Result<void> GlComposer::DrawDebugView(const shadows::View& view) {
  if (!options_.show_shadow_maps || !light_.HasSun()) return {};
  const shadows::ShadowMaps& maps = shadows_.maps();
  if (!passes_.debug_view) {
    PLEINAIR_ASSIGN_OR_RETURN(
        passes_.debug_view,
        ShadowDebugView::Create(maps.options(), canvas_.camera.width, canvas_.camera.height));
  }
  passes_.debug_view->Draw(
      maps, glm::mat4(view.ClipFromMarker()),
      [&](const gl::GlProgram& program) { surfaces_.Draw(program); }, canvas_.picture.positions(),
      canvas_.picture.framebuffer());
  return {};
}

/// Classifies triangles by the sun's possible change. The shadow maps must be up to date.
Result<void> GlComposer::SortSurfaces() {
  SunOnPhantoms sun;
  // Where sunlight is measured in the image, it also affects how much a change of sky light
  // matters. The sun then counts on all triangles.
  sun.whole = unmodelled_.assume_unmodelled || light_.IsShaded();
  if (light_.HasSun()) {
    sun.window = shadows_.Window();
    sun.normal_lux = ToGlm(light_.SunNow());
  }
  PLEINAIR_RETURN_IF_ERROR(surfaces_.SortPhantoms(sun));
  return surfaces_.SortObjects(light_.HasSun() ? ToGlm(light_.to_sun()) : glm::vec3(0.0F));
}

void GlComposer::DrawScene(const SurfacePrograms& programs, const FrameUniforms& frame,
                           const AffectedTiles& tiles) {
  canvas_.coverage.Measure(surfaces_, frame, canvas_.targets, tiles.fine.Rectangles());
  EnableSurfaceTests();
  passes_.ratio.DrawSurfaces(canvas_.targets, surfaces_, frame, tiles.fine.Bounds());
  passes_.objects.DrawSurfaces(canvas_.targets, surfaces_, frame, tiles.objects.Bounds());
  glDisable(GL_CULL_FACE);
  light_.BindShade();
  passes_.objects.Draw(canvas_.targets, surfaces_, canvas_.coverage, programs, frame,
                       light_.environment(), tiles.objects.Rectangles());
  canvas_.picture.BindForShading(2, 3, 4);
  passes_.ratio.Draw(canvas_.targets, surfaces_, canvas_.coverage, programs, frame, unmodelled_,
                     tiles.fine.Rectangles());
  glDisable(GL_DEPTH_TEST);
}

/// Requires classified surfaces.
FrameUniforms GlComposer::FrameOf(const shadows::View& view,
                                  const Transform<Camera, Marker>& camera_from_marker,
                                  LinearRgb exposure_scale) const {
  FrameUniforms frame;
  frame.clip_from_marker = glm::mat4(view.ClipFromMarker());
  frame.eye_m = ToGlm(camera_from_marker.Inverse().translation_m);
  frame.ray = RaysThroughPixels(canvas_.camera, view);
  frame.exposure_scale = ToGlm(exposure_scale);
  light_.SetUniforms(&frame);
  light_.SetFog(surfaces_.placement().object_bounds(), view, options_, &frame);
  frame.linear_needs_airlight =
      frame.needs_airlight &&
      frame.IsNoticed(frame.fog.MaxLightPerMetre() * surfaces_.MaxLinearChangeFarFrom(frame.eye_m));
  return frame;
}

/// Draws the coarse ratio where it is enough. Requires classified surfaces.
AffectedTiles GlComposer::DrawCoarse(const SurfacePrograms& programs, const shadows::View& view,
                                     const FrameUniforms& frame, int lens_spread_px) {
  SceneProjection image =
      ProjectionOf(canvas_.camera, view,
                   canvas_.picture.Spread_px() + canvas_.places.Spread_px() + lens_spread_px);
  image.resolves_sunlit_sky = frame.needs_airlight;
  AffectedTiles tiles = surfaces_.TilesOf(image);
  light_.BindShade();
  if (options_.show_shadow_maps) tiles.all.IncludeAll();
  if (frame.linear_needs_airlight) tiles.fine.Include(tiles.all);
  const ImageTiles coarse = tiles.all.Without(tiles.fine);
  if (coarse.Count() > 0) {
    tiles.fine.Include(
        canvas_.coarse.Draw(passes_.ratio, surfaces_, programs, view, frame, coarse));
  }
  return {tiles.objects, canvas_.picture.SetTiles(tiles, canvas_.DrawnInk()), tiles.all};
}

/// Brings shapes and shadow maps up to date, and classifies the surfaces by them.
Result<shadows::View> GlComposer::UpdateScene(const Transform<Camera, Marker>& camera_from_marker) {
  if (changing_ && !changing_->meshes().empty()) {
    using Changed = ChangingBodies::Changed;
    PLEINAIR_ASSIGN_OR_RETURN(const Changed changed, changing_->Update());
    if (changed == Changed::kTriangles) {
      PLEINAIR_RETURN_IF_ERROR(surfaces_.Replace(changing_->meshes()));
    }
    if (changed != Changed::kNothing) {
      surfaces_.SetShapes(changing_->meshes(), changing_->first_body());
    }
    PLEINAIR_RETURN_IF_ERROR(surfaces_.SetMix(changing_->meshes(), light_.mix()));
  }
  const shadows::View view =
      ViewOf(canvas_.camera, camera_from_marker, surfaces_.placement().bounds());
  if (light_.HasSun()) {
    PLEINAIR_RETURN_IF_ERROR(shadows_.Update(surfaces_, {light_.to_sun()}, view));
  }
  PLEINAIR_RETURN_IF_ERROR(SortSurfaces());
  return view;
}

Result<void> GlComposer::SkipImage(const Transform<Camera, Marker>& camera_from_marker) {
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  PLEINAIR_RETURN_IF_ERROR(UpdateScene(camera_from_marker));
  canvas_.picture.Skip();
  return {};
}

Result<RgbImage> GlComposer::Compose(CameraImageView image,
                                     const Transform<Camera, Marker>& camera_from_marker,
                                     LinearRgb exposure_scale) {
  PLEINAIR_RETURN_IF_ERROR(context_.MakeCurrent());
  PLEINAIR_RETURN_IF_ERROR(canvas_.picture.SetBackground(image));
  PLEINAIR_ASSIGN_OR_RETURN(const shadows::View view, UpdateScene(camera_from_marker));
  const FrameUniforms frame = FrameOf(view, camera_from_marker, exposure_scale);
  PLEINAIR_ASSIGN_OR_RETURN(const SurfacePrograms* programs, ProgramsFor(frame));
  PLEINAIR_RETURN_IF_ERROR(passes_.ink.Draw(
      {surfaces_, passes_.ratio, light_, shadows_, unmodelled_}, view, frame, &canvas_));
  const auto draw_pinhole = [&](int lens_spread_px) {
    AffectedTiles drawn = DrawCoarse(*programs, view, frame, lens_spread_px);
    canvas_.places.Draw(canvas_.targets, frame, drawn.fine.Rectangles(),
                        [&](const FrameUniforms& place) { DrawScene(*programs, place, drawn); });
    return drawn;
  };
  const int spread_px =
      lens_.AssumedSpread_px(canvas_.camera, view, surfaces_.placement().object_bounds());
  AffectedTiles tiles = draw_pinhole(spread_px);
  // Airlight in front of surfaces is drawn into the objects' image.
  if (frame.needs_airlight) tiles.objects.Include(tiles.fine);
  const LensScene seen{canvas_,
                       surfaces_,
                       passes_.ratio,
                       passes_.objects,
                       *programs,
                       light_,
                       options_.show_shadow_maps,
                       camera_.fx,
                       spread_px,
                       draw_pinhole,
                       [&](const FrameUniforms& through, const AffectedTiles& drawn) {
                         DrawScene(*programs, through, drawn);
                       }};
  PLEINAIR_ASSIGN_OR_RETURN(const RealOccluders* occluders, lens_.Draw(seen, frame, view, &tiles));
  PLEINAIR_RETURN_IF_ERROR(canvas_.picture.Draw(canvas_.targets, canvas_.coarse.ratio(), tiles,
                                                occluders, canvas_.DrawnInk()));
  PLEINAIR_RETURN_IF_ERROR(DrawDebugView(view));
  return canvas_.picture.Read(image.rgb());
}

}  // namespace

Result<std::unique_ptr<Composer>> Composer::Create(const CameraModel& camera,
                                                   const std::vector<PlacedModel>& scene,
                                                   const ComposerOptions& options) {
  return GlComposer::Make(camera, scene, options);
}

}  // namespace pleinair::compositor
