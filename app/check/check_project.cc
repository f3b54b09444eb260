#include "app/check/check_project.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/check/spread_frames.h"
#include "app/check/views_near_sample.h"
#include "app/replay/given_trajectory.h"
#include "app/replay/placement_warnings.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/interrupt_deadline.h"
#include "compositor/photometry/sky_fit.h"
#include "devices/recordings/recording.h"
#include "files/text_file.h"
#include "scene/sun_over_place.h"
#include "session/pipeline.h"
#include "session/recording_passes.h"
#include "session/scene_marker.h"
#include "session/scene_renderer.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

// With a trajectory, the marker may be in view for a second of a minute.
constexpr std::size_t kMaxFramesByMarker = 24, kMaxFramesAlongTrajectory = 96;

Result<devices::Recording> OpenWhole(const CheckRequest& request) {
  return devices::OpenRecording(request.project, {request.calibration, request.scene});
}

Result<devices::Recording> OpenSpread(const CheckRequest& request) {
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, OpenWhole(request));
  const bool has_trajectory = recording.scene && recording.scene->trajectory;
  recording.frames = std::make_unique<SpreadFrames>(
      std::move(recording.frames), has_trajectory ? kMaxFramesAlongTrajectory : kMaxFramesByMarker);
  return recording;
}

/// What recording.json says of a lens that 'pleinair new' assumed; empty: it is calibrated.
std::string LensGuess(const CheckRequest& request) {
  if (request.calibration) return {};
  const auto bytes =
      files::ReadWholeFile(request.project / "recording.json", files::kMaxDescriptionBytes);
  if (!bytes) return {};
  const nlohmann::json json = nlohmann::json::parse(*bytes, nullptr, false);
  if (!json.is_object() || !json.contains("calibration_from")) return {};
  const nlohmann::json& from = json["calibration_from"];
  if (!from.is_string()) return {};
  const auto text = from.get<std::string>();
  return text.starts_with("assumed") || text.starts_with("the tags") ? text : std::string();
}

/// The marker of a frame that the scene may mean; null without one.
const tracker::MarkerObservation* SceneMarkerIn(
    const std::vector<tracker::MarkerObservation>& markers,
    const scene::MarkerDescription& described) {
  const auto at = std::find_if(markers.begin(), markers.end(), [&](const auto& marker) {
    const auto name = session::NameOfDetected(marker.detection);
    return name && session::MayBeReferenceMarker(*name, described);
  });
  return at == markers.end() ? nullptr : &*at;
}

/// Composes along the scene's trajectory from now on, if it fits.
TrajectoryFit FitTrajectory(const session::TrajectoryRequest& request,
                            session::Pipeline* pipeline) {
  TrajectoryFit fit;
  fit.has_marker = !request.points.empty() || pipeline->tracks().ReferenceMarker().has_value();
  if (!fit.has_marker) return fit;
  if (const auto followed = pipeline->FollowTrajectory(request); !followed) {
    fit.summary = tl::make_unexpected(followed.error());
  } else {
    fit.summary = *pipeline->trajectory_summary();
  }
  return fit;
}

}  // namespace

Result<SiteFacts> LookAtSite(const CheckRequest& request) {
  const InterruptGuard guard;
  const InterruptDeadline deadline(
      request.project.string(), [] {}, "nothing was checked");
  const session::PassMonitor monitor{[&](std::int64_t, std::optional<std::int64_t>) {
                                       return CheckInterrupt(request.project.string());
                                     },
                                     nullptr};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, OpenSpread(request));
  if (!recording.scene) {
    return InputError(request.project.string(), "has no scene",
                      "make one with 'pleinair new', or give --scene");
  }
  const scene::SceneDescription scene = *recording.scene;
  const CameraModel camera = recording.camera;
  std::optional<session::TrajectoryRequest> trajectory;
  if (scene.trajectory) {
    PLEINAIR_ASSIGN_OR_RETURN(trajectory, ReadGivenTrajectory(*scene.trajectory));
  }
  session::PipelineOptions options;
  options.light.film_response = devices::ResponseOf(recording.curve);
  PLEINAIR_ASSIGN_OR_RETURN(const auto pipeline, session::Pipeline::Create(camera, scene, options));
  SiteFacts facts;
  facts.has_objects = !scene.objects.empty();
  facts.shadows.casters = static_cast<int>(
      std::ranges::count_if(scene.phantoms, [](const scene::ModelReference& phantom) {
        return !phantom.surface || phantom.surface->kind != scene::SurfaceKind::kGround;
      }));
  facts.lens_guess = LensGuess(request);
  facts.sun_elevation_deg =
      ToDegrees(scene::SunOver(scene.place_time, scene.place_time.start).elevation);
  const CameraResponse response = pipeline->renderer().response();
  const auto take = [&](const devices::Frame& frame,
                        const session::TrackedFrame& tracked) -> Result<void> {
    if (facts.looked_at == 0 && trajectory) trajectory->clock_start_ns = ClockStartOf(frame);
    ++facts.looked_at;
    const tracker::MarkerObservation* marker = SceneMarkerIn(tracked.observations, scene.marker);
    if (marker == nullptr) return {};
    const session::MarkerName name = *session::NameOfDetected(marker->detection);
    facts.frames.push_back(MeasureFrame(frame, *marker, camera,
                                        scene.marker.target
                                            ? scene::MarkerReflectance()
                                            : session::MarkerReflectanceOf(scene.marker, name),
                                        response));
    return {};
  };
  const auto damage = recording.damage;
  PLEINAIR_RETURN_IF_ERROR(session::TrackRecording(*pipeline, std::move(recording), take, monitor));
  facts.damage = *damage;
  if (trajectory) {
    PLEINAIR_ASSIGN_OR_RETURN(
        trajectory->more_views,
        ViewsNearSample(
            *pipeline, *trajectory, [&] { return OpenWhole(request); }, monitor));
    facts.trajectory = FitTrajectory(*trajectory, pipeline.get());
  }
  facts.with_pose = static_cast<std::int64_t>(pipeline->Path().size());
  const auto reference = pipeline->PathMarker();
  if (!reference) return facts;
  facts.marker = reference->ToString();
  session::SceneRenderer& renderer = pipeline->renderer();
  if (facts.has_objects) {
    facts.placement = PlacementWarnings(renderer.placed(), scene, {camera, pipeline->Path()},
                                        renderer.phantom_rays());
  }
  if (!renderer.CanMeasureLight()) return facts;
  PLEINAIR_ASSIGN_OR_RETURN(recording, OpenSpread(request));
  PLEINAIR_RETURN_IF_ERROR(session::EstimateLight(*pipeline, std::move(recording), monitor));
  facts.light = renderer.light().measured;
  const sky::SunPosition sun = scene::SunOver(scene.place_time, scene.place_time.start);
  facts.light->sun_to_sky_stated =
      compositor::SunToSky(*compositor::DescribedSky(scene)->ForSun(sun.ToSun(), sun.distance_au));
  const auto& elsewhere = facts.light->evidence.sun_elsewhere;
  if (elsewhere && elsewhere->later_s) {
    facts.shadows.time_that_fits = scene.place_time.start.PlusSeconds(*elsewhere->later_s);
  }
  return facts;
}

}  // namespace pleinair::app
