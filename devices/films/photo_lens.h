#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "scene/lens_description.h"

namespace pleinair::devices {

/// What a photograph states of focus, aperture and exposure.
struct PhotoLens {
  std::optional<double> focus_dioptres;  ///< 1 / SubjectDistance, 1/m; 0: infinity.
  std::optional<double> aperture_m;      ///< FocalLength / FNumber.
  std::optional<double> exposure_s;      ///< ExposureTime.
};

/// Reads it from the EXIF data of a JPEG image, or of its beginning (Exif 2.32: FNumber,
/// FocalLength, SubjectDistance, ExposureTime). What cannot be true is left out: a distance of 0 is
/// unknown by the standard, and a fraction without denominator is none.
PhotoLens LensOfPhoto(std::string_view jpeg);

/// The lens of the JPEG images of a sequence: the aperture of the first, focus and exposure of
/// each. Nothing where the first states none of them. One value where all are the same, none where
/// some state it and others do not.
std::optional<scene::LensDescription> LensOfPhotos(std::span<const std::filesystem::path> files);

}  // namespace pleinair::devices
