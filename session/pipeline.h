#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"
#include "base/image_size.h"
#include "base/utc_time.h"
#include "compositor/composer_options.h"
#include "devices/frame.h"
#include "scene/scene_description.h"
#include "session/anchors.h"
#include "session/light_options.h"
#include "session/light_summary.h"
#include "session/marker_tracks.h"
#include "session/render_times.h"
#include "tracker/observation.h"
#include "tracker/tracker.h"
#include "tracker/unmeasured_markers.h"

namespace pleinair::session {

class AnchorFollower;
class MarkerRefiner;
class SceneRenderer;
struct FollowedLight;

/// How a Pipeline tracks and composes.
struct PipelineOptions {
  compositor::ComposerOptions composer{};
  LightOptions light{};
  /// Size of composed images, pixels; nothing: the frames' own. Markers are detected at the
  /// frames' own size in any case.
  std::optional<ImageSize> image_size{};
  /// Whether MarkerRefiner refines S-G markers from all of their pixels. This takes some 20 ms per
  /// marker.
  bool refine_markers = true;
  /// How many observations of each marker are kept, for sessions without an end; nothing: all.
  std::optional<std::size_t> kept_observations{};
  /// Whether FollowIn() places anchors on another thread and goes on with their last places
  /// meanwhile (AnchorFollower). If false, it waits, so that equal frames give equal poses.
  bool places_anchors_in_background = false;
};

/// A frame whose markers are detected, but whose poses are not estimated yet.
struct FoundFrame {
  devices::Frame frame;
  tracker::UnmeasuredMarkers markers;
  std::vector<tracker::LostMarker> lost;
  std::vector<std::string> warnings;
};

/// The markers of a frame.
struct TrackedFrame {
  std::vector<tracker::MarkerObservation> observations;
  std::vector<tracker::LostMarker> lost;  ///< Tracked in earlier frames, not detected in this one.
  std::vector<std::string> warnings;      ///< For the user, about mirrored markers for example.
};

/// The pose of the camera in a frame, as an observation of the reference marker.
struct CameraPose {
  MarkerName marker;
  Observation observation;
  /// Pose of the camera some seconds after that of the frame; negative: before. Motion blur needs
  /// it; empty: unknown.
  std::function<Transform<Camera, Marker>(double seconds)> motion{};
  /// For how long the frame was exposed, as its camera reports it.
  std::optional<double> exposure_s{};
};

/// A frame with the virtual objects drawn into it.
struct ComposedFrame {
  std::optional<CameraPose> pose;     ///< Nothing if the marker was not detected.
  RgbImage image;                     ///< The unchanged frame if there is no pose.
  std::optional<LightSummary> light;  ///< Nothing if nothing was drawn.
  RenderTimes times;
};

/// Tracks the camera in a frame and composes the virtual objects into it. A frame goes in; the
/// pose, the light and the composed image come out. Replay, live sessions and users' programs share
/// this class. Frames must come in order, since each stage keeps what it learns for the next frame.
///
/// Tracking (Find, Measure, Track, PoseIn, FollowIn, tracks) may run on one thread while composing
/// (Compose, renderer) runs on another. Within each of the two, calls must not overlap, except as
/// Find() and Measure() allow.
class Pipeline {
 public:
  /// Loads the models of the scene. `camera`: the lens of the frames. Errors: an invalid marker in
  /// the scene, an unreadable model; no OpenGL 4.5 if the scene has objects (system).
  static Result<std::unique_ptr<Pipeline>> Create(const CameraModel& camera,
                                                  const scene::SceneDescription& scene,
                                                  const PipelineOptions& options = {});
  ~Pipeline();

  /// Calls Track(), FollowIn() and Compose() at MomentOf() the frame. The light is the one
  /// that the scene describes; the functions of session/recording_passes.h estimate it from the
  /// frames of a recording first. Errors: those of Track() and Compose().
  Result<ComposedFrame> Process(const devices::Frame& frame);

  /// Detects the markers of a frame, estimates their poses and adds them to tracks(). Errors: the
  /// frame and the camera have different sizes.
  Result<TrackedFrame> Track(const devices::Frame& frame);

  /// The two parts of Track(), for several frames at once and with the same results. Find() uses
  /// earlier frames and one processor; Measure() takes several frames and uses all processors. The
  /// two may run at the same time.
  Result<FoundFrame> Find(devices::Frame frame);
  std::vector<TrackedFrame> Measure(std::span<FoundFrame> found);

  /// The pose of the camera in the last tracked frame; nothing if the reference marker was not
  /// detected in it.
  std::optional<CameraPose> PoseIn(const devices::Frame& last_tracked) const;

