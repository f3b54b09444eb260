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

/// Pictures of a board, one after another.
class PictureStream {
 public:
  virtual ~PictureStream() = default;
  /// The next one; nothing at the end.
  virtual Result<std::optional<NamedPicture>> Next() = 0;
  virtual std::optional<std::int64_t> Count() const = 0;
  /// They come from a film or a camera: one shows much the same as the next.
  virtual bool is_film() const = 0;
  /// They come from a camera, which never ends by itself.
  virtual bool is_live() const { return false; }
};

/// Opens what a person named: pictures; a folder with pictures, of which a recording's `frames` is
/// one; a film; a recording's frames.pack; or a camera's URI. Only pictures may be several.
/// Errors (input): nothing there, no picture in the folder, something that cannot be read.
Result<std::unique_ptr<PictureStream>> OpenPictures(const std::vector<std::string>& sources,
                                                    const devices::FormatRequest& requested);

}  // namespace pleinair::app
