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
  double width_mm = 0.0;               ///< Of the picture as it is printed.
  std::string output;                  ///< The target file.
  std::optional<std::string> name;     ///< Default: the picture's file name without its ending.
  std::optional<std::string> preview;  ///< PNG that shows the features.
  bool json = false;
};

/// Makes a target file of a picture and says on `out` how good it is. Nothing is written unless all
/// can be.
/// Errors: a picture that cannot be read, is too small or has too few features; a size or a name
/// that is none; files that cannot be written.
Result<void> RunTarget(const TargetArguments& arguments, std::ostream& out);

/// The picture with a ring around each feature of its frontal view.
RgbImage DrawTargetFeatures(const tracker::PictureTarget& target);

}  // namespace pleinair::app
