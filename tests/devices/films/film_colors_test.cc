#include "devices/films/film_colors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/srgb.h"
#include "devices/recordings/video_file.h"
#include "tests/devices/films/made_film.h"
#include "tests/devices/films/shown_frames.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::HasSubstr;
using tests::MadeFilm;

// Everything below goes the other way than the code under test: from light to the film's signal, by
// the standards' forward equations and printed matrices.

/// Linear light in Rec.709 primaries, SDR white 1.
const std::vector<Vec3> kPatches{{1, 1, 1},       {0.18, 0.18, 0.18}, {0.02, 0.02, 0.02},
                                 {0.6, 0.1, 0.1}, {0.1, 0.5, 0.15},   {0.05, 0.1, 0.6},
                                 {0.7, 0.6, 0.1}, {0.2, 0.2, 0.05}};

struct ColorCase {
  const char* name;
  int primaries, transfer, matrix;
  bool full_range;
  const char* encoder;
  const char* pixels;
  int depth;
  int tagged_matrix;  // 2: not stated.
};

Mat3 FilmFromRec709(int primaries) {
  // BT.2087-0, M2; Display P3 from sRGB (CSS Color 4).
  if (primaries == 9) {
    return {{0.62740, 0.32930, 0.04330, 0.06910, 0.91950, 0.01140, 0.01640, 0.08800, 0.89560}};
  }
  if (primaries == 12) {
    return {{0.82246, 0.17754, 0.0, 0.03319, 0.96681, 0.0, 0.01708, 0.07240, 0.91052}};
  }
  return {};
}

