#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "devices/films/film_curve.h"
#include "export/images/copied_sound.h"

namespace pleinair::exports {

/// Writes H.264 in MP4 (libx264, constant rate factor 18, yuv420p, BT.709 matrix and primaries,
/// limited range; the transfer curve is that of the images). The same
/// frames give the same bytes on any number of processors. The file contains no time of creation,
/// and the number of encoder threads is fixed. An image of odd size is padded with its last column
/// or row, because 4:2:0 requires even sizes.
class VideoWriter {
 public:
  struct Options {
    int width = 0;
    int height = 0;
    double frame_rate_hz = 0.0;  ///< NTSC rates (29.97…) are stored as exact fractions.
    devices::FilmCurve curve = devices::FilmCurve::kSrgb;  ///< Of the images' pixel values.
    std::optional<CopiedSound> sound{};                    ///< Copied unchanged, cut to the images.
  };

  /// Errors: a film for sound that cannot be opened, no H.264 encoder in the installed libavcodec
  /// (system), WriteError.
  static Result<std::unique_ptr<VideoWriter>> Create(const std::filesystem::path& file,
                                                     const Options& options);
  virtual ~VideoWriter() = default;

  /// Adds an image displayed from `timestamp_ns` on. Time stamps must increase. Stamps within
  /// half a millisecond and a fiftieth of a frame of the regular raster are moved to it.
  virtual Result<void> Add(ImageView<const std::uint8_t> rgb, std::int64_t timestamp_ns) = 0;

  /// Writes the encoder's remaining frames and the index. Without it the file is unusable.
  virtual Result<void> Finish() = 0;

  /// Why the requested sound could not be copied, as a sentence for the user; empty: it is copied,
  /// or the film has none.
  virtual std::string why_silent() const = 0;

  /// "libx264", or its substitute if it is missing.
  virtual std::string encoder_name() const = 0;
};

}  // namespace pleinair::exports
