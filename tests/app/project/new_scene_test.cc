#include "app/project/new_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "app/options/place_option.h"
#include "app/project/scene_text.h"
#include "scene/scene_facts.h"

namespace pleinair::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A film with tags, on which marker 17 was seen.
Footage TaggedFilm() {
  Footage footage;
  footage.film.file = "walk.mov";
  footage.film.tags.time = "2025-09-14T13:05:00+02:00";
  footage.film.tags.place = devices::FilmTags::Place{50.0875, 14.4213, 220.0};
  footage.film.lens = AssumedLens({1920, 1080}, footage.film.tags, "walk.mov");
  footage.marker.name = {"sg", 17};
  return footage;
}

// 36 mm x 24 mm at 43.27 mm sees 45.2° along its diagonal.
TEST(AssumedLens, HasTheAngleOfViewOfItsFocalLength) {
  devices::FilmTags tags;
  tags.focal_length_35mm = 43.27;
  const KnownLens lens = AssumedLens({3000, 4000}, tags, "a.jpg");
  EXPECT_NEAR(lens.camera.fx, 5000.0, 1.0);
  EXPECT_EQ(lens.camera.fy, lens.camera.fx);
  EXPECT_EQ(lens.camera.cx, 1499.5);
  EXPECT_THAT(lens.from, HasSubstr("tags of a.jpg"));
  EXPECT_THAT(AssumedLens({64, 48}, {}, "a.jpg").from, HasSubstr("assumed"));
}

TEST(NewScene, NamesAllThatNobodyStated) {
  const auto scene = CollectScene(TaggedFilm(), {}, nullptr);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::kInput);
  EXPECT_THAT(scene.error().Message(),
              AllOf(HasSubstr("walk.mov"), HasSubstr("--size-mm, --heading, --time, --at"),
                    HasSubstr("--yes for what the tags offer (the time, the place)")));
}

TEST(NewScene, TheTrajectoryReadsBackAsItWasStated) {
  scene::TrajectoryDescription stated;
  stated.file = "site/scan \"1\"/walk.tum";
  stated.points = "places.txt";
  stated.extrinsics = "site/sensor.yaml";
  stated.format = "tum";
  stated.offset_s = -12.25;
  stated.scale = 2.0;
  stated.turn_deg = 270;
  stated.max_gap_s = 0.5;
  stated.frame_rate_hz = 29.97;
  StatedScene options;
  options.size_mm = 200.0;
  options.heading = StatedHeading{342.0, true};
  options.accepts_tags = true;
  const auto scene = CollectScene(TaggedFilm(), options, nullptr);
  const auto read = [&]() -> scene::TrajectoryDescription {
    const std::string text =
        NewSceneToml(scene.value(), "site").value() + NewTrajectoryToml(stated, "site").value();
    const auto facts = scene::ParseSceneToml(text, "site/scene.toml");
    EXPECT_TRUE(facts) << text;
    return facts && facts->trajectory ? *facts->trajectory : scene::TrajectoryDescription();
  };
  scene::TrajectoryDescription again = read();
  EXPECT_EQ(again.file, stated.file);
  EXPECT_EQ(again.points, stated.points);
  EXPECT_EQ(again.extrinsics, stated.extrinsics);
  EXPECT_EQ(again.format, stated.format);
  EXPECT_EQ(again.offset_s, stated.offset_s);
  EXPECT_EQ(again.scale, stated.scale);
  EXPECT_EQ(again.turn_deg, stated.turn_deg);
  EXPECT_EQ(again.max_gap_s, stated.max_gap_s);
  EXPECT_EQ(again.frame_rate_hz, stated.frame_rate_hz);
  stated.scale.reset();
  stated.is_scale_free = true;
  EXPECT_TRUE(read().is_scale_free);
}

