#include "session/anchors.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "session/anchor_follower.h"
#include "session/marker_tracks.h"
#include "tests/session/phone_camera.h"
#include "tracker/pose/anchor_fit.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::session {
namespace {

constexpr double kFrameRate_hz = 30.0;
constexpr double kNoise_px = 0.05;

/// The reference marker lies on the ground; an anchor of another size lies turned beside it.
struct Place {
  Transform<Marker, Marker> reference_from_anchor{About(2, 0.4), {0.7, 0.2, 0.0}};
  Vec3 object_m{0.35, 0.3, 0.1};
  double size_m = 0.3, anchor_size_m = 0.25;
};

/// Somebody with a camera in the hand walks by, at two metres.
Transform<Camera, Marker> TruePose(double t_s) {
  const double sway = 2.0 * std::numbers::pi * t_s;
  const Mat3 down = About(0, -2.3 + 0.01 * std::sin(0.9 * sway));
  const Mat3 rotation = About(1, 0.1 * t_s - 0.2 + 0.008 * std::sin(1.3 * sway)) *
                        About(2, 0.01 * std::sin(0.7 * sway)) * down;
  return {rotation,
          {-0.3 - 0.05 * t_s + 0.01 * std::sin(1.1 * sway), 0.1 + 0.008 * std::sin(1.6 * sway),
           2.0 - 0.06 * t_s}};
}

tracker::MarkerObservation Seen(const CameraModel& camera, int id,
                                const Transform<Camera, Marker>& camera_from_marker, double size_m,
                                double tracker_size_m, std::mt19937* random) {
  std::normal_distribution<double> noise(0.0, kNoise_px);
  tracker::MarkerObservation observation;
  observation.detection.family = "sg";
  observation.detection.id = id;
  constexpr std::array<Vec2, 4> kCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 at = kCorners[i] * (0.5 * size_m);
    const Vec2 pixel = ProjectToPixel(camera, camera_from_marker * Point<Marker>{{at.x, at.y, 0}});
    observation.detection.corners_px[i] = pixel + Vec2{noise(*random), noise(*random)};
  }
  const auto pose = tracker::EstimatePlanarPose(
      camera, observation.detection.corners_px, tracker::IsotropicCornerCovariance(kNoise_px),
      Metres(tracker_size_m), &camera_from_marker.rotation);
  EXPECT_TRUE(pose);
  if (pose) observation.pose = *pose;
  return observation;
}

scene::SceneDescription SceneOf(const Place& place) {
  scene::SceneDescription scene;
  scene.marker.family = "sg";
  scene.marker.id = 1;
  scene.marker.size_m = place.size_m;
  scene.anchors.push_back({"sg", 2, place.anchor_size_m, {}});
  return scene;
}

/// Which markers are covered at a time.
struct Cover {
  bool reference = false, anchor = false;
};
using CoverAt = Cover (*)(double t_s);

/// `after_frame` gets the tracks after each frame, and its number.
MarkerTracks Film(const Place& place, const scene::SceneDescription& scene, double length_s,
                  CoverAt cover_at,
                  const std::function<void(const MarkerTracks&, int)>& after_frame = {}) {
  std::mt19937 random(7);
  const CameraModel camera = PhoneLens();
  MarkerTracks tracks(scene.marker);
  const int frames = static_cast<int>(length_s * kFrameRate_hz);
  for (int i = 0; i < frames; ++i) {
    const double t_s = i / kFrameRate_hz;
    const Transform<Camera, Marker> pose = TruePose(t_s);
    const Cover cover = cover_at(t_s);
    std::vector<tracker::MarkerObservation> seen;
    if (!cover.reference)
      seen.push_back(Seen(camera, 1, pose, place.size_m, place.size_m, &random));
    if (!cover.anchor) {
      seen.push_back(Seen(camera, 2, pose * place.reference_from_anchor, place.anchor_size_m,
                          place.size_m, &random));
    }
    ScaleAnchors(scene, &seen);
    tracks.AddFrame(i, std::llround(t_s * 1e9), seen);
    if (after_frame) after_frame(tracks, i);
  }
  return tracks;
}

