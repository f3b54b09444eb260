#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/films/film_curve.h"
#include "devices/films/film_facts.h"
#include "devices/frame_source.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Properties of a video that are known from outside its file.
struct VideoMetadata {
  /// Required frame size: the calibration's. 0x0: any size.
  ImageSize size;
  /// Number of frames; fewer in the file are an error, further ones are left out.
  std::optional<int> frame_count;
  /// Replaces the file's own time stamps by index / rate where it differs from the file's rate by
  /// more than 1 % (slow motion). Also the rate of files without time stamps.
  std::optional<double> frame_rate_hz;
  std::vector<double> timestamps_s;  ///< One per frame; replaces the file's time stamps.
};

struct OpenedVideo {
  std::unique_ptr<FrameSource> frames;
  double frame_rate_hz = 0.0;  ///< Typical; single intervals may differ.
  ImageSize size;              ///< As shown: turned.
  /// The container's time of the first frame, for its sound; nothing: the stamps are not the
  /// film's.
  std::optional<double> start_s;
  FilmFacts facts;
  FilmCurve curve = FilmCurve::kSrgb;  ///< Of the frames' pixel values.
};

/// Opens a video file, decoded by libavcodec. Frames have the time stamps of the file, counted from
/// the first frame that its edit list shows. Rotation and mirroring of the metadata (phones) are
/// applied, and its colors become Rec.709 primaries (FilmPictures).
///
/// All packets are read once, without decoding. The number of frames is therefore exact, and a
/// truncated MOV, MP4, Matroska or AVI file is found here. FLV and MPEG-TS do not state their
/// lengths: there, truncation is found if the file ends within a frame.
///
/// Errors:
/// - The file is missing, empty, truncated, or of a format unknown to libavformat.
/// - The size is another than that of `facts`.
/// - The rotation is no multiple of 90°, or the colors are not supported.
/// - Two frames have one time, or there is no frame rate.
///
/// Next() reports damage inside the video, or fewer frames than `frame_count`.
Result<OpenedVideo> OpenVideo(const std::filesystem::path& file, const VideoMetadata& facts);

}  // namespace pleinair::devices