  /// As PoseIn(), by all markers of a scene with anchors (session/anchor_follower.h), with the
  /// motion that the frames so far show. Call it once per frame, in order.
  std::optional<CameraPose> FollowIn(const devices::Frame& last_tracked);

  /// All observations of each marker so far.
  const MarkerTracks& tracks() const { return tracks_; }

  bool has_anchors() const { return !scene_.anchors.empty(); }
  /// After the last frame of a recording: finds the trajectory by all markers of a scene with
  /// anchors. Does nothing for other scenes.
  void FollowAnchors();
  /// After the last frame of a recording, and after FollowAnchors(): composes along a given
  /// trajectory from now on. Errors: those of session::FollowTrajectory().
  Result<void> FollowTrajectory(const TrajectoryRequest& request);
  /// The trajectory that ComposeFrames() draws along: that of FollowTrajectory(), that of
  /// FollowAnchors(), or the observations of the reference marker.
  const std::vector<Observation>& Path() const;
  /// How FollowAnchors() used the anchors.
  const AnchorSummary& anchor_summary() const { return by_anchors_.path.summary; }
  /// How FollowTrajectory() used the given trajectory; nothing without one.
  const std::optional<TrajectorySummary>& trajectory_summary() const {
    return by_anchors_.path.trajectory;
  }
  /// The marker in whose coordinates Path() is: the observed reference marker. If no frame shows
  /// it and a given trajectory is aligned by places, the marker that the scene describes. Nothing
  /// without any pose.
  std::optional<MarkerName> PathMarker() const;

  /// Makes this marker the light meter for the next frames. Returns true if another one was it
  /// before. Compose() does so for the marker of its pose.
  bool MeterLightOn(const MarkerName& marker);

  /// Whether the color image of a frame has the size of composed images.
  bool HasOutputSize(const devices::Frame& frame) const;
  /// Resizes the color image of a frame to the size of composed images.
  void Resize(devices::Frame* frame) const;

  /// Draws the objects with the light of `time` into an image of the size of composed images.
  /// Errors: no memory on the graphics card.
  Result<ComposedFrame> Compose(CameraImageView image, const std::optional<CameraPose>& pose,
                                UtcTime time);
  /// The same. `followed`: how the frame's light differs from the estimated one, by a live session.
  Result<ComposedFrame> Compose(CameraImageView image, const std::optional<CameraPose>& pose,
                                UtcTime time, const FollowedLight& followed);

  /// Updates all that Compose() carries to later frames, and draws nothing: the result has no
  /// image. For frames that were composed before.
  Result<ComposedFrame> Advance(CameraImageView image, const std::optional<CameraPose>& pose,
                                UtcTime time);

  /// Time at which a frame of a recording was taken: the start time of the scene plus the time
  /// stamp, nanoseconds since the start of the recording.
  UtcTime MomentOf(std::int64_t timestamp_ns) const;

  /// True if sun and sky are followed from frame to frame.
  bool FollowsLight() const { return follows_light_; }

  const scene::SceneDescription& scene() const { return scene_; }
  /// The lens of composed images.
  const CameraModel& output_camera() const { return output_camera_; }

  /// The stage that estimates the light and draws, for the programs of this project: its header is
  /// not installed.
  SceneRenderer& renderer() { return *renderer_; }

 private:
  Pipeline(const CameraModel& camera, const scene::SceneDescription& scene,
           const PipelineOptions& options);
  std::optional<CameraPose> FollowMarkersIn(const devices::Frame& last_tracked);
  void AddToTracks(const devices::Frame& frame,
                   const std::vector<tracker::MarkerObservation>& observations);
  /// `rgb` and `deep` may be those of the frame.
  void ResizeInto(const devices::Frame& frame, RgbImage* rgb, DeepImage* deep) const;
  /// Collects what a frame of a recording's first pass tells of its light.
  void ProbeLight(const devices::Frame& last_tracked);
  /// How the light of a frame differs from the estimated one.
  FollowedLight FollowedIn(const Observation& seen) const;

  /// Poses by all markers of a scene with anchors: of a whole recording, and frame by frame.
  struct ByAnchors {
    AnchoredPath path;
    std::unique_ptr<AnchorFollower> follower;
    bool places_in_background = false;
  };

  CameraModel camera_, output_camera_;  // Lenses of frames and of composed images.
  scene::SceneDescription scene_;
  bool hands_in_front_;
  bool follows_light_;
  std::optional<std::size_t> kept_observations_;
  std::unique_ptr<tracker::Tracker> tracker_;
  std::unique_ptr<MarkerRefiner> refiner_;  // Null if markers are not refined.
  MarkerTracks tracks_;
  ByAnchors by_anchors_;
  std::unique_ptr<SceneRenderer> renderer_;
  std::optional<MarkerName> metered_marker_;  // The renderer's light meter.
};

}  // namespace pleinair::session
