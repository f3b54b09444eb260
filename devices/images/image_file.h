#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/image.h"
#include "base/image_size.h"

namespace pleinair::devices {

/// Largest side of an image that is decoded, pixels. It limits the memory that a malicious header
/// can request to 16384² × 3 bytes.
constexpr int kMaxImageSide = 16384;

/// Size of a PNG or JPEG from its header, without decoding. Errors: neither format, truncated (no
/// IEND, no end-of-image marker), empty, sides above kMaxImageSide.
Result<ImageSize> InspectImage(std::string_view bytes, const std::string& name);

/// Size of a PNG or JPEG file.
Result<ImageSize> InspectImageFile(const std::filesystem::path& file);

/// True if a file begins as a PNG or JPEG does.
bool IsImageFile(const std::filesystem::path& file);

struct DecodedImage {
  RgbImage rgb;    ///< sRGB-encoded, as stored: no color profile is applied.
  GreyImage grey;  ///< Luma of the encoded values, ITU-R BT.601 weights as in OpenCV.
};

/// Decodes a PNG or JPEG file. Deeper images are reduced to 8 bits; alpha is dropped. An EXIF
/// orientation is not applied, because the calibration refers to the sensor's pixels. Errors: those
/// of InspectImage(), and data that cannot be decoded.
Result<DecodedImage> DecodeImageFile(const std::filesystem::path& file);

}  // namespace pleinair::devices
