#include "devices/recordings/video_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <system_error>
#include <utility>

#include <opencv2/videoio.hpp>

#include "devices/images/cv_image.h"
#include "devices/recordings/video_container.h"

namespace pleinair::devices {
namespace {

constexpr const char* kWholeCopy = "get a whole copy of it";

class VideoFile : public FrameSource {
 public:
  VideoFile(std::string name, cv::VideoCapture capture, VideoMetadata facts, bool promised_exactly)
      : name_(std::move(name)),
        capture_(std::move(capture)),
        facts_(std::move(facts)),
        promised_exactly_(promised_exactly) {}

  Result<std::optional<Frame>> Next() override {
    if (at_end_) return std::nullopt;
    // Until this frame is delivered: an error ends the stream.
    at_end_ = true;
    // Frames in the file beyond the specified number are not part of the recording.
    if (promised_exactly_ && next_ == facts_.frame_count) return std::nullopt;
    cv::Mat bgr;
    try {
      if (!capture_.read(bgr) || bgr.empty()) return End();
    } catch (const std::exception& error) {
      return InputError(name_, "cannot be decoded: " + std::string(error.what()), kWholeCopy);
    }
    if (bgr.type() != CV_8UC3 || ImageSize{bgr.cols, bgr.rows} != facts_.size) {
      return InputError(name_, "changes its image size at frame " + std::to_string(next_),
                        "convert it to one size");
    }
    Frame frame;
    frame.index = next_;
    const double stamp_s = facts_.timestamps_s.empty()
                               ? next_ / *facts_.frame_rate_hz
                               : facts_.timestamps_s[static_cast<std::size_t>(next_)];
    frame.timestamp_ns = std::llround(stamp_s * 1e9);
    DecodedImage image = ImageFromBgr(bgr);
    frame.rgb = std::move(image.rgb);
    frame.grey = std::move(image.grey);
    ++next_;
    at_end_ = false;
    return frame;
  }

  std::optional<std::int64_t> FrameCount() const override {
    return facts_.frame_count ? std::optional<std::int64_t>(*facts_.frame_count) : std::nullopt;
  }

  bool CountsExactly() const override { return promised_exactly_; }

 private:
  // Checks that the end came at the expected frame.
  Result<std::optional<Frame>> End() const {
    // A container's own count is an estimate if it has no index, and edit lists hide frames of some
    // that have one. Up to two frames or 2 % may be missing before the file counts as truncated.
    const double tolerated =
        promised_exactly_ ? 0.0 : std::max(2.0, 0.02 * facts_.frame_count.value_or(0));
    if (next_ == 0 || next_ + tolerated < facts_.frame_count.value_or(0)) {
      const std::string promised =
          facts_.frame_count ? " of " + std::to_string(*facts_.frame_count) : std::string();
      return InputError(name_,
                        "is cut short or damaged: only " + std::to_string(next_) + promised +
                            " frames can be decoded",
                        kWholeCopy);
    }
    return std::nullopt;
  }

  std::string name_;
  cv::VideoCapture capture_;
  VideoMetadata facts_;
  bool promised_exactly_ = false;
  int next_ = 0;
  bool at_end_ = false;
};

// FFmpeg writes its own messages to stderr; our errors contain what the user needs.
void QuietFfmpeg() {
  static std::once_flag once;
  std::call_once(once, [] { setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", /*overwrite=*/0); });
}

Result<OpenedVideo> Open(const std::filesystem::path& file, VideoMetadata facts) {
  const std::string name = file.string();
  QuietFfmpeg();
  // An absolute path cannot be mistaken for a protocol such as "concat:".
  cv::VideoCapture capture(std::filesystem::absolute(file).string(), cv::CAP_FFMPEG);
  if (!capture.isOpened()) {
    return InputError(name, "cannot be opened as a video: no known format, or cut short",
                      "get a whole copy of it, or convert it to MP4 with H.264");
  }
  const ImageSize is{static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH)),
                     static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT))};
  if (facts.size == ImageSize{}) facts.size = is;
  if (is != facts.size) {
    return InputError(name,
                      "has " + std::to_string(is.width) + "x" + std::to_string(is.height) +
                          " pixels, but the calibration is for " +
                          std::to_string(facts.size.width) + "x" +
                          std::to_string(facts.size.height),
                      "use the calibration of this camera at this size");
  }
  if (!facts.frame_rate_hz) {
    const double rate_hz = capture.get(cv::CAP_PROP_FPS);
    if (!std::isfinite(rate_hz) || rate_hz <= 0.0 || rate_hz > 1e5) {
      return InputError(name, "does not say its frame rate",
                        "put it into a folder with a recording.json that has frame_rate_hz");
    }
    facts.frame_rate_hz = rate_hz;
  }
  const bool promised_exactly = facts.frame_count.has_value();
  if (!promised_exactly) {
    const double count = capture.get(cv::CAP_PROP_FRAME_COUNT);
    if (std::isfinite(count) && count >= 1.0 && count < 1e8) {
      facts.frame_count = static_cast<int>(count);
    }
  }
  OpenedVideo opened;
  opened.size = facts.size;
  opened.frame_rate_hz = *facts.frame_rate_hz;
  opened.frames =
      std::make_unique<VideoFile>(name, std::move(capture), std::move(facts), promised_exactly);
  return opened;
}

}  // namespace

Result<OpenedVideo> OpenVideo(const std::filesystem::path& file, const VideoMetadata& facts) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) {
    return InputError(file.string(), "cannot be read: " + error.message(), "check the name");
  }
  if (bytes == 0) return InputError(file.string(), "is empty", kWholeCopy);
  PLEINAIR_RETURN_IF_ERROR(CheckContainerIsWhole(file));
  try {
    return Open(file, facts);
  } catch (const std::exception& failure) {
    return InputError(file.string(), "cannot be opened: " + std::string(failure.what()),
                      kWholeCopy);
  }
}

}  // namespace pleinair::devices
