#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "devices/cameras/camera.h"

namespace pleinair::app {

struct NamedPicture {
  std::string name;
  GreyImage grey;
};

/// A sequence of images of a board.
class PictureStream {
 public:
  virtual ~PictureStream() = default;
  /// Returns the next image; nothing at the end.
  virtual Result<std::optional<NamedPicture>> Next() = 0;
  virtual std::optional<std::int64_t> Count() const = 0;
  /// True for a video or a camera: consecutive images are similar.
  virtual bool is_film() const = 0;
  /// True for a camera, which never ends by itself.
  virtual bool is_live() const { return false; }
  /// Focal length by the film's tags, for 35 mm film; nothing if it has none.
  virtual std::optional<double> FocalLength35mm() const { return std::nullopt; }
};

/// Opens the user's sources: images; a folder with images, such as `frames` of a recording; a
/// video; frames.pack of a recording; or a camera's URI. Several sources must all be images. Errors
/// (input): a missing source, a folder without images, an unreadable source.
Result<std::unique_ptr<PictureStream>> OpenPictures(const std::vector<std::string>& sources,
                                                    const devices::FormatRequest& requested);

}  // namespace pleinair::app
