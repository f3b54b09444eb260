#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::exports {

/// What a file of light says about itself.
struct LightFileFacts {
  double white_cd_m2 = 1.0;         ///< Luminance of the value 1 (OpenEXR's whiteLuminance).
  bool latitude_longitude = false;  ///< The whole sphere (OpenEXR's envmap).
  std::string comment;
};

/// Linear Rec.709 as OpenEXR, three channels of 32-bit floats, ZIP-compressed; nothing that varies
/// between runs. The file appears under its name when it is complete. Errors as WriteError.
Result<void> WriteExr(const std::filesystem::path& file, ImageView<const float> rgb,
                      const LightFileFacts& facts);

/// The same as Radiance HDR (RGBE: 8 bits and a common exponent, within 1 % of the brightest
/// channel).
Result<void> WriteRadianceHdr(const std::filesystem::path& file, ImageView<const float> rgb);

}  // namespace pleinair::exports
