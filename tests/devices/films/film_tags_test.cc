#include "devices/films/film_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/recordings/video_file.h"
#include "tests/devices/films/exif_bytes.h"
#include "tests/devices/films/made_film.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The examples of ISO 6709:2008, H.6: Mount Everest in its three forms, and the Statue of Liberty.
TEST(FilmTags, PlacesOfIso6709AreRead) {
  for (const char* text : {"+27.5916+086.5640+8850CRSWGS_84/", "+2735.496+08633.84+8850/",
                           "+273529.76+0863350.4+8850/"}) {
    const auto place = ParseIso6709(text);
    ASSERT_TRUE(place) << text;
    EXPECT_NEAR(place->latitude_deg, 27.5916, 1e-4);
    EXPECT_NEAR(place->longitude_deg, 86.5640, 1e-4);
    EXPECT_EQ(place->height_m, 8850.0);
  }
  const auto south = ParseIso6709("-33.8688-151.2093/");
  ASSERT_TRUE(south);
  EXPECT_NEAR(south->latitude_deg, -33.8688, 1e-9);
  EXPECT_NEAR(south->longitude_deg, -151.2093, 1e-9);
  EXPECT_FALSE(south->height_m);
  for (const char* text : {"", "+", "50.1+14.4/", "+91+000/", "+50+181/", "+50.1", "+5061+01400/",
                           "+nan+nan/", "+5+014/", "+500505050505+014/", "+50.0.1+014/"}) {
    EXPECT_FALSE(ParseIso6709(text)) << text;
  }
}

TEST(FilmTags, TimesNeedAnOffset) {
  EXPECT_EQ(Rfc3339OfTag("2025-09-14T13:05:00+0200"), "2025-09-14T13:05:00+02:00");
  EXPECT_EQ(Rfc3339OfTag("2025-09-14T11:05:00.000000Z"), "2025-09-14T11:05:00.000000Z");
  for (const char* text : {"", "2025-09-14T11:05:00", "2025-13-14T11:05:00Z", "yesterday", "+0200",
                           "2025-09-14T13:05:00+9900"}) {
    EXPECT_EQ(Rfc3339OfTag(text), "") << text;
  }
}

TEST(FilmTags, ThoseOfAFileAreOffered) {
  const tests::TemporaryFolder folder;
  tests::MadeFilm film;
  film.ticks = tests::NtscTicks(4);
  film.ticks[3] += 6'000;
  film.tags = {{"com.apple.quicktime.location.ISO6709", "+50.0875+014.4213+220.0/"},
               {"com.apple.quicktime.creationdate", "2025-09-14T13:05:00+0200"},
               {"com.apple.quicktime.make", "Apple"},
               {"com.apple.quicktime.model", "iPhone 15"}};
  film.muxer_options = {{"movflags", "use_metadata_tags"}};
  film.display = {0, 1, -1, 0};
  film.sound_encoder = "aac";
  film.sound_s = 0.2;
  tests::WriteFilm(folder / "film.mov", film,
                   [](AVFrame* frame, int) { tests::FillPlanes(frame, 100, 128, 128); });
  const auto video = OpenVideo(folder / "film.mov", {});
  ASSERT_TRUE(video) << video.error().Message();
  const FilmFacts& facts = video->facts;
  ASSERT_TRUE(facts.tags.place);
  EXPECT_NEAR(facts.tags.place->latitude_deg, 50.0875, 1e-9);
  EXPECT_NEAR(facts.tags.place->longitude_deg, 14.4213, 1e-9);
  EXPECT_EQ(facts.tags.place->height_m, 220.0);
  EXPECT_EQ(facts.tags.time, "2025-09-14T13:05:00+02:00");
  EXPECT_EQ(facts.tags.camera, "Apple iPhone 15");
  EXPECT_THAT(facts.tags.rejected, IsEmpty());
  EXPECT_EQ(facts.codec, "h264");
  EXPECT_EQ(facts.sound_codec, "aac");
  EXPECT_EQ(facts.clockwise_deg, 90);
  EXPECT_FALSE(facts.is_hdr);
  EXPECT_THAT(facts.colors, HasSubstr("sRGB"));
  EXPECT_NEAR(facts.longest_interval_s, 7001 / 30'000.0, 1e-9);
  EXPECT_EQ(facts.longest_interval_after, 2);
}

TEST(FilmTags, ImpossibleOnesAreRejectedWithTheReason) {
  const FilmTags tags = TagsOfFilm({{"location", "+99.0+014.0/"}, {"creation_time", "soon\n"}});
  EXPECT_FALSE(tags.place);
  EXPECT_EQ(tags.time, "");
  EXPECT_THAT(tags.rejected, ElementsAre(HasSubstr("+99.0+014.0/"), HasSubstr("soon")));
  EXPECT_THAT(TagsOfFilm({{"creation_time", "1904-01-01T00:00:00Z"}}).rejected,
              ElementsAre(HasSubstr("unset clock")));
}

TEST(FilmTags, PhotographsHaveAPlaceAndADirection) {
  const std::string jpeg =
      ExifBytes::Jpeg({ExifBytes::Text(0x010F, "Apple"), ExifBytes::Text(0x0110, "iPhone 15")},
                      {ExifBytes::Text(0x9003, "2025:09:14 13:05:00"),
                       ExifBytes::Text(0x9011, "+02:00"),
                       {0xA405, 3, 1, ExifBytes::Number(26, 2)}},
                      {ExifBytes::Text(1, "N"),
                       ExifBytes::Rational(2, {{50, 1}, {5, 1}, {1500, 100}}),
                       ExifBytes::Text(3, "W"),
                       ExifBytes::Rational(4, {{14, 1}, {30, 1}, {0, 1}}),
                       {5, 1, 1, std::string(1, '\0')},
                       ExifBytes::Rational(6, {{220, 1}}),
                       ExifBytes::Text(16, "M"),
                       ExifBytes::Rational(17, {{34'250, 100}})});
  const FilmTags tags = TagsOfPhoto(jpeg);
  ASSERT_TRUE(tags.place);
  EXPECT_NEAR(tags.place->latitude_deg, 50.0875, 1e-9);
  EXPECT_NEAR(tags.place->longitude_deg, -14.5, 1e-9);
  EXPECT_EQ(tags.place->height_m, 220.0);
  EXPECT_EQ(tags.time, "2025-09-14T13:05:00+02:00");
  EXPECT_EQ(tags.view_heading_deg, 342.5);
  EXPECT_TRUE(tags.view_heading_is_magnetic);
  EXPECT_EQ(tags.camera, "Apple iPhone 15");
  EXPECT_EQ(tags.focal_length_35mm, 26.0);
  // Cut anywhere: some tags, or none, and no crash.
  for (std::size_t length = 0; length < jpeg.size(); ++length) {
    const FilmTags part = TagsOfPhoto(jpeg.substr(0, length));
    EXPECT_LE(std::abs(part.place.value_or(FilmTags::Place()).latitude_deg), 90.0) << length;
  }
  EXPECT_FALSE(TagsOfPhoto("no image").place);
}

}  // namespace
}  // namespace pleinair::devices