double Signal(double light, int transfer) {
  switch (transfer) {
    case 18: {  // HLG: 75 % at 1.
      const double e = light * (std::exp((0.75 - 0.55991073) / 0.17883277) + 0.28466892) / 12.0;
      return e <= 1.0 / 12.0 ? std::sqrt(3 * e)
                             : 0.17883277 * std::log(12 * e - 0.28466892) + 0.55991073;
    }
    case 16: {  // PQ: 203 cd/m² at 1, by the OOTF.
      const double white = std::pow((std::pow(2.03, 1 / 2.4) + 0.099) / 1.099, 1 / 0.45);
      const double e = light * white;  // 59.5208 E.
      const double e709 = e > 0.018 ? 1.099 * std::pow(e, 0.45) - 0.099 : 4.5 * e;
      const double y = std::pow(100 * std::pow(e709, 2.4) / 10'000, 0.1593017578125);
      return std::pow((0.8359375 + 18.8515625 * y) / (1 + 18.6875 * y), 78.84375);
    }
    case 4:
      return std::pow(light, 1 / 2.2);
    case 13:
    case 2:
      return SrgbFromLinear(light);
    default:
      return light < 0.018 ? 4.5 * light : 1.099 * std::pow(light, 0.45) - 0.099;
  }
}

std::array<int, 3> Codes(Vec3 light, const ColorCase& film) {
  const Vec3 own = FilmFromRec709(film.primaries) * light;
  const double r = Signal(own.x, film.transfer), g = Signal(own.y, film.transfer),
               b = Signal(own.z, film.transfer);
  double kr = 0.299, kb = 0.114;
  if (film.matrix == 1) kr = 0.2126, kb = 0.0722;
  if (film.matrix == 9) kr = 0.2627, kb = 0.0593;
  const double y = kr * r + (1 - kr - kb) * g + kb * b;
  const double u = (b - y) / (2 * (1 - kb)), v = (r - y) / (2 * (1 - kr));
  const double unit = 1 << (film.depth - 8), peak = (1 << film.depth) - 1;
  const auto round = [&](double value) {
    return static_cast<int>(std::lround(std::clamp(value, 0.0, peak)));
  };
  if (film.full_range) {
    return {round(y * peak), round(u * peak + 128 * unit), round(v * peak + 128 * unit)};
  }
  return {round((219 * y + 16) * unit), round((224 * u + 128) * unit),
          round((224 * v + 128) * unit)};
}

TEST(FilmColors, LightOfEveryKindOfFilmIsRead) {
  const ColorCase cases[] = {{"sRGB, 601", 1, 13, 6, false, "libx264", "yuv420p", 8, 6},
                             {"601 by its rows", 1, 1, 6, false, "libx264", "yuv420p", 8, 2},
                             {"709", 1, 1, 1, false, "libx264", "yuv420p", 8, 1},
                             {"709, full", 1, 1, 1, true, "libx264", "yuv420p", 8, 1},
                             {"gamma 2.2", 1, 4, 1, false, "libx264", "yuv420p", 8, 1},
                             {"709 in 10 bits", 1, 1, 1, false, "libx264", "yuv420p10le", 10, 1},
                             {"P3, 709", 12, 1, 1, false, "libx265", "yuv420p10le", 10, 1},
                             {"2020 SDR", 9, 14, 9, false, "libx265", "yuv420p10le", 10, 9},
                             {"HLG", 9, 18, 9, false, "libx265", "yuv420p10le", 10, 9},
                             {"HLG, full", 9, 18, 9, true, "libx265", "yuv420p10le", 10, 9},
                             {"HLG 4:2:2", 9, 18, 9, false, "libx264", "yuv422p10le", 10, 9},
                             {"PQ", 9, 16, 9, false, "libx265", "yuv420p10le", 10, 9}};
  const tests::TemporaryFolder folder;
  for (const ColorCase& each : cases) {
    MadeFilm film;
    film.encoder = each.encoder;
    film.pixels = each.pixels;
    film.primaries = each.primaries;
    film.transfer = each.transfer;
    film.matrix = each.tagged_matrix;
    film.full_range = each.full_range;
    film.key_every = 1;
    film.ticks = tests::NtscTicks(static_cast<int>(kPatches.size()));
    tests::WriteFilm(folder / "film.mov", film, [&](AVFrame* frame, int i) {
      const auto codes = Codes(kPatches[i], each);
      tests::FillPlanes(frame, codes[0], codes[1], codes[2]);
    });
    const auto video = OpenVideo(folder / "film.mov", {});
    ASSERT_TRUE(video) << each.name << video.error().Message();
    const CameraResponse response = ResponseOf(video->curve);
    const auto frames = tests::ReadAll(*video->frames);
    ASSERT_EQ(frames.size(), kPatches.size());
    for (std::size_t i = 0; i < kPatches.size(); ++i) {
      const double light[] = {kPatches[i].x, kPatches[i].y, kPatches[i].z};
      for (int c = 0; c < 3; ++c) {
        const int pixel = frames[i].rgb(20, 20, c);
        // 8-bit Y'CbCr: its rounding reaches R'G'B' by up to 1.8 of 255; two steps of the encoder.
        // PQ has few steps there: one is 1.2 % of light.
        const int tolerance = each.depth == 8 ? 4 : each.transfer == 16 ? 3 : 2;
        EXPECT_NEAR(pixel, 255.0 * response.Encoded(light[c], c), tolerance)
            << each.name << ", patch " << i << ", channel " << c;
        const bool deep = each.depth > 8 || each.primaries != 1;
        ASSERT_EQ(frames[i].deep.empty(), !deep) << each.name;
        if (!deep) continue;
        EXPECT_EQ(pixel, std::lround(frames[i].deep(20, 20, c) / 257.0)) << each.name;
      }
    }
  }
}

TEST(FilmColors, AStepOfLightOf4IsAStepOf4) {
  const tests::TemporaryFolder folder;
  for (const auto& [transfer, primaries] : {std::pair(18, 9), std::pair(16, 9), std::pair(1, 1)}) {
    const ColorCase coded{"", primaries, transfer, primaries, false, "", "", 10, 0};
    MadeFilm film;
    film.encoder = "libx265";
    film.pixels = "yuv420p10le";
    film.primaries = film.matrix = primaries;
    film.transfer = transfer;
    film.key_every = 1;
    film.ticks = tests::NtscTicks(2);
    tests::WriteFilm(folder / "film.mov", film, [&](AVFrame* frame, int i) {
      const double light = i == 0 ? 0.2 : 0.8;
      const auto codes = Codes({light, light, light}, coded);
      tests::FillPlanes(frame, codes[0], codes[1], codes[2]);
    });
    const auto video = OpenVideo(folder / "film.mov", {});
    ASSERT_TRUE(video) << video.error().Message();
    const auto linear = ResponseOf(video->curve).Linear(1);
    const auto frames = tests::ReadAll(*video->frames);
    const double step = linear[frames[1].rgb(9, 9, 1)] / linear[frames[0].rgb(9, 9, 1)];
    EXPECT_NEAR(step, 4.0, 0.08) << transfer;
  }
}

TEST(FilmColors, EachStepOf10BitsIsKept) {
  const tests::TemporaryFolder folder;
  for (const auto& [transfer, primaries] : {std::pair(18, 9), std::pair(1, 1)}) {
    MadeFilm film;
    film.encoder = "ffv1";  // Keeps each value.
    film.pixels = "yuv420p10le";
    film.primaries = film.matrix = primaries;
    film.transfer = transfer;
    film.ticks = tests::NtscTicks(30);
    constexpr int kFirst = 400;
    tests::WriteFilm(folder / "film.mkv", film,
                     [](AVFrame* frame, int i) { tests::FillPlanes(frame, kFirst + i, 512, 512); });
    const auto video = OpenVideo(folder / "film.mkv", {});
    ASSERT_TRUE(video) << video.error().Message();
    const CameraResponse response = ResponseOf(video->curve);
    const auto frames = tests::ReadAll(*video->frames);
    ASSERT_EQ(frames.size(), film.ticks.size());
    for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
      const double signal = (kFirst + i - 64) / 876.0;  // ITU-T H.273, 8.3, Eq. (20).
      double code = 255.0 * signal;
      if (transfer == 18) {
        // HLG's inverse, from the signal of reference white (BT.2408).
        const auto light = [](double e) {
          return e <= 0.5 ? e * e / 3 : (std::exp((e - 0.55991073) / 0.17883277) + 0.28466892) / 12;
        };
        code = 255.0 * response.Encoded(light(signal) / light(0.75), 1);
      }
      EXPECT_NEAR(frames[i].deep(9, 9, 1) / 257.0, code, 0.05) << transfer << ", frame " << i;
      if (i == 0) continue;
      EXPECT_GT(frames[i].deep(9, 9, 1), frames[i - 1].deep(9, 9, 1) + 30);
    }
  }
}

