#include "session/pipeline.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/parallel_for.h"
#include "base/scaled_camera.h"
#include "devices/images/resize_image.h"
#include "devices/images/rounded_image.h"
#include "session/anchor_follower.h"
#include "session/marker_refiner.h"
#include "session/motion/pose_motion.h"
#include "session/scene_marker.h"
#include "session/scene_renderer.h"

namespace pleinair::session {

Pipeline::Pipeline(const CameraModel& camera, const scene::SceneDescription& scene,
                   const PipelineOptions& options)
    : camera_(camera),
      output_camera_(
          ScaleCamera(camera, options.image_size.value_or(ImageSize{camera.width, camera.height}))),
      scene_(scene),
      hands_in_front_(options.light.hands_in_front),
      follows_light_(options.light.changes == LightChangeMode::kFollow),
      kept_observations_(options.kept_observations),
      tracks_(scene.marker) {
  by_anchors_.places_in_background = options.places_anchors_in_background;
}

Pipeline::~Pipeline() = default;

Result<std::unique_ptr<Pipeline>> Pipeline::Create(const CameraModel& camera,
                                                   const scene::SceneDescription& scene,
                                                   const PipelineOptions& options) {
  std::unique_ptr<Pipeline> pipeline(
      new Pipeline(camera, WithGiven(scene, options.light), options));
  const scene::SceneDescription& given = pipeline->scene_;
  if (options.light.changes == LightChangeMode::kStated && given.clouds.layers.empty()) {
    return InputError(given.file.string(), "has no layers of clouds for --light-changes stated",
                      "add a [[cloud_layer]], or follow the light");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const tracker::TrackerOptions tracking, TrackingOf(given));
  auto tracker = tracker::Tracker::Create(camera, tracking);
  if (!tracker) {
    // Its errors concern the marker in the scene description.
    Error error = std::move(tracker).error();
    if (error.where.empty()) error.where = given.file.string();
    return tl::make_unexpected(std::move(error));
  }
  pipeline->tracker_ = *std::move(tracker);
  if (options.refine_markers) {
    pipeline->refiner_ = std::make_unique<MarkerRefiner>(camera, given.marker.size_m);
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      pipeline->renderer_,
      SceneRenderer::Create(pipeline->output_camera_, given, options.composer, options.light));
  return pipeline;
}

Result<ComposedFrame> Pipeline::Process(const devices::Frame& frame) {
  PLEINAIR_ASSIGN_OR_RETURN(const TrackedFrame tracked, Track(frame));
  const std::optional<CameraPose> pose = FollowIn(frame);
  const UtcTime time = MomentOf(frame.timestamp_ns);
  if (HasOutputSize(frame)) return Compose(devices::ImageOf(frame), pose, time);
  RgbImage rgb;
  DeepImage deep;
  ResizeInto(frame, &rgb, &deep);
  return Compose({rgb.view(), std::as_const(deep).view()}, pose, time);
}

Result<TrackedFrame> Pipeline::Track(const devices::Frame& frame) {
  const ImageView<const std::uint8_t> grey = frame.grey.view();
  TrackedFrame tracked;
  PLEINAIR_ASSIGN_OR_RETURN(tracked.observations, tracker_->Track(grey));
  tracked.lost = tracker_->Lost();
  tracked.warnings = tracker_->Warnings();
  if (refiner_) tracked.observations = refiner_->Measure(grey, std::move(tracked.observations));
  ScaleAnchors(scene_, &tracked.observations);
  AddToTracks(frame, tracked.observations);
  return tracked;
}

Result<FoundFrame> Pipeline::Find(devices::Frame frame) {
  PLEINAIR_ASSIGN_OR_RETURN(auto markers, tracker_->Find(frame.grey.view()));
  return FoundFrame{std::move(frame), std::move(markers), tracker_->Lost(), tracker_->Warnings()};
}

std::vector<TrackedFrame> Pipeline::Measure(std::span<FoundFrame> found) {
  ParallelFor(found.size(), 0, [&](std::size_t i) {
    tracker_->Align(found[i].frame.grey.view(), &found[i].markers);
  });
  std::vector<MarkerRefiner::Seen> seen;
  seen.reserve(found.size());
  for (FoundFrame& frame : found) {
    const ImageView<const std::uint8_t> grey = frame.frame.grey.view();
    seen.push_back({grey, tracker_->Conclude(grey, std::move(frame.markers))});
  }
  if (refiner_) refiner_->Measure(seen);
  std::vector<TrackedFrame> tracked(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ScaleAnchors(scene_, &seen[i].observations);
    AddToTracks(found[i].frame, seen[i].observations);
    ProbeLight(found[i].frame);
    tracked[i] = {std::move(seen[i].observations), std::move(found[i].lost),
                  std::move(found[i].warnings)};
  }
  return tracked;
}

void Pipeline::ProbeLight(const devices::Frame& last_tracked) {
  if (!renderer_->DrawsObjects()) return;
  const std::optional<CameraPose> pose = PoseIn(last_tracked);
  if (!pose) return;
  const CameraImageView image = devices::ImageOf(last_tracked);
  renderer_->ProbeLight(image, ScaleCamera(output_camera_, {image.width(), image.height()}),
                        pose->observation.camera_from_marker, last_tracked.index,
                        last_tracked.timestamp_ns,
                        MarkerReflectanceOf(scene_.marker, pose->marker));
}

void Pipeline::AddToTracks(const devices::Frame& frame,
                           const std::vector<tracker::MarkerObservation>& observations) {
  tracks_.AddFrame(frame.index, frame.timestamp_ns, observations);
  if (kept_observations_) tracks_.ForgetAllBut(*kept_observations_);
}

std::optional<CameraPose> Pipeline::PoseIn(const devices::Frame& last_tracked) const {
  const std::optional<MarkerName> marker = tracks_.ReferenceMarker();
  if (!marker) return std::nullopt;
  const Observation& last = tracks_.TrackOf(*marker).back();
  if (last.frame_index != last_tracked.index) return std::nullopt;
  return CameraPose{*marker, last};
}

std::optional<CameraPose> Pipeline::FollowIn(const devices::Frame& last_tracked) {
  std::optional<CameraPose> pose = FollowMarkersIn(last_tracked);
  if (!pose || renderer_->exposure().IsOff()) return pose;
  pose->exposure_s = last_tracked.settings.exposure_s;
  // By the past alone: the reference marker shows how the camera moved last.
  const std::vector<Observation>& track = tracks_.TrackOf(pose->marker);
  if (!track.empty() && track.back().frame_index == last_tracked.index) {
    pose->motion =
        MovedTo(MotionAbout(track, track.size() - 1), pose->observation.camera_from_marker);
  }
  return pose;
}

std::optional<CameraPose> Pipeline::FollowMarkersIn(const devices::Frame& last_tracked) {
  if (scene_.anchors.empty()) return PoseIn(last_tracked);
  if (!by_anchors_.follower) {
    by_anchors_.follower =
        std::make_unique<AnchorFollower>(camera_, scene_, by_anchors_.places_in_background);
  }
  auto seen = by_anchors_.follower->Add(tracks_, last_tracked.index);
  if (!seen) return std::nullopt;
  return CameraPose{by_anchors_.follower->reference(), *std::move(seen)};
}

void Pipeline::FollowAnchors() {
  const std::optional<MarkerName> marker = tracks_.ReferenceMarker();
  if (!marker || scene_.anchors.empty()) return;
  by_anchors_.path = session::FollowAnchors(camera_, scene_, tracks_, *marker);
}

Result<void> Pipeline::FollowTrajectory(const TrajectoryRequest& request) {
  const std::optional<MarkerName> marker = tracks_.ReferenceMarker();
  static const std::vector<Observation> kNone;
  PLEINAIR_ASSIGN_OR_RETURN(
      FollowedTrajectory followed,
      session::FollowTrajectory(camera_, scene_.marker, tracks_.frame_times(),
                                marker ? tracks_.TrackOf(*marker) : kNone, Path(), request));
  by_anchors_.path.observations = std::move(followed.observations);
  by_anchors_.path.trajectory = std::move(followed.summary);
  return {};
}

std::optional<MarkerName> Pipeline::PathMarker() const {
  if (auto marker = tracks_.ReferenceMarker()) return marker;
  if (Path().empty()) return std::nullopt;
  return MarkerName{scene_.marker.family.value_or(kSgFamily), scene_.marker.id.value_or(0)};
}

const std::vector<Observation>& Pipeline::Path() const {
  static const std::vector<Observation> kNone;
  if (!by_anchors_.path.observations.empty()) return by_anchors_.path.observations;
  const std::optional<MarkerName> marker = tracks_.ReferenceMarker();
  return marker ? tracks_.TrackOf(*marker) : kNone;
}

bool Pipeline::HasOutputSize(const devices::Frame& frame) const {
  return frame.rgb.width() == output_camera_.width && frame.rgb.height() == output_camera_.height;
}

void Pipeline::Resize(devices::Frame* frame) const {
  if (!HasOutputSize(*frame)) ResizeInto(*frame, &frame->rgb, &frame->deep);
}

void Pipeline::ResizeInto(const devices::Frame& frame, RgbImage* rgb, DeepImage* deep) const {
  const int width = output_camera_.width, height = output_camera_.height;
  if (frame.deep.empty()) {
    *rgb = devices::ResizeRgb(frame.rgb.view(), width, height);
    return;
  }
  *deep = devices::ResizeDeep(frame.deep.view(), width, height);
  *rgb = devices::RoundedTo8Bits(*deep);
}

bool Pipeline::MeterLightOn(const MarkerName& marker) {
  if (metered_marker_ == marker) return false;
  renderer_->SetMarkerReflectance(MarkerReflectanceOf(scene_.marker, marker));
  metered_marker_ = marker;
  return true;
}

Result<ComposedFrame> Pipeline::Compose(CameraImageView image,
                                        const std::optional<CameraPose>& pose, UtcTime time) {
  return Compose(image, pose, time, pose ? FollowedIn(pose->observation) : FollowedLight{});
}

Result<ComposedFrame> Pipeline::Compose(CameraImageView image,
                                        const std::optional<CameraPose>& pose, UtcTime time,
                                        const FollowedLight& followed) {
  ComposedFrame composed;
  composed.pose = pose;
  if (!pose) {
    composed.image = CopyImage(image.rgb());
    return composed;
  }
  MeterLightOn(pose->marker);
  const Observation& seen = pose->observation;
  compositor::MarkerVisibility visibility;
  if (hands_in_front_) visibility = VisibilityOf(scene_.marker, pose->marker, seen);
  renderer_->UseLensOf(seen.frame_index);
  renderer_->UseMotion(seen.frame_index, pose->motion, pose->exposure_s);
  PLEINAIR_ASSIGN_OR_RETURN(
      composed.image, renderer_->Render(image, seen.camera_from_marker, time, visibility, followed,
                                        ShowsReferenceMarker(seen)));
  if (!renderer_->DrawsObjects()) return composed;
  composed.light = renderer_->light();
  composed.times = renderer_->times();
  return composed;
}

Result<ComposedFrame> Pipeline::Advance(CameraImageView image,
                                        const std::optional<CameraPose>& pose, UtcTime time) {
  ComposedFrame advanced;
  advanced.pose = pose;
  if (!pose) return advanced;
  MeterLightOn(pose->marker);
  const Observation& seen = pose->observation;
  renderer_->UseLensOf(seen.frame_index);
  renderer_->UseMotion(seen.frame_index, pose->motion, pose->exposure_s);
  PLEINAIR_RETURN_IF_ERROR(renderer_->Advance(image, seen.camera_from_marker, time,
                                              FollowedIn(seen), ShowsReferenceMarker(seen)));
  if (!renderer_->DrawsObjects()) return advanced;
  advanced.light = renderer_->light();
  advanced.times = renderer_->times();
  return advanced;
}

FollowedLight Pipeline::FollowedIn(const Observation& seen) const {
  const LightFollower* follower = renderer_->light_follower();
  if (!follows_light_ || follower == nullptr) return {};
  if (ShowsReferenceMarker(seen)) return follower->Of(seen.frame_index);
  // The light is known where the marker is seen; the nearest such frame counts.
  const std::optional<MarkerName> marker = tracks_.ReferenceMarker();
  if (!marker) return {};
  const std::vector<Observation>& track = tracks_.TrackOf(*marker);
  const auto nearest =
      std::min_element(track.begin(), track.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.frame_index - seen.frame_index) <
               std::abs(b.frame_index - seen.frame_index);
      });
  return nearest == track.end() ? FollowedLight{} : follower->Of(nearest->frame_index);
}

UtcTime Pipeline::MomentOf(std::int64_t timestamp_ns) const {
  return UtcTime(scene_.place_time.start.nanoseconds_since_1970() + timestamp_ns);
}

}  // namespace pleinair::session
