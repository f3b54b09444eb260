#include "app/live/live_scene.h"

#include <utility>

#include "session/scene_marker.h"

namespace pleinair::app {

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
  return renderer->UseLight(light_->Take());
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
  if (auto light = light_->Take()) return renderer->UseLight(std::move(light));
  return {};
}

void LiveScene::Show(const std::shared_ptr<const devices::Frame>& frame,
                     const Transform<Camera, Marker>& camera_from_marker, UtcTime moment) {
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
  if (light_) light_->Stop();
}

}  // namespace pleinair::app