TEST(FilmColors, WhiteIsTheLastStep) {
  struct Kind {
    const char* pixels;
    bool full_range;
    std::array<int, 3> white;
  };
  const Kind kinds[] = {
      {"yuv420p", false, {235, 128, 128}},        {"yuv420p", true, {255, 128, 128}},
      {"yuv420p10le", false, {940, 512, 512}},    {"yuv420p10le", true, {1023, 512, 512}},
      {"yuv444p12le", false, {3760, 2048, 2048}}, {"yuv444p12le", true, {4095, 2048, 2048}},
      {"gbrp10le", true, {1023, 1023, 1023}}};
  const tests::TemporaryFolder folder;
  for (const Kind& kind : kinds) {
    MadeFilm film;
    film.encoder = "ffv1";
    film.pixels = kind.pixels;
    // With other primaries 8 bits are converted, too. White is white in all of them.
    film.primaries = 12;
    film.transfer = 1;
    film.matrix = std::string(kind.pixels).starts_with("gbr") ? 0 : 1;
    film.full_range = kind.full_range;
    film.ticks = tests::NtscTicks(1);
    tests::WriteFilm(folder / "film.mkv", film, [&](AVFrame* frame, int) {
      tests::FillPlanes(frame, kind.white[0], kind.white[1], kind.white[2]);
    });
    const auto video = OpenVideo(folder / "film.mkv", {});
    ASSERT_TRUE(video) << kind.pixels << video.error().Message();
    const auto frames = tests::ReadAll(*video->frames);
    ASSERT_EQ(frames.size(), 1U);
    for (const int c : {0, 1, 2}) {
      EXPECT_GE(frames[0].deep(9, 9, c), 65'520) << kind.pixels << kind.full_range;
      EXPECT_EQ(frames[0].rgb(9, 9, c), 255) << kind.pixels << kind.full_range;
    }
  }
}

TEST(FilmColors, MonochromeFilmsAreGrey) {
  const tests::TemporaryFolder folder;
  MadeFilm film;
  film.encoder = "libx264";
  film.pixels = "gray";
  film.ticks = tests::NtscTicks(3);
  film.width = 63;
  film.height = 47;
  tests::WriteFilm(folder / "film.mkv", film,
                   [](AVFrame* frame, int) { tests::FillPlanes(frame, 126, 0, 0); });
  const auto video = OpenVideo(folder / "film.mkv", {});
  ASSERT_TRUE(video) << video.error().Message();
  const auto frames = tests::ReadAll(*video->frames);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].rgb.width(), 63);
  EXPECT_NEAR(frames[0].rgb(62, 46, 0), (126 - 16) * 255.0 / 219.0, 2);
  EXPECT_EQ(frames[0].rgb(62, 46, 0), frames[0].rgb(62, 46, 2));
}

TEST(FilmColors, WhatCannotBeReadRightIsRefusedWithTheRemedy) {
  const auto message = [](const FilmColorTags& tags) {
    const auto colors = FilmColors::Create(tags, 1080, "film.mov");
    return colors ? std::string() : colors.error().Message();
  };
  EXPECT_THAT(message({10, 1, 1}), HasSubstr("primaries number 10"));
  EXPECT_THAT(message({1, 9, 1}), HasSubstr("transfer curve number 9"));
  EXPECT_THAT(message({9, 16, 14}), HasSubstr("matrix number 14"));
  for (const int unstated : {0, 2, 3}) {
    EXPECT_THAT(message({9, unstated, 9}), HasSubstr("no transfer curve"));
  }
  EXPECT_THAT(message({1, 1, 0}), HasSubstr("matrix number 0"));
  EXPECT_THAT(message({-5, 1 << 30, 1}), HasSubstr("convert it to BT.709"));
  EXPECT_EQ(message({2, 2, 2}), "");
  EXPECT_EQ(message({0, 0, 3}), "");
}

}  // namespace
}  // namespace pleinair::devices
