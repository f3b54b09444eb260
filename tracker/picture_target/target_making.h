#pragma once

#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "base/units.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// Makes an image target from an sRGB-encoded grey image that is printed `width` wide. Takes some
/// seconds. Errors, without a location: image too small, too elongated, or with too few features
/// (too dark, too uniform); a width that is not positive; a name that a target file cannot hold.
Result<PictureTarget> MakePictureTarget(ImageView<const std::uint8_t> grey, Metres width,
                                        const std::string& name);

/// True if a target file can hold the name: 1 to kMaxTargetName bytes of UTF-8 without control
/// characters.
bool IsTargetName(const std::string& name);

}  // namespace pleinair::tracker
