#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::exports {

/// H.264 in MP4 (libx264, constant rate factor 18, yuv420p, BT.709 limited range). The same frames
/// give the same bytes on any number of processors: nothing of the clock goes into the file, and
/// the encoder always gets the same number of threads. A picture of odd size is padded by its
/// last column or row, because 4:2:0 needs even sizes.
class VideoWriter {
 public:
  struct Options {
    int width = 0;
    int height = 0;
    double frame_rate_hz = 0.0;  ///< NTSC rates (29.97…) are taken as the fractions they are.
  };

  /// Errors: no H.264 encoder in this machine's libavcodec (system), WriteError.
  static Result<std::unique_ptr<VideoWriter>> Create(const std::filesystem::path& file,
                                                     const Options& options);
  virtual ~VideoWriter() = default;

  /// Adds a picture shown from `timestamp_ns` on; stamps must grow, and those within a fiftieth of
  /// a frame of the regular raster are put on it.
  virtual Result<void> Add(ImageView<const std::uint8_t> rgb, std::int64_t timestamp_ns) = 0;

  /// Writes what the encoder still holds and the index. Without it the file is useless.
  virtual Result<void> Finish() = 0;

  /// "libx264", or the encoder that stands in where it is missing.
  virtual std::string encoder_name() const = 0;
};

}  // namespace pleinair::exports
