#include "app/live/live_scene.h"

#include <utility>

#include "session/scene_marker.h"

namespace pleinair::app {
namespace {

bool HaveSameRatio(const session::LightingRequest& a, const session::LightingRequest& b) {
  return a.skies.source == b.skies.source && a.skies.scale == b.skies.scale;
}

/// True if a light shines on the same surfaces from the same sun and sky, whatever the rays.
bool AreAlike(const session::BakedLighting& a, const session::BakedLighting& b) {
  return a.phantoms == b.phantoms && HaveSameRatio(a.request, b.request) &&
         a.request.marker.heading.value() == b.request.marker.heading.value() &&
         session::IsNearSun(a.sun, b.sun);
}

}  // namespace

void LiveScene::StartFollowing(const CameraModel& camera, const session::LightOptions& light,
                               const session::SceneRenderer& renderer) {
  if (light.changes == session::LightChangeMode::kFollow) {
    changes_ = std::make_unique<session::LiveLight>(camera, renderer.response());
  }
  if (renderer.lens().MayBeMeasured() || renderer.exposure().MayBeMeasured()) {
    lens_ =
        std::make_unique<session::LiveLens>(camera, renderer.response(), renderer.lens().Known());
  }
}

void LiveScene::Follow(const std::shared_ptr<const devices::Frame>& frame,
                       const Transform<Camera, Marker>& camera_from_marker,
                       const scene::MarkerReflectance& marker) {
  if (changes_) changes_->Show(frame, camera_from_marker, marker);
  if (lens_) lens_->Show(frame, camera_from_marker, marker);
}

bool LiveScene::ShowsOtherMoment() const {
  const std::lock_guard lock(mutex_);
  return edit_.later_s != 0.0 || edit_.latitude_deg != described_.place_time.latitude_deg ||
         edit_.longitude_deg != described_.place_time.longitude_deg;
}

session::FollowedLight LiveScene::FollowedIn(std::int64_t frame_index) const {
  if (!changes_ || ShowsOtherMoment()) return {};
  return changes_->Of(frame_index);
}

/// Draws with a new light, and refers the followed light to it.
Result<void> LiveScene::Take(std::shared_ptr<const session::BakedLighting> light,
                             session::SceneRenderer* renderer) {
  if (changes_ && !ShowsOtherMoment() && !(followed_ && AreAlike(*followed_, *light))) {
    const auto& solver = light->request.solver;
    changes_->Use({{solver, &solver->phantoms()},
                   {light, &light->daylight},
                   light->marker_from_world,
                   followed_ && !HaveSameRatio(followed_->request, light->request),
                   followed_ && followed_->phantoms != light->phantoms});
    followed_ = light;
  }
  return renderer->UseLight(std::move(light));
}

Result<void> LiveScene::StartLight(const CameraModel& camera, const session::LightOptions& light,
                                   UtcTime start, session::SceneRenderer* renderer) {
  const session::LightingRequest request = renderer->MakeLightingRequest(start);
  session::BackgroundLight::Setup setup{
      camera,        described_, renderer->placed(),  light, edit_,
      request.skies, start,      renderer->response()};
  setup.solver = request.solver;
  // Otherwise the first exposure would be a guess, and change with the next light.
  const scene::MarkerDescription& marker = described_.marker;
  if (marker.family && marker.id) {
    setup.marker_reflectance = session::MarkerReflectanceOf(marker, {*marker.family, *marker.id});
  }
  PLEINAIR_ASSIGN_OR_RETURN(light_, session::BackgroundLight::Create(std::move(setup)));
  return Take(light_->Take(), renderer);
}

void LiveScene::Edit(const session::SceneEdit& edit) {
  const std::lock_guard lock(mutex_);
  edit_ = edit;
  edited_ = true;
}

scene::SceneDescription LiveScene::Edited() const {
  const std::lock_guard lock(mutex_);
  return session::WithEdit(described_, edit_);
}

void LiveScene::SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance) {
  if (light_) light_->SetMarkerReflectance(marker_reflectance);
}

Result<void> LiveScene::Update(UtcTime moment, session::SceneRenderer* renderer) {
  if (lens_) {
    if (const auto measured = lens_->TakeNews()) {
      if (renderer->lens().MayBeMeasured()) renderer->UseMeasuredLens(measured->fit, {});
      if (renderer->exposure().MayBeMeasured()) {
        renderer->UseMeasuredExposure(measured->exposure);
      }
    }
  }
  std::optional<session::SceneEdit> edit;
  std::optional<session::SceneEdit> drawn;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(edited_, false)) {
      edit = edit_;
      drawn = edit_;
      drawn->drawing = detail_.Apply(edit_);
    }
  }
  if (edit) {
    PLEINAIR_RETURN_IF_ERROR(renderer->Edit(*drawn));
    if (light_) light_->SetEdit(*edit);
  }
  if (!light_) return {};
  light_->SetTime(moment);
  if (auto light = light_->Take()) return Take(std::move(light), renderer);
  return {};
}

void LiveScene::Show(const std::shared_ptr<const devices::Frame>& frame,
                     const Transform<Camera, Marker>& camera_from_marker, UtcTime moment) {
  // Frames under a cloud have another light than the one to which the changes refer.
  if (changes_ && !changes_->newest().in_full_sun) return;
  if (light_) light_->Show(frame, camera_from_marker, moment);
}

void LiveScene::NoteDrawn(double compose_ms, double period_ms) {
  const std::lock_guard lock(mutex_);
  if (edit_.detail != session::Detail::kAutomatic) return;
  if (detail_.Add(compose_ms, period_ms)) edited_ = true;
}

session::Detail LiveScene::detail() const {
  const std::lock_guard lock(mutex_);
  return detail_.detail();
}

std::optional<session::BackgroundLight::Progress> LiveScene::light_progress() const {
  return light_ ? std::optional(light_->progress()) : std::nullopt;
}

void LiveScene::Stop() {
  if (lens_) lens_->Stop();
  if (changes_) changes_->Stop();
  if (light_) light_->Stop();
}

}  // namespace pleinair::app
