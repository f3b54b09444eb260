#include "devices/images/image_file.h"

#include <zlib.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::HasSubstr;

std::string Refusal(std::string_view bytes) {
  return tests::MessageOf(InspectImage(bytes, "picture"));
}

// A PNG header of size width × height, followed only by the end chunk.
std::string PngOfSize(std::uint32_t width, std::uint32_t height) {
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16);
  for (const std::uint32_t side : {width, height}) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(side >> shift & 0xFF);
  }
  bytes += std::string("\x08\x02\0\0\0", 5);
  const auto* header = reinterpret_cast<const unsigned char*>(bytes.data()) + 12;
  const auto checksum = static_cast<std::uint32_t>(crc32(0, header, 17));
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(checksum >> shift & 0xFF);
  }
  bytes += std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  return bytes;
}

TEST(ImageFile, SizeComesFromTheHeader) {
  EXPECT_EQ(*InspectImageFile(tests::Courtyard() / "frames" / "0000.jpg"), (ImageSize{640, 480}));
  EXPECT_EQ(*InspectImageFile(tests::Courtyard() / "key" / "0036_truth.png"),
            (ImageSize{640, 480}));
  EXPECT_EQ(*InspectImage(PngOfSize(16384, 1), "p"), (ImageSize{16384, 1}));
}

TEST(ImageFile, PictureCutShortAnywhereIsRefused) {
  for (const char* name : {"frames/0000.jpg", "key/0036_objmask.png"}) {
    const std::string whole = tests::Content(tests::Courtyard() / name);
    ASSERT_TRUE(InspectImage(whole, name));
    for (std::size_t length = 1; length < whole.size(); length += whole.size() / 97 + 1) {
      EXPECT_FALSE(InspectImage(whole.substr(0, length), name)) << name << " at " << length;
    }
    EXPECT_THAT(Refusal(whole.substr(0, whole.size() - 2)), HasSubstr("is cut short"));
  }
}

TEST(ImageFile, HugePictureIsRefusedBeforeAnyMemoryIsTaken) {
  EXPECT_THAT(Refusal(PngOfSize(100'000, 100'000)), HasSubstr("100000x100000"));
  EXPECT_THAT(Refusal(PngOfSize(16'385, 1)), HasSubstr("at most 16384"));
  EXPECT_THAT(Refusal(PngOfSize(0, 480)), HasSubstr("has no pixels"));
}

TEST(ImageFile, OtherFormatsAreNotTried) {
  EXPECT_THAT(Refusal("BM012345678901234567890"), HasSubstr("neither a PNG nor a JPEG"));
  EXPECT_THAT(Refusal(""), HasSubstr("neither a PNG nor a JPEG"));
}

TEST(ImageFile, DamagedDataIsAnError) {
  const tests::TemporaryFolder folder;
  std::string bytes = tests::Content(tests::Courtyard() / "key" / "0036_truth.png");
  for (std::size_t i = 2000; i < 2100; ++i) bytes[i] = static_cast<char>(~bytes[i]);
  EXPECT_THAT(tests::MessageOf(DecodeImageFile(folder.Write("damaged.png", bytes))),
              HasSubstr("damaged.png: is damaged"));
}

TEST(ImageFile, DamageInsideAJpegIsAnErrorThatNamesIt) {
  const tests::TemporaryFolder folder;
  std::string bytes = tests::Content(tests::Courtyard() / "frames" / "0000.jpg");
  bytes.replace(bytes.size() / 2, 2, "\xFF\xD3");  // A restart marker where none belongs.
  ::testing::internal::CaptureStderr();
  const Result<DecodedImage> decoded = DecodeImageFile(folder.Write("a.jpg", bytes));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(decoded);
  EXPECT_THAT(decoded.error().Message(),
              HasSubstr("a.jpg: the image is damaged: its compressed data are corrupt"));
}

TEST(ImageFile, AJpegWithoutColorsIsDecoded) {
  const tests::TemporaryFolder folder;
  const cv::Mat grey(8, 8, CV_8UC1, cv::Scalar(90));
  cv::imwrite((folder / "grey.jpg").string(), grey);
  const Result<DecodedImage> decoded = DecodeImageFile(folder / "grey.jpg");
  ASSERT_TRUE(decoded) << decoded.error().Message();
  EXPECT_EQ(decoded->rgb(4, 4, 2), 90);
}

TEST(ImageFile, DecodesToTheBytesThatOpenCvGives) {
  const std::filesystem::path file = tests::Courtyard() / "frames" / "0007.jpg";
  const Result<DecodedImage> image = DecodeImageFile(file);
  ASSERT_TRUE(image) << image.error().Message();
  const cv::Mat bgr = cv::imread(file.string());
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  for (int y = 0; y < 480; y += 7) {
    for (int x = 0; x < 640; x += 7) {
      const auto& pixel = bgr.at<cv::Vec3b>(y, x);
      ASSERT_EQ(image->rgb(x, y, 0), pixel[2]);
      ASSERT_EQ(image->rgb(x, y, 1), pixel[1]);
      ASSERT_EQ(image->rgb(x, y, 2), pixel[0]);
      ASSERT_EQ(image->grey(x, y), grey.at<std::uint8_t>(y, x));
      // Rec. ITU-R BT.601: Y = 0.299 R + 0.587 G + 0.114 B.
      ASSERT_NEAR(image->grey(x, y), 0.299 * pixel[2] + 0.587 * pixel[1] + 0.114 * pixel[0], 0.51);
    }
  }
}

TEST(ImageFile, GreyPictureKeepsItsValuesInAllChannels) {
  const tests::TemporaryFolder folder;
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::imwrite((folder / "ramp.png").string(), ramp);
  const Result<DecodedImage> image = DecodeImageFile(folder / "ramp.png");
  ASSERT_TRUE(image) << image.error().Message();
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(image->grey(i, 0), i);
    EXPECT_EQ(image->rgb(i, 0, 0), i);
    EXPECT_EQ(image->rgb(i, 0, 2), i);
  }
}

}  // namespace
}  // namespace pleinair::devices