/// Farthest that the object is drawn from its true place, in frames with poses of one source.
double LargestMove_m(const AnchoredPath& path, const Place& place, PoseSource source) {
  double largest = 0.0;
  for (const Observation& at : path.observations) {
    if (at.source != source) continue;
    const Transform<Camera, Marker> pose = TruePose(static_cast<double>(at.timestamp_ns) * 1e-9);
    const Point<Marker> object{place.object_m};
    const Vec3 drawn = (at.camera_from_marker * object).xyz;
    largest = std::max(largest, Norm(drawn - (pose * object).xyz));
  }
  return largest;
}

void ExpectTheObjectStays(const AnchoredPath& path, const Place& place) {
  for (const auto& [source, name] : {std::pair{PoseSource::kMarker, "by_marker_mm"},
                                     std::pair{PoseSource::kAnchors, "by_anchors_mm"},
                                     std::pair{PoseSource::kMotion, "by_motion_mm"}}) {
    const double largest_m = LargestMove_m(path, place, source);
    EXPECT_LT(largest_m, 0.002) << name;
    testing::Test::RecordProperty(name, std::to_string(1e3 * largest_m));
  }
}

TEST(Anchors, TheObjectStaysWhileMarkersAreCovered) {
  const Place place;
  const scene::SceneDescription scene = SceneOf(place);
  const MarkerTracks tracks = Film(place, scene, 6.0, [](double t_s) {
    const bool both = t_s > 4.0 && t_s < 4.3;
    return Cover{both || (t_s > 1.0 && t_s < 2.0), both || (t_s > 2.5 && t_s < 3.5)};
  });
  const AnchoredPath path = FollowAnchors(PhoneLens(), scene, tracks, {"sg", 1});
  EXPECT_EQ(path.observations.size(), 180U);
  ExpectTheObjectStays(path, place);
  const AnchorSummary& summary = path.summary;
  ASSERT_TRUE(summary.anchors[0].reference_from_anchor);
  EXPECT_LT(Norm(summary.anchors[0].reference_from_anchor->translation_m -
                 place.reference_from_anchor.translation_m),
            0.001);
  EXPECT_NEAR(static_cast<double>(summary.by_anchors), 29.0, 1.0);
  EXPECT_NEAR(static_cast<double>(summary.filled), 8.0, 1.0);
  EXPECT_EQ(summary.gaps, 1);
  EXPECT_NEAR(summary.longest_gap_s, 0.3, 0.04);
  const auto filled =
      std::count_if(path.observations.begin(), path.observations.end(),
                    [](const Observation& at) { return at.source == PoseSource::kMotion; });
  EXPECT_EQ(filled, summary.filled);
}

TEST(Anchors, AFewWrongCornersHardlyMoveThePose) {
  // Three placed markers; one corner is half a marker off, then another one, too.
  const CameraModel camera = PhoneLens();
  std::mt19937 random(3);
  const std::array<Transform<Marker, Marker>, 3> places{
      {{Mat3{}, {}}, {About(2, 0.4), {0.7, 0.2, 0.0}}, {About(2, -0.2), {0.3, -0.5, 0.0}}}};
  const Transform<Camera, Marker> pose = TruePose(1.0);
  std::vector<tracker::AnchorMarker> markers;
  tracker::AnchorFrame frame;
  for (std::size_t i = 0; i < places.size(); ++i) {
    constexpr double kSize_m = 0.3;
    markers.push_back({kSize_m, places[i]});
    const tracker::MarkerObservation seen =
        Seen(camera, static_cast<int>(i), pose * places[i], kSize_m, kSize_m, &random);
    frame.push_back({i, seen.detection.corners_px, kNoise_px, seen.pose.best.camera_from_marker});
  }
  const auto error_m = [&] {
    const auto fitted = tracker::FitAnchoredPose(camera, markers, frame);
    EXPECT_TRUE(fitted);
    const Point<Marker> object{Place().object_m};
    return fitted ? Norm((fitted->camera_from_reference * object).xyz - (pose * object).xyz) : 1.0;
  };
  EXPECT_LT(error_m(), 0.001);
  frame[2].corners_px[1] = frame[2].corners_px[1] + Vec2{100.0, -30.0};
  EXPECT_LT(error_m(), 0.001);
  frame[0].corners_px[2] = frame[0].corners_px[2] + Vec2{-8.0, 15.0};
  EXPECT_LT(error_m(), 0.002);
}

