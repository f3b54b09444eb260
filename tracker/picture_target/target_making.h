#pragma once

#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "base/units.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {

/// Makes a target of an sRGB-encoded grey picture that is printed `width` wide. Takes some seconds.
/// Errors, without a place: a picture too small, too long or with too few features to be found by
/// (too dark, too even), a width that is not positive, a name that a target file cannot hold.
Result<PictureTarget> MakePictureTarget(ImageView<const std::uint8_t> grey, Metres width,
                                        const std::string& name);

/// Whether a target file can hold a name: 1 to kMaxTargetName bytes of UTF-8, no control
/// characters.
bool IsTargetName(const std::string& name);

}  // namespace pleinair::tracker
