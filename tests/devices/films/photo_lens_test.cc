// Focus and aperture of photographs by their EXIF data.
#include "devices/films/photo_lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/devices/films/exif_bytes.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Fraction = std::pair<int, int>;

constexpr int kFNumber = 0x829D, kSubjectDistance = 0x9206, kFocalLength = 0x920A;

std::string Jpeg(Fraction f_number, Fraction focal_length, Fraction distance) {
  return ExifBytes::Jpeg(
      {},
      {ExifBytes::Rational(kFNumber, {f_number}), ExifBytes::Rational(kSubjectDistance, {distance}),
       ExifBytes::Rational(kFocalLength, {focal_length})},
      {});
}

TEST(PhotoLens, IsReadFromExif) {
  const std::string jpeg = Jpeg({18, 10}, {425, 100}, {6, 10});
  const PhotoLens lens = LensOfPhoto(jpeg);
  ASSERT_TRUE(lens.aperture_m && lens.focus_dioptres);
  EXPECT_NEAR(*lens.aperture_m, 4.25e-3 / 1.8, 1e-12);
  EXPECT_NEAR(*lens.focus_dioptres, 1.0 / 0.6, 1e-12);
  EXPECT_EQ(LensOfPhoto(Jpeg({18, 10}, {425, 100}, {-1, 1})).focus_dioptres, 0.0);
  // Cut anywhere: some of it, or nothing.
  for (std::size_t length = 0; length < jpeg.size(); ++length) {
    const PhotoLens part = LensOfPhoto(jpeg.substr(0, length));
    EXPECT_GT(part.aperture_m.value_or(1.0), 0.0) << length;
    EXPECT_TRUE(std::isfinite(part.focus_dioptres.value_or(0.0))) << length;
  }
}

TEST(PhotoLens, HasTheExposureOfEachImage) {
  const tests::TemporaryFolder folder;
  const auto photo = [&](const std::string& name, Fraction exposure) {
    const std::filesystem::path path = folder / name;
    constexpr int kExposureTime = 0x829A;
    std::ofstream(path, std::ios::binary)
        << ExifBytes::Jpeg({}, {ExifBytes::Rational(kExposureTime, {exposure})}, {});
    return path;
  };
  const auto short_one = photo("0.jpg", {1, 250}), long_one = photo("1.jpg", {1, 60});
  EXPECT_THAT(LensOfPhotos(std::vector{short_one, long_one})->exposure_s,
              ElementsAre(1.0 / 250, 1.0 / 60));
  EXPECT_THAT(LensOfPhotos(std::vector{long_one, long_one})->exposure_s, ElementsAre(1.0 / 60));
  EXPECT_FALSE(LensOfPhotos(std::vector{photo("2.jpg", {1, 0})}));
  EXPECT_FALSE(LensOfPhotos(std::vector{photo("3.jpg", {0, 100})}));
}

TEST(PhotoLens, LeavesOutWhatCannotBeTrue) {
  EXPECT_FALSE(LensOfPhoto("no image").aperture_m);
  const PhotoLens hostile = LensOfPhoto(Jpeg({0, 0}, {425, 100}, {5, 0}));
  EXPECT_FALSE(hostile.aperture_m);
  EXPECT_FALSE(hostile.focus_dioptres);
  EXPECT_FALSE(LensOfPhoto(Jpeg({0, 1}, {425, 100}, {0, 1})).aperture_m);
  EXPECT_FALSE(LensOfPhoto(Jpeg({2, 1}, {425, 100}, {0, 1})).focus_dioptres);
  // Nearer than the focal length.
  EXPECT_FALSE(LensOfPhoto(Jpeg({2, 1}, {50, 1}, {4, 100})).focus_dioptres);
}

TEST(PhotoLens, OfASequenceHasAFocusForEachImage) {
  const tests::TemporaryFolder folder;
  const auto file = [&](const std::string& name, const std::string& bytes) {
    const std::filesystem::path path = folder / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  };
  const auto near = file("0.jpg", Jpeg({2, 1}, {4, 1}, {1, 2}));
  const auto far = file("1.jpg", Jpeg({2, 1}, {4, 1}, {2, 1}));
  const auto other = file("2.jpg", "no image");
  const auto lens = LensOfPhotos(std::vector{near, far});
  ASSERT_TRUE(lens && lens->aperture_m);
  EXPECT_NEAR(*lens->aperture_m, 2e-3, 1e-12);
  EXPECT_THAT(lens->focus_dioptres, ElementsAre(2.0, 0.5));
  EXPECT_THAT(LensOfPhotos(std::vector{far, far})->focus_dioptres, ElementsAre(0.5));
  EXPECT_THAT(LensOfPhotos(std::vector{near, other})->focus_dioptres, IsEmpty());
  EXPECT_FALSE(LensOfPhotos(std::vector{other}));
}

}  // namespace
}  // namespace pleinair::devices