TEST(Anchors, TheObjectStaysWhileAFilmIsStillGoingOn) {
  const Place place;
  const scene::SceneDescription scene = SceneOf(place);
  AnchorFollower follower(PhoneLens(), scene);
  AnchoredPath path;
  Film(
      place, scene, 4.0,
      [](double t_s) {
        const bool both = t_s > 3.6 && t_s < 3.8;
        return Cover{both || (t_s > 1.0 && t_s < 2.0), both || (t_s > 2.5 && t_s < 3.5)};
      },
      [&](const MarkerTracks& tracks, int frame) {
        auto seen = follower.Add(tracks, frame);
        if (seen) path.observations.push_back(*std::move(seen));
      });
  EXPECT_EQ(path.observations.size(), 115U) << "all but those without a marker";
  const auto by_anchors =
      std::count_if(path.observations.begin(), path.observations.end(),
                    [](const Observation& at) { return at.source == PoseSource::kAnchors; });
  EXPECT_EQ(by_anchors, 29);
  for (const Observation& at : path.observations) {
    EXPECT_TRUE(at.source == PoseSource::kMarker || at.visibility_side == 0);
  }
  ExpectTheObjectStays(path, place);
}

TEST(Anchors, ArePlacedInTheBackgroundAsTheyAreAtOnce) {
  const Place place;
  const scene::SceneDescription scene = SceneOf(place);
  AnchorFollower waiting(PhoneLens(), scene), background(PhoneLens(), scene, true);
  std::optional<Observation> wanted, seen;
  int without = 0;
  Film(
      place, scene, 1.0,
      [](double t_s) {
        return Cover{t_s > 0.7, false};
      },
      [&](const MarkerTracks& tracks, int frame) {
        wanted = waiting.Add(tracks, frame);
        seen = background.Add(tracks, frame);
        // A frame that comes before the first place is known has no pose.
        for (; !seen && without < 10'000; ++without) {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          seen = background.Add(tracks, frame);
        }
      });
  ASSERT_TRUE(wanted && seen);
  EXPECT_EQ(seen->source, PoseSource::kAnchors);
  // Both have placed the anchor, by other numbers of frames.
  EXPECT_LT(Norm(seen->camera_from_marker.translation_m - wanted->camera_from_marker.translation_m),
            0.005);
}

TEST(Anchors, AnAnchorThatWasNeverSeenBesideTheMarkerGivesNoPoseLive) {
  const Place place;
  const scene::SceneDescription scene = SceneOf(place);
  AnchorFollower follower(PhoneLens(), scene);
  int poses = 0;
  Film(
      place, scene, 1.0,
      [](double t_s) {
        return Cover{t_s > 0.5, t_s < 0.52};
      },
      [&](const MarkerTracks& tracks, int frame) { poses += follower.Add(tracks, frame) ? 1 : 0; });
  EXPECT_EQ(poses, 16);
}

TEST(Anchors, LongGapsStayAndUnseenMarkersAreReported) {
  const Place place;
  scene::SceneDescription scene = SceneOf(place);
  scene.anchors.push_back({"sg", 3, 0.2, {}});
  // Never both at once: the anchor's place is not known.
  const MarkerTracks tracks = Film(place, scene, 3.0, [](double t_s) {
    return Cover{t_s > 1.0, t_s < 2.0};
  });
  const AnchoredPath path = FollowAnchors(PhoneLens(), scene, tracks, {"sg", 1});
  EXPECT_EQ(path.observations.size(), 31U);
  EXPECT_EQ(path.summary.filled, 0);
  EXPECT_FALSE(path.summary.anchors[0].reference_from_anchor);
  EXPECT_EQ(path.summary.anchors[1].frames, 0);
}

TEST(Anchors, AGivenPlaceNeedsNoFrameWithBoth) {
  const Place place;
  scene::SceneDescription scene = SceneOf(place);
  scene.anchors[0].place = scene::AnchorPlace{place.reference_from_anchor.translation_m,
                                              {0.0, 0.0, 0.4 * 180.0 / std::numbers::pi}};
  const MarkerTracks tracks = Film(place, scene, 3.0, [](double t_s) {
    return Cover{t_s > 1.4, t_s < 1.6};
  });
  const AnchoredPath path = FollowAnchors(PhoneLens(), scene, tracks, {"sg", 1});
  EXPECT_EQ(path.observations.size(), 90U);
  ExpectTheObjectStays(path, place);
  EXPECT_TRUE(path.summary.anchors[0].is_given);
}

}  // namespace
}  // namespace pleinair::session
