#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::app {

struct TargetArguments {
  std::string picture;                 ///< PNG or JPEG.
  double width_mm = 0.0;               ///< Printed width.
  std::string output;                  ///< The target file.
  std::optional<std::string> name;     ///< Default: the image's file name without its extension.
  std::optional<std::string> preview;  ///< PNG that shows the features.
  bool json = false;
};

/// Creates a target file from an image and reports its quality on `out`. Nothing is written unless
/// everything can be.
/// Errors: an image that cannot be read, is too small or has too few features; an invalid size or
/// name; files that cannot be written.
/// that is none; files that cannot be written.
Result<void> RunTarget(const TargetArguments& arguments, std::ostream& out);

/// The image with a ring around each feature of its frontal view.
RgbImage DrawTargetFeatures(const tracker::PictureTarget& target);

}  // namespace pleinair::app
