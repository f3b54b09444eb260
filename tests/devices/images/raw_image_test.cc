#include "devices/images/raw_image.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace pleinair::devices {
namespace {

using testing::HasSubstr;

RawImage Layout(PixelFormat format, int width, int height) {
  RawImage raw;
  raw.format = format;
  raw.width = width;
  raw.height = height;
  raw.stride = TightStride(format, width);
  raw.bytes.resize(SmallestSize(raw));
  return raw;
}

RawImage Noise(PixelFormat format, int width, int height) {
  RawImage raw = Layout(format, width, height);
  std::mt19937 random(7);
  for (std::uint8_t& byte : raw.bytes) byte = static_cast<std::uint8_t>(random());
  return raw;
}

int LargestDifference(const RgbImage& ours, const cv::Mat& theirs) {
  const cv::Mat mine(ours.height(), ours.width(), CV_8UC3, const_cast<std::uint8_t*>(ours.data()));
  return static_cast<int>(cv::norm(mine, theirs, cv::NORM_INF));
}

struct Bar {
  int y, cb, cr;
  int r, g, b;
};

// 75 % color bars in 8 bits as Rec. ITU-R BT.601 and BT.709 encode them (Jack, Video Demystified,
// chapter 3); 75 % of 255 is 191.
constexpr Bar kBars601[] = {{180, 128, 128, 191, 191, 191}, {162, 44, 142, 191, 191, 0},
                            {131, 156, 44, 0, 191, 191},    {112, 72, 58, 0, 191, 0},
                            {84, 184, 198, 191, 0, 191},    {65, 100, 212, 191, 0, 0},
                            {35, 212, 114, 0, 0, 191},      {16, 128, 128, 0, 0, 0}};
constexpr Bar kBars709[] = {{180, 128, 128, 191, 191, 191}, {168, 44, 136, 191, 191, 0},
                            {145, 147, 44, 0, 191, 191},    {133, 63, 52, 0, 191, 0},
                            {63, 193, 204, 191, 0, 191},    {51, 109, 212, 191, 0, 0},
                            {28, 212, 120, 0, 0, 191},      {16, 128, 128, 0, 0, 0}};

void ExpectBars(const std::vector<Bar>& bars, YuvMatrix matrix) {
  const int count = static_cast<int>(bars.size());
  RawImage raw = Layout(PixelFormat::kYuyv, 2 * count, 2);
  raw.matrix = matrix;
  for (int y = 0; y < 2; ++y) {
    for (int i = 0; i < count; ++i) {
      const Bar& bar = bars[static_cast<std::size_t>(i)];
      std::uint8_t* pair = &raw.bytes[static_cast<std::size_t>(y) * raw.stride + 4UL * i];
      pair[0] = pair[2] = static_cast<std::uint8_t>(bar.y);
      pair[1] = static_cast<std::uint8_t>(bar.cb);
      pair[3] = static_cast<std::uint8_t>(bar.cr);
    }
  }
  DecodedImage image;
  ASSERT_TRUE(ConvertRawImage(raw, &image));
  for (int x = 0; x < 2 * count; ++x) {
    const Bar& bar = bars[static_cast<std::size_t>(x / 2)];
    // The bars' values are rounded to integer Y, Cb, Cr: up to 2 in R, G, B.
    EXPECT_NEAR(image.rgb(x, 1, 0), bar.r, 2) << "column " << x;
    EXPECT_NEAR(image.rgb(x, 1, 1), bar.g, 2) << "column " << x;
    EXPECT_NEAR(image.rgb(x, 1, 2), bar.b, 2) << "column " << x;
  }
}

TEST(RawImage, GivesThePublishedColourBarsOfBt601) {
  ExpectBars({std::begin(kBars601), std::end(kBars601)}, YuvMatrix::kBt601);
}

TEST(RawImage, GivesThePublishedColourBarsOfBt709) {
  ExpectBars({std::begin(kBars709), std::end(kBars709)}, YuvMatrix::kBt709);
}

TEST(RawImage, IsWithinOneOfTheExactFormulaForEveryLumaAndChroma) {
  for (const bool full_range : {false, true}) {
    RawImage raw = Layout(PixelFormat::kYuyv, 2, 1);
    raw.full_range = full_range;
    const double luma_gain = full_range ? 1.0 : 255.0 / 219.0;
    const double chroma_gain = full_range ? 1.0 : 255.0 / 224.0;
    DecodedImage image;
    for (int y = 0; y < 256; y += 5) {
      for (int cr = 0; cr < 256; cr += 5) {
        raw.bytes = {static_cast<std::uint8_t>(y), 128, static_cast<std::uint8_t>(y),
                     static_cast<std::uint8_t>(cr)};
        ASSERT_TRUE(ConvertRawImage(raw, &image));
        const double luma = (y - (full_range ? 0 : 16)) * luma_gain;
        const double red = luma + 1.402 * chroma_gain * (cr - 128);
        ASSERT_NEAR(image.rgb(0, 0, 0), std::clamp(red, 0.0, 255.0), 1.0)
            << "Y " << y << ", Cr " << cr;
      }
    }
  }
}

struct Peer {
  PixelFormat format;
  int code;
};

TEST(RawImage, AgreesWithOpenCvOnEveryYuvLayout) {
  constexpr Peer kPeers[] = {
      {PixelFormat::kYuyv, cv::COLOR_YUV2RGB_YUYV}, {PixelFormat::kYvyu, cv::COLOR_YUV2RGB_YVYU},
      {PixelFormat::kUyvy, cv::COLOR_YUV2RGB_UYVY}, {PixelFormat::kNv12, cv::COLOR_YUV2RGB_NV12},
      {PixelFormat::kNv21, cv::COLOR_YUV2RGB_NV21}, {PixelFormat::kYuv420, cv::COLOR_YUV2RGB_I420}};
  for (const Peer& peer : kPeers) {
    RawImage raw = Noise(peer.format, 64, 48);
    const bool packed = raw.stride == 128;
    const cv::Mat wrapped(packed ? 48 : 72, 64, packed ? CV_8UC2 : CV_8UC1, raw.bytes.data());
    cv::Mat theirs;
    cv::cvtColor(wrapped, theirs, peer.code);
    DecodedImage image;
    ASSERT_TRUE(ConvertRawImage(raw, &image));
    // OpenCV clamps Y below 16 first, we clamp at the end: only very dark pixels differ by more.
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const std::size_t luma = packed ? static_cast<std::size_t>(y) * 128 + 2UL * x +
                                              (peer.format == PixelFormat::kUyvy ? 1 : 0)
                                        : static_cast<std::size_t>(y) * 64 + x;
        if (raw.bytes[luma] < 16) continue;
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(image.rgb(x, y, c), theirs.at<cv::Vec3b>(y, x)[c], 2)
              << NameOf(peer.format) << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(RawImage, ReadsPackedYuvInAnyOrderToTheSamePicture) {
  const RawImage yuyv = Noise(PixelFormat::kYuyv, 32, 8);
  DecodedImage expected;
  ASSERT_TRUE(ConvertRawImage(yuyv, &expected));
  struct Order {
    PixelFormat format;
    int from[4];
  };
  for (const Order& order :
       {Order{PixelFormat::kYvyu, {0, 3, 2, 1}}, Order{PixelFormat::kUyvy, {1, 0, 3, 2}},
        Order{PixelFormat::kVyuy, {3, 0, 1, 2}}}) {
    RawImage other = yuyv;
    other.format = order.format;
    for (std::size_t i = 0; i < yuyv.bytes.size(); i += 4) {
      for (int k = 0; k < 4; ++k) other.bytes[i + k] = yuyv.bytes[i + order.from[k]];
    }
    DecodedImage image;
    ASSERT_TRUE(ConvertRawImage(other, &image));
    const cv::Mat theirs(8, 32, CV_8UC3, expected.rgb.data());
    EXPECT_EQ(LargestDifference(image.rgb, theirs), 0) << NameOf(order.format);
  }
}

TEST(RawImage, DemosaicsFlatColorExactlyAndKeepsItsChannels) {
  // R 200, G 100, B 50 under each pattern: a wrong pattern swaps or mixes the channels.
  struct Pattern {
    PixelFormat format;
    int colors[4];
  };
  for (const Pattern& pattern : {Pattern{PixelFormat::kBayerRggb8, {200, 100, 100, 50}},
                                 Pattern{PixelFormat::kBayerBggr8, {50, 100, 100, 200}},
                                 Pattern{PixelFormat::kBayerGbrg8, {100, 50, 200, 100}},
                                 Pattern{PixelFormat::kBayerGrbg8, {100, 200, 50, 100}}}) {
    RawImage raw = Layout(pattern.format, 16, 16);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        raw.bytes[static_cast<std::size_t>(y) * 16 + x] =
            static_cast<std::uint8_t>(pattern.colors[y % 2 * 2 + x % 2]);
      }
    }
    DecodedImage image;
    ASSERT_TRUE(ConvertRawImage(raw, &image));
    for (int i = 0; i < 16; ++i) {
      EXPECT_EQ(image.rgb(i, i, 0), 200) << NameOf(pattern.format) << " " << i;
      EXPECT_EQ(image.rgb(i, i, 1), 100) << NameOf(pattern.format) << " " << i;
      EXPECT_EQ(image.rgb(i, i, 2), 50) << NameOf(pattern.format) << " " << i;
    }
  }
}

TEST(RawImage, TakesGreyAsItIsAndStretchesItOnlyWhenTheRangeIsLimited) {
  RawImage raw = Layout(PixelFormat::kGrey8, 4, 1);
  raw.bytes = {0, 16, 126, 235};
  raw.full_range = true;
  DecodedImage image;
  ASSERT_TRUE(ConvertRawImage(raw, &image));
  EXPECT_EQ(image.grey(2, 0), 126);
  EXPECT_EQ(image.rgb(2, 0, 1), 126);
  raw.full_range = false;
  ASSERT_TRUE(ConvertRawImage(raw, &image));
  EXPECT_EQ(image.grey(0, 0), 0);
  EXPECT_EQ(image.grey(1, 0), 0);
  EXPECT_NEAR(image.grey(2, 0), 128, 1);
  EXPECT_EQ(image.grey(3, 0), 255);
}

TEST(RawImage, HeedsThePaddingOfRowsAndOddSizes) {
  RawImage tight = Noise(PixelFormat::kYuv420, 15, 9);
  RawImage padded = tight;
  padded.stride = 20;
  padded.bytes.assign(SmallestSize(padded), 0xEE);
  const auto copy = [&](std::size_t from, std::size_t to, int rows, int columns,
                        std::size_t from_stride, std::size_t to_stride) {
    for (int y = 0; y < rows; ++y) {
      std::copy_n(tight.bytes.begin() + static_cast<long>(from + y * from_stride), columns,
                  padded.bytes.begin() + static_cast<long>(to + y * to_stride));
    }
  };
  copy(0, 0, 9, 15, 15, 20);
  copy(135, 180, 5, 8, 8, 10);
  copy(175, 230, 5, 8, 8, 10);
  DecodedImage one, other;
  ASSERT_TRUE(ConvertRawImage(tight, &one));
  ASSERT_TRUE(ConvertRawImage(padded, &other));
  EXPECT_EQ(LargestDifference(one.rgb, cv::Mat(9, 15, CV_8UC3, other.rgb.data())), 0);
}

std::vector<std::uint8_t> Jpeg(int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  cv::randu(image, 0, 255);
  cv::blur(image, image, {9, 9});
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes);
  return bytes;
}

