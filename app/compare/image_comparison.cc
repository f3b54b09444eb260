#include "app/compare/image_comparison.h"

#include <fmt/format.h>

#include <utility>

#include "devices/images/image_file.h"
#include "export/images/image_writer.h"

namespace pleinair::app {
namespace {

constexpr int kJpegQuality = 88;

Result<RgbImage> ReadPicture(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(devices::DecodedImage picture, devices::DecodeImageFile(file));
  return std::move(picture.rgb);
}

Result<Image<std::uint8_t>> ReadRegion(const std::filesystem::path& file, const RgbImage& truth) {
  if (file.empty()) return Image<std::uint8_t>();
  PLEINAIR_ASSIGN_OR_RETURN(devices::DecodedImage picture, devices::DecodeImageFile(file));
  if (picture.grey.width() != truth.width() || picture.grey.height() != truth.height()) {
    return InputError(file.string(), "is not of the ground-truth image's size", "fetch it again");
  }
  return std::move(picture.grey);
}

}  // namespace

Result<ComparedPicture> ComparePicture(const std::filesystem::path& pictures,
                                       const GroundTruthImage& of, int jpeg_width_px) {
  PLEINAIR_ASSIGN_OR_RETURN(const auto file, FindPicture(pictures, of.name));
  PLEINAIR_ASSIGN_OR_RETURN(const RgbImage picture, ReadPicture(file));
  PLEINAIR_ASSIGN_OR_RETURN(const RgbImage truth, ReadPicture(of.truth));
  if (picture.width() != truth.width() || picture.height() != truth.height()) {
    return InputError(file.string(),
                      fmt::format("has {}x{} pixels, the ground-truth image {}x{}", picture.width(),
                                  picture.height(), truth.width(), truth.height()),
                      "replay without --size");
  }
  PictureRegions regions;
  PLEINAIR_ASSIGN_OR_RETURN(regions.object, ReadRegion(of.object, truth));
  PLEINAIR_ASSIGN_OR_RETURN(regions.shadow, ReadRegion(of.shadow, truth));
  ComparedPicture compared;
  compared.name = of.name;
  compared.scores = ScorePicture(picture.view(), truth.view(), regions);
  if (jpeg_width_px > 0) {
    const auto encode = [&](const RgbImage& image) {
      return exports::EncodeJpeg(image.view(), jpeg_width_px, kJpegQuality);
    };
    compared.truth_jpeg = encode(truth);
    compared.picture_jpeg = encode(picture);
    compared.difference_jpeg = encode(DifferencePicture(picture.view(), truth.view()));
  }
  return compared;
}

}  // namespace pleinair::app