TEST(NewScene, TakesTagsOnlyWhenTheyAreAcceptedAndMarksThem) {
  StatedScene stated;
  stated.size_mm = 200.0;
  stated.heading = StatedHeading{342.0, true};
  stated.accepts_tags = true;
  const auto scene = CollectScene(TaggedFilm(), stated, nullptr);
  ASSERT_TRUE(scene) << scene.error().Message();
  const auto toml = NewSceneToml(*scene, "site");
  ASSERT_TRUE(toml);
  EXPECT_THAT(*toml, AllOf(HasSubstr("\"2025-09-14T13:05:00+02:00\""),
                           HasSubstr("from the tags of walk.mov: check it"),
                           HasSubstr("heading_magnetic_deg = 342"), HasSubstr("as you stated")));
  const auto facts = scene::ParseSceneToml(*toml, "scene.toml");
  ASSERT_TRUE(facts) << facts.error().Message();
  const auto description = scene::CompleteScene(*facts, "scene.toml");
  ASSERT_TRUE(description) << description.error().Message();
  EXPECT_EQ(description->marker.size_m, 0.2);
  EXPECT_EQ(description->place_time.height_m, 220.0);
  EXPECT_EQ(description->phantoms.size(), 1U);
}

TEST(NewScene, AnswersAndAcceptedOffersMakeAScene) {
  // Mounting, size, heading, time (accepted), place, sky.
  std::istringstream answers("wall\n20 cm\n200\n337m\n\n48.1,11.6\ncloudy\n");
  std::ostringstream text;
  Questions questions(answers, text);
  const auto scene = CollectScene(TaggedFilm(), {}, &questions);
  ASSERT_TRUE(scene) << scene.error().Message();
  EXPECT_TRUE(scene->upright.value);
  EXPECT_EQ(scene->size_mm, 200.0);
  EXPECT_TRUE(scene->heading.value.is_magnetic);
  EXPECT_EQ(scene->heading.value.deg, 337.0);
  EXPECT_EQ(scene->time.value, "2025-09-14T13:05:00+02:00");
  EXPECT_THAT(scene->time.from, HasSubstr("walk.mov"));
  EXPECT_EQ(scene->place.value.latitude_deg, 48.1);
  EXPECT_EQ(scene->place.from, "as you stated");
  EXPECT_EQ(scene->sky.value, "cloudy");
  EXPECT_EQ(scene->sky.from, "as you stated");
  EXPECT_THAT(text.str(), HasSubstr("\"20 cm\" is no size of a marker"));
  const auto toml = NewSceneToml(*scene, "site");
  ASSERT_TRUE(toml);
  EXPECT_THAT(*toml, AllOf(HasSubstr("# [ground]"), Not(HasSubstr("\n[ground]"))));
}

TEST(NewScene, PlacesAndHeadingsAreRefusedUnlessTheyAreOnEarth) {
  EXPECT_EQ(ParsePlace("50.0875, 14.4213,220")->height_m, 220.0);
  for (const char* text : {"", "50", "50,", "91,0", "0,181", "50,14,1e9", "nan,nan", "1,2,3,4"}) {
    EXPECT_FALSE(ParsePlace(text)) << text;
  }
  EXPECT_FALSE(ParseHeading("342")->is_magnetic);
  for (const char* text : {"", "m", "north", "361", "nan", "1e999"}) {
    EXPECT_FALSE(ParseHeading(text)) << text;
  }
}

TEST(ChooseMarker, IsTheMostSeenAndItsBestFrameTheLargestLeastCovered) {
  const auto seen = [](const std::string& family, int id, double edge_px, double visible) {
    tracker::MarkerObservation marker;
    marker.detection.family = family;
    marker.detection.id = id;
    marker.detection.visible_fraction = visible;
    marker.detection.corners_px = {{{0, 0}, {edge_px, 0}, {edge_px, edge_px}, {0, edge_px}}};
    return marker;
  };
  FilmLook look;
  look.looked_at = {{0, {seen("sg", 17, 50, 1.0)}},
                    {5, {seen("sg", 17, 90, 0.5), seen("sg", 3, 400, 1.0)}},
                    {9, {seen("sg", 17, 60, 1.0)}}};
  const auto marker = ChooseMarker(look, std::nullopt);
  ASSERT_TRUE(marker);
  EXPECT_EQ(marker->name.id, 17);
  EXPECT_EQ(marker->best_frame, 9);
  EXPECT_EQ(marker->best_edge_px, 60.0);
  ASSERT_EQ(marker->others.size(), 1U);
  EXPECT_EQ(ChooseMarker(look, session::MarkerName{"sg", 3})->best_frame, 5);
  EXPECT_FALSE(ChooseMarker(look, session::MarkerName{"sg", 4}));
}

}  // namespace
}  // namespace pleinair::app
