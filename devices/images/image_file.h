#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/image.h"
#include "base/image_size.h"

namespace pleinair::devices {

/// The largest side of an image that is decoded, pixels: a hostile header cannot ask for more
/// memory than 16384² × 3 bytes.
constexpr int kMaxImageSide = 16384;

/// Size of a PNG or JPEG from its header, without decoding.
/// Errors: neither of the two, cut short (no IEND, no end-of-image marker), empty, sides above
/// kMaxImageSide.
Result<ImageSize> InspectImage(std::string_view bytes, const std::string& name);

/// The same of a file.
Result<ImageSize> InspectImageFile(const std::filesystem::path& file);

struct DecodedImage {
  RgbImage rgb;    ///< sRGB-encoded, as stored: no color profile is applied.
  GreyImage grey;  ///< Luma of the encoded values, Rec. ITU-R BT.601 weights as OpenCV has them.
};

/// Decodes a PNG or JPEG file; deeper pictures are reduced to 8 bits, alpha is dropped. The pixels
/// stay as the sensor had them: an EXIF orientation is not applied, because the calibration knows
/// nothing of it.
/// Errors: those of InspectImage, and data that cannot be decoded.
Result<DecodedImage> DecodeImageFile(const std::filesystem::path& file);

}  // namespace pleinair::devices
