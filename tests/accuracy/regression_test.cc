#include "accuracy/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "accuracy/random.h"

namespace pleinair::accuracy {
namespace {

struct Wanted {
  double corner_px = 0.05;  ///< Standard deviation of a corner's coordinate.
  double missed = 0.1;
  std::uint64_t seed = 1;
};

/// 120 frames of two sweeps, and ten of one jitter scene with its own error.
RunRecords MakeRun(const Wanted& wanted) {
  RandomStream random(wanted.seed, "run");
  RunRecords records;
  const double jitter_px = wanted.corner_px * (1.0 + random.Uniform());
  for (int i = 0; i < 130; ++i) {
    FrameRecord record{.frame = i, .name = "frame" + std::to_string(i), .detector = "ours"};
    record.sweep = i < 60 ? "distance" : i < 120 ? "angle" : "jitter";
    MarkerRecord marker;
    marker.outcome = random.Uniform() < wanted.missed ? Outcome::kMissed : Outcome::kHit;
    const double spread_px = i < 120 ? wanted.corner_px : jitter_px;
    for (Vec2& error : marker.corner_error_px) {
      error = {spread_px * random.Normal(), spread_px * random.Normal()};
    }
    marker.true_camera_from_marker.translation_m = {0, 0, 2};
    record.markers.push_back(marker);
    records.frames.push_back(record);
  }
  return records;
}

const Change* Find(const std::vector<Change>& changes, const std::string& sweep,
                   const std::string& measure) {
  for (const Change& change : changes) {
    if (change.sweep == sweep && change.measure == measure) return &change;
  }
  return nullptr;
}

TEST(Regression, FlagsCornersThatGotWorseByATwentiethOfAPixel) {
  const auto changes =
      CompareRuns(MakeRun({}), MakeRun({.corner_px = 0.085, .seed = 2}), {.detector = "ours"});
  for (const char* sweep : {"distance", "angle", "all"}) {
    const Change* corner = Find(changes, sweep, "corner_px");
    ASSERT_NE(corner, nullptr);
    EXPECT_TRUE(corner->worse) << sweep << " " << corner->p_worse;
    EXPECT_NEAR(corner->after - corner->before, 0.05, 0.02);
    EXPECT_FALSE(Find(changes, sweep, "rate")->worse);
  }
  const auto back =
      CompareRuns(MakeRun({.corner_px = 0.085, .seed = 2}), MakeRun({}), {.detector = "ours"});
  EXPECT_TRUE(Find(back, "all", "corner_px")->better);
}

TEST(Regression, FlagsMarkersThatAreNoLongerFound) {
  const auto changes =
      CompareRuns(MakeRun({}), MakeRun({.missed = 0.4, .seed = 2}), {.detector = "ours"});
  EXPECT_TRUE(Find(changes, "all", "rate")->worse);
  EXPECT_FALSE(Find(changes, "all", "corner_px")->worse);
}

TEST(Regression, FlagsFalseNumbers) {
  RunRecords after = MakeRun({});
  for (int i = 0; i < 30; ++i) after.frames[4 * i].false_numbers = 1;
  EXPECT_TRUE(
      Find(CompareRuns(MakeRun({}), after, {.detector = "ours"}), "all", "false_numbers")->worse);
}

TEST(Regression, CallsNoiseWorseAsSeldomAsItSays) {
  const RunRecords before = MakeRun({});
  int flagged_same = 0, flagged_other = 0;
  constexpr int kRepeats = 200;
  for (int i = 0; i < kRepeats; ++i) {
    const auto after = MakeRun({.seed = static_cast<std::uint64_t>(100 + i)});
    const auto any_worse = [&](double alpha, bool same_scenes) {
      for (const Change& change : CompareRuns(
               before, after, {.detector = "ours", .alpha = alpha, .same_scenes = same_scenes})) {
        if (change.worse) return true;
      }
      return false;
    };
    flagged_same += any_worse(0.001, false);
    flagged_other += any_worse(0.05, false);
    // The frames of one jitter scene are not independent. Counted as independent they would be
    // flagged.
    const auto changes = CompareRuns(before, after, {.detector = "ours", .same_scenes = false});
    EXPECT_EQ(Find(changes, "jitter", "corner_px")->pairs, 1);
  }
  EXPECT_LE(flagged_same, 1);
  EXPECT_LE(flagged_other, 0.05 * kRepeats + 3 * std::sqrt(0.05 * 0.95 * kRepeats));
}

/// Six key frames of two recordings. The error rises with the frame number and has a random part.
RunRecords MakeLight(double object_de, double random_de, std::uint64_t seed) {
  RandomStream random(seed, "light");
  RunRecords run;
  for (int i = 0; i < 6; ++i) {
    ImageRecord picture{.recording = i < 3 ? "a" : "b", .picture = std::to_string(i)};
    for (std::size_t k = 0; k < kImageMeasures.size(); ++k) {
      const bool is_object = std::string(kImageMeasures[k].name) == "dE_obj";
      picture.scores[k] =
          1.0 + 0.3 * i + (is_object ? object_de : 0.0) + random_de * random.Normal();
    }
    run.pictures.push_back(picture);
  }
  return run;
}

TEST(Regression, FlagsComposedPicturesThatGotWorseAndNotThoseThatNobodySees) {
  const RunRecords before = MakeLight(0.0, 0.0, 1);
  const auto worse = CompareRuns(before, MakeLight(0.2, 0.01, 2), {.detector = "ours"});
  ASSERT_EQ(worse.size(), kImageMeasures.size());
  const Change* object = Find(worse, "light", "dE_obj");
  ASSERT_NE(object, nullptr);
  EXPECT_TRUE(object->worse) << object->p_worse;
  EXPECT_EQ(object->pairs, 6);
  EXPECT_NEAR(object->before, 1.75, 1e-9);
  EXPECT_NEAR(object->after, 1.95, 0.02);
  EXPECT_FALSE(Find(worse, "light", "dE_shadow")->worse);
  const auto back = CompareRuns(MakeLight(0.2, 0.01, 2), before, {.detector = "ours"});
  EXPECT_TRUE(Find(back, "light", "dE_obj")->better);
  // A uniform change of a hundredth: significant but negligible.
  for (const Change& change : CompareRuns(before, MakeLight(0.01, 0.0, 1), {.detector = "ours"})) {
    EXPECT_FALSE(change.worse) << change.measure;
  }
}

TEST(Regression, FindsNothingInCommonWithOtherFrames) {
  EXPECT_TRUE(CompareRuns(MakeRun({}), {}, {.detector = "ours"}).empty());
  EXPECT_TRUE(CompareRuns(MakeRun({}), MakeRun({}), {.detector = "theirs"}).empty());
}

}  // namespace
}  // namespace pleinair::accuracy
