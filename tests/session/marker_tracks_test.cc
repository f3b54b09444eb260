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

TEST(Session, AnchorsOnTheDeclaredMarkerThoughAnotherIsSeenMore) {
  Session session(Declared(3));
  session.AddFrame(0, 0, {Seen(3, 0), Seen(5, 1)});
  session.AddFrame(1, 1, {Seen(5, 1)});
  ASSERT_TRUE(session.Anchor());
  EXPECT_EQ(session.Anchor()->id, 3);
}

TEST(Session, AnchorsOnTheMarkerOfTheFamilySeenMost) {
  Session session(Declared(std::nullopt));
  session.AddFrame(0, 0, {Seen(5, 1), Seen(3, 0), Seen(9, 0, "sg")});
  session.AddFrame(1, 1, {Seen(5, 1), Seen(9, 0, "sg")});
  session.AddFrame(2, 2, {Seen(9, 0, "sg")});
  EXPECT_EQ(session.Anchor()->ToString(), "tag36h11_5");
  EXPECT_EQ(session.frames(), 3);
}

TEST(Session, AnchorsOnTheMarkerSeenMostWhereNoFamilyIsDeclared) {
  const std::vector<tracker::MarkerObservation> frame{Seen(5, 1), Seen(3, 0), Seen(9, 0, "sg")};
  Session any(Declared(std::nullopt, std::nullopt)), five(Declared(5, std::nullopt));
  for (Session* session : {&any, &five}) {
    session->AddFrame(0, 0, frame);
    session->AddFrame(1, 1, {Seen(9, 0, "sg")});
  }
  EXPECT_EQ(any.Anchor()->ToString(), "sg_9");
  EXPECT_EQ(five.Anchor()->ToString(), "tag36h11_5");
}

TEST(Session, KeepsHowMuchOfTheMarkerWasSeenAndHowItWasFound) {
  tracker::MarkerObservation half = Seen(9, 0, "sg");
  half.detection.visible_fraction = 0.5;
  half.detection.path = tracker::DetectionPath::kSurfGolay;
  Session session(Declared(std::nullopt, std::nullopt));
  session.AddFrame(0, 0, {half});
  const Observation& kept = session.Path({"sg", 9}).at(0);
  EXPECT_EQ(kept.visible_fraction, 0.5);
  EXPECT_EQ(kept.path, tracker::DetectionPath::kSurfGolay);
}

TEST(Session, HasNoAnchorWhereTheDeclaredMarkerIsNeverSeen) {
  Session session(Declared(4));
  session.AddFrame(0, 0, {Seen(5, 1)});
  EXPECT_FALSE(session.Anchor());
}

TEST(Session, KeepsToTheNearerOfTwoMarkersOfOneNumber) {
  Session session(Declared(std::nullopt));
  session.AddFrame(0, 0, {Seen(1, 0.0)});
  session.AddFrame(1, 66'666'667, {Seen(1, 1.0), Seen(1, 0.05)});
  EXPECT_NEAR(session.Path({"tag36h11", 1})[1].camera_from_marker.translation_m.x, 0.05, 1e-12);
  EXPECT_EQ(session.frames_with_duplicates(), 1);
}

TEST(Session, DoesNotFlipToTheOtherPlanarSolution) {
  Session session(Declared(std::nullopt));
  tracker::MarkerObservation first = Seen(1, 0.0);
  first.pose.best.camera_from_marker.rotation = AboutX(0.1);
  session.AddFrame(0, 0, {first});
  tracker::MarkerObservation ambiguous = Seen(1, 0.0);
  ambiguous.pose.best.camera_from_marker.rotation = AboutX(-0.1);
  ambiguous.pose.alternative = ambiguous.pose.best;
  ambiguous.pose.alternative->camera_from_marker.rotation = AboutX(0.11);
  ambiguous.pose.ambiguity_ratio = 0.5;
  session.AddFrame(1, 66'666'667, {ambiguous});
  const auto& path = session.Path({"tag36h11", 1});
  EXPECT_LT(RotationAngle(path[1].camera_from_marker.rotation, AboutX(0.11)), 1e-9);
  // Where the picture itself tells, it is believed.
  ambiguous.pose.ambiguity_ratio = 0.01;
  session.AddFrame(2, 133'333'333, {ambiguous});
  EXPECT_LT(RotationAngle(path[2].camera_from_marker.rotation, AboutX(-0.1)), 1e-9);
}

TEST(RotationAngle, IsExactNearZeroAndNearAHalfTurn) {
  EXPECT_NEAR(RotationAngle(AboutX(0.3), AboutX(0.3 + 1e-9)), 1e-9, 1e-15);
  EXPECT_NEAR(RotationAngle(Mat3{}, AboutX(std::numbers::pi - 1e-6)), std::numbers::pi - 1e-6,
              1e-9);
}

}  // namespace
}  // namespace pleinair::session