RawImage Mjpeg(std::vector<std::uint8_t> bytes, int width, int height) {
  RawImage raw = Layout(PixelFormat::kMjpeg, width, height);
  raw.bytes = std::move(bytes);
  return raw;
}

TEST(MotionJpeg, DecodesAsOpenCvDoes) {
  const std::vector<std::uint8_t> bytes = Jpeg(64, 48);
  cv::Mat theirs = cv::imdecode(bytes, cv::IMREAD_COLOR);
  cv::cvtColor(theirs, theirs, cv::COLOR_BGR2RGB);
  DecodedImage image;
  ASSERT_TRUE(ConvertRawImage(Mjpeg(bytes, 64, 48), &image));
  EXPECT_LE(LargestDifference(image.rgb, theirs), 1);
}

TEST(MotionJpeg, NeedsNoHuffmanTables) {
  std::vector<std::uint8_t> bytes = Jpeg(64, 48);
  DecodedImage with, without;
  ASSERT_TRUE(ConvertRawImage(Mjpeg(bytes, 64, 48), &with));
  // OpenCV writes the standard tables (ITU-T T.81, Annex K.3). This removes their segments.
  int removed = 0;
  for (std::size_t at = 2; at + 4 < bytes.size() && bytes[at + 1] != 0xDA;) {
    const std::size_t length = 2 + bytes[at + 2] * 256UL + bytes[at + 3];
    if (bytes[at + 1] == 0xC4) {
      bytes.erase(bytes.begin() + static_cast<long>(at),
                  bytes.begin() + static_cast<long>(at + length));
      ++removed;
    } else {
      at += length;
    }
  }
  ASSERT_GT(removed, 0);
  ASSERT_TRUE(ConvertRawImage(Mjpeg(bytes, 64, 48), &without));
  EXPECT_EQ(LargestDifference(without.rgb, cv::Mat(48, 64, CV_8UC3, with.rgb.data())), 0);
}

