#include "app/output/light_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "app/output/light_csv_file.h"

namespace pleinair::app {
namespace {

using Source = compositor::FrameLight::Source;

TEST(LightCsv, HasALineForEachFrame) {
  const std::vector<LightRow> rows{
      {3, 250'000'000, {0.5, 0.4, 0.3}, {0.1, 0.1, 0.1}, 0.0625, Source::kSurfaces},
      {4, 500'000'000, {0.0, 0.0, 0.0}, {0.2, 0.2, 0.2}, 0.5, Source::kTotalOnly}};
  // 0.2126 · 0.5 + 0.7152 · 0.4 + 0.0722 · 0.3 = 0.41404, over 0.1.
  EXPECT_EQ(LightCsv(rows),
            "frame,timestamp_s,sun_r,sun_g,sun_b,sky_r,sky_g,sky_b,sun_to_sky,sun_to_sky_error,"
            "source\n"
            "3,0.250000,0.5,0.4,0.3,0.1,0.1,0.1,4.1404,0.0625,surfaces\n"
            "4,0.500000,0,0,0,0.2,0.2,0.2,0,0.5,total only\n");
}

TEST(LightCsv, InterpolatesFramesWithoutAPose) {
  const std::vector<LightRow> rows{{1, 100, {1, 1, 1}, {2, 2, 2}, 0.1, Source::kSurfaces},
                                   {3, 300, {0.25, 0.25, 0.25}, {2, 2, 2}, 0.2, Source::kColors}};
  const std::vector<std::pair<std::int64_t, std::int64_t>> frames{
      {0, 0}, {1, 100}, {2, 200}, {3, 300}, {4, 400}};
  const std::vector<LightRow> all = WithMissingFrames(rows, frames);
  ASSERT_EQ(all.size(), 5U);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(all[i].frame_index, i);
  EXPECT_EQ(all[0].sun.g, 1.0) << "that of the first";
  EXPECT_NEAR(all[2].sun.g, 0.5, 1e-12) << "the geometric mean";
  EXPECT_EQ(all[2].source, Source::kHeld);
  EXPECT_EQ(all[2].sun_to_sky_error, 0.2);
  EXPECT_EQ(all[4].sun.g, 0.25) << "that of the last";
  EXPECT_EQ(all[3].source, Source::kColors);
  EXPECT_TRUE(WithMissingFrames({}, frames).empty());
}

TEST(LightCsv, IsReadAsItWasWritten) {
  const std::vector<LightRow> rows{
      {3, 250'000'000, {0.5, 0.4, 0.3}, {0.1, 0.1, 0.1}, 0.0625, Source::kSurfaces},
      {4, 500'000'000, {0.0, 0.0, 0.0}, {0.2, 0.2, 0.2}, 0.5, Source::kTotalOnly}};
  const auto read = ParseLightCsv(LightCsv(rows), "light.csv");
  ASSERT_TRUE(read) << read.error().Message();
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->at(0).timestamp_ns, 250'000'000);
  EXPECT_EQ(read->at(0).sun, rows[0].sun);
  EXPECT_EQ(read->at(1).sky, rows[1].sky);
  EXPECT_EQ(read->at(1).source, Source::kTotalOnly);
  EXPECT_EQ(LightCsv(*read), LightCsv(rows));
}

TEST(LightCsv, OfOthersIsRefusedWithItsLine) {
  const std::string good = LightCsv({{3, 250, {1, 1, 1}, {1, 1, 1}, 0.1, Source::kHeld}});
  const auto refusal = [](const std::string& text) {
    const auto read = ParseLightCsv(text, "light.csv");
    return read ? std::string("no error") : read.error().Message();
  };
  const auto with = [&](const char* from, const char* to) {
    std::string text = good;
    return refusal(text.replace(text.find(from), std::string(from).size(), to));
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(refusal(good), "no error");
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(with("sky_g", "green"), HasSubstr("column sky_g is missing"));
  EXPECT_THAT(with("held", "moon"), HasSubstr("light.csv:2: the source \"moon\" is unknown"));
  EXPECT_THAT(with("3,0", "-3,0"), HasSubstr("light.csv:2: frame is not a possible number"));
  EXPECT_THAT(refusal(good + good.substr(good.find('\n') + 1)), HasSubstr("does not rise"));
}

}  // namespace
}  // namespace pleinair::app
