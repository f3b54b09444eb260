#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::exports {

/// Metadata of a file of radiance.
struct LightFileFacts {
  double white_cd_m2 = 1.0;         ///< Luminance of the value 1 (OpenEXR's whiteLuminance).
  bool latitude_longitude = false;  ///< The whole sphere (OpenEXR's envmap).
  std::string comment;
};

/// Writes linear Rec.709 as OpenEXR: three channels of 32-bit floats, ZIP-compressed, no data that
/// varies between runs. The file appears when it is complete. Errors: as WriteError.
Result<void> WriteExr(const std::filesystem::path& file, ImageView<const float> rgb,
                      const LightFileFacts& facts);

/// Writes the same as Radiance HDR (RGBE: 8 bits and a shared exponent, within 1 % of the brightest
/// channel).
Result<void> WriteRadianceHdr(const std::filesystem::path& file, ImageView<const float> rgb);

}  // namespace pleinair::exports
