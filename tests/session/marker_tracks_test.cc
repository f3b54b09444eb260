#include "session/marker_tracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pleinair::session {
namespace {

tracker::MarkerObservation Seen(int id, double x_m, const std::string& family = "tag36h11") {
  tracker::MarkerObservation observation;
  observation.detection.family = family;
  observation.detection.id = id;
  observation.pose.best.camera_from_marker.translation_m = {x_m, 0, 2};
  return observation;
}

scene::MarkerDescription Declared(std::optional<int> id,
                                  std::optional<std::string> family = "tag36h11") {
  scene::MarkerDescription marker;
  marker.family = std::move(family);
  marker.id = id;
  return marker;
}

Mat3 AboutX(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{1, 0, 0, 0, c, -s, 0, s, c}};
}

TEST(MarkerTracks, TakesTheDeclaredMarkerAsReferenceThoughAnotherIsSeenMore) {
  MarkerTracks marker_tracks(Declared(3));
  marker_tracks.AddFrame(0, 0, {Seen(3, 0), Seen(5, 1)});
  marker_tracks.AddFrame(1, 1, {Seen(5, 1)});
  ASSERT_TRUE(marker_tracks.ReferenceMarker());
  EXPECT_EQ(marker_tracks.ReferenceMarker()->id, 3);
}

TEST(MarkerTracks, GiveNoTrackToMarkersWithoutANumber) {
  tracker::MarkerObservation unread = Seen(0, 0, "sg");
  unread.detection.id.reset();
  MarkerTracks marker_tracks(Declared(std::nullopt, "sg"));
  marker_tracks.AddFrame(0, 0, {unread, unread});
  EXPECT_TRUE(marker_tracks.tracks().empty());
  EXPECT_EQ(marker_tracks.frames_with_duplicates(), 0);
}

TEST(MarkerTracks, TakesTheMarkerOfTheFamilySeenMostAsReference) {
  MarkerTracks marker_tracks(Declared(std::nullopt));
  marker_tracks.AddFrame(0, 0, {Seen(5, 1), Seen(3, 0), Seen(9, 0, "sg")});
  marker_tracks.AddFrame(1, 1, {Seen(5, 1), Seen(9, 0, "sg")});
  marker_tracks.AddFrame(2, 2, {Seen(9, 0, "sg")});
  EXPECT_EQ(marker_tracks.ReferenceMarker()->ToString(), "tag36h11_5");
  EXPECT_EQ(marker_tracks.frames(), 3);
}

TEST(MarkerTracks, TakesTheMarkerSeenMostAsReferenceWhereNoFamilyIsDeclared) {
  const std::vector<tracker::MarkerObservation> frame{Seen(5, 1), Seen(3, 0), Seen(9, 0, "sg")};
  MarkerTracks any(Declared(std::nullopt, std::nullopt)), five(Declared(5, std::nullopt));
  for (MarkerTracks* marker_tracks : {&any, &five}) {
    marker_tracks->AddFrame(0, 0, frame);
    marker_tracks->AddFrame(1, 1, {Seen(9, 0, "sg")});
  }
  EXPECT_EQ(any.ReferenceMarker()->ToString(), "sg_9");
  EXPECT_EQ(five.ReferenceMarker()->ToString(), "tag36h11_5");
}

TEST(MarkerTracks, KeepsHowMuchOfTheMarkerWasSeenAndHowItWasFound) {
  tracker::MarkerObservation half = Seen(9, 0, "sg");
  half.detection.visible_fraction = 0.5;
  half.detection.path = tracker::DetectionPath::kSurfGolay;
  MarkerTracks marker_tracks(Declared(std::nullopt, std::nullopt));
  marker_tracks.AddFrame(0, 0, {half});
  const Observation& kept = marker_tracks.TrackOf({"sg", 9}).at(0);
  EXPECT_EQ(kept.visible_fraction, 0.5);
  EXPECT_EQ(kept.path, tracker::DetectionPath::kSurfGolay);
}

TEST(MarkerTracks, HasNoReferenceWhereTheDeclaredMarkerIsNeverSeen) {
  MarkerTracks marker_tracks(Declared(4));
  marker_tracks.AddFrame(0, 0, {Seen(5, 1)});
  EXPECT_FALSE(marker_tracks.ReferenceMarker());
}

TEST(MarkerTracks, KeepsToTheNearerOfTwoMarkersOfOneNumber) {
  MarkerTracks marker_tracks(Declared(std::nullopt));
  marker_tracks.AddFrame(0, 0, {Seen(1, 0.0)});
  marker_tracks.AddFrame(1, 66'666'667, {Seen(1, 1.0), Seen(1, 0.05)});
  EXPECT_NEAR(marker_tracks.TrackOf({"tag36h11", 1})[1].camera_from_marker.translation_m.x, 0.05,
              1e-12);
  EXPECT_EQ(marker_tracks.frames_with_duplicates(), 1);
}

TEST(MarkerTracks, DoesNotFlipToTheOtherPlanarSolution) {
  MarkerTracks marker_tracks(Declared(std::nullopt));
  tracker::MarkerObservation first = Seen(1, 0.0);
  first.pose.best.camera_from_marker.rotation = AboutX(0.1);
  marker_tracks.AddFrame(0, 0, {first});
  tracker::MarkerObservation ambiguous = Seen(1, 0.0);
  ambiguous.pose.best.camera_from_marker.rotation = AboutX(-0.1);
  ambiguous.pose.alternative = ambiguous.pose.best;
  ambiguous.pose.alternative->camera_from_marker.rotation = AboutX(0.11);
  ambiguous.pose.ambiguity_ratio = 0.5;
  marker_tracks.AddFrame(1, 66'666'667, {ambiguous});
  const auto& path = marker_tracks.TrackOf({"tag36h11", 1});
  EXPECT_LT(RotationAngle(path[1].camera_from_marker.rotation, AboutX(0.11)), 1e-9);
  // An unambiguous image overrides the prediction.
  ambiguous.pose.ambiguity_ratio = 0.01;
  marker_tracks.AddFrame(2, 133'333'333, {ambiguous});
  EXPECT_LT(RotationAngle(path[2].camera_from_marker.rotation, AboutX(-0.1)), 1e-9);
}

TEST(RotationAngle, IsExactNearZeroAndNearAHalfTurn) {
  EXPECT_NEAR(RotationAngle(AboutX(0.3), AboutX(0.3 + 1e-9)), 1e-9, 1e-15);
  EXPECT_NEAR(RotationAngle(Mat3{}, AboutX(std::numbers::pi - 1e-6)), std::numbers::pi - 1e-6,
              1e-9);
}

}  // namespace
}  // namespace pleinair::session