TEST(MotionJpeg, CutAnywhereIsDamagedAndNeverACrash) {
  const std::vector<std::uint8_t> bytes = Jpeg(64, 48);
  DecodedImage image;
  for (std::size_t length = 0; length + 2 < bytes.size(); length += 7) {
    const std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<long>(length));
    const auto result = ConvertRawImage(Mjpeg(cut, 64, 48), &image);
    ASSERT_FALSE(result) << "cut at " << length << " of " << bytes.size();
    EXPECT_THAT(result.error().what, HasSubstr("damaged"));
  }
}

TEST(MotionJpeg, WithPaddingBeforeItsEndIsWhole) {
  std::vector<std::uint8_t> bytes = Jpeg(64, 48);
  bytes.insert(bytes.end() - 2, 32, 0);
  DecodedImage image;
  EXPECT_TRUE(ConvertRawImage(Mjpeg(bytes, 64, 48), &image));
}

TEST(MotionJpeg, OfAnotherSizeIsRefused) {
  DecodedImage image;
  const auto result = ConvertRawImage(Mjpeg(Jpeg(32, 24), 64, 48), &image);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().what, HasSubstr("32x24"));
}

TEST(RawImage, WithTooFewBytesIsDamagedInEveryFormat) {
  for (const PixelFormat format : kPixelFormats) {
    if (format == PixelFormat::kMjpeg) continue;
    RawImage raw = Noise(format, 32, 16);
    raw.bytes.pop_back();
    DecodedImage image;
    EXPECT_FALSE(ConvertRawImage(raw, &image)) << NameOf(format);
    EXPECT_EQ(PixelFormatByName(NameOf(format)), format);
  }
}

}  // namespace
}  // namespace pleinair::devices
