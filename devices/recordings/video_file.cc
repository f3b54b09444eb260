#include "devices/recordings/video_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

extern "C" {
#include <libavutil/display.h>
}

#include <opencv2/imgproc.hpp>

#include "devices/films/display_turn.h"
#include "devices/films/film_colors.h"
#include "devices/films/film_decoder.h"
#include "devices/films/film_demuxer.h"
#include "devices/films/film_picture.h"
#include "devices/films/film_stamps.h"
#include "devices/films/frame_tables.h"
#include "devices/films/video_container.h"
#include "files/text_file.h"

namespace pleinair::devices {
namespace {

constexpr const char* kWholeCopy = "get a whole copy of it";

GreyImage GreyOf(const RgbImage& rgb) {
  GreyImage grey(rgb.width(), rgb.height(), 1);
  // OpenCV does not write through the const matrix.
  const cv::Mat source(rgb.height(), rgb.width(), CV_8UC3, const_cast<std::uint8_t*>(rgb.data()));
  cv::Mat target(rgb.height(), rgb.width(), CV_8UC1, grey.data());
  cv::cvtColor(source, target, cv::COLOR_RGB2GRAY);
  return grey;
}

/// When each frame of a video is shown.
struct FrameTimes {
  FilmStamps stored;
  std::optional<double> rate_hz;     ///< Replaces the stored stamps.
  std::vector<double> timestamps_s;  ///< Replace both; empty: none.
  std::size_t frames = 0;

  bool HasStored() const { return timestamps_s.empty() && !rate_hz; }

  std::int64_t Nanoseconds(std::size_t frame) const {
    if (!timestamps_s.empty()) return std::llround(timestamps_s.at(frame) * 1e9);
    if (rate_hz) return std::llround(static_cast<double>(frame) / *rate_hz * 1e9);
    return stored.Nanoseconds(frame);
  }
};

class VideoFile : public FrameSource {
 public:
  VideoFile(FilmDecoder decoder, FilmPictures pictures, FrameTimes times, ImageSize stored_size)
      : decoder_(std::move(decoder)),
        pictures_(std::move(pictures)),
        times_(std::move(times)),
        stored_size_(stored_size) {}

  Result<std::optional<Frame>> Next() override {
    if (at_end_) return std::nullopt;
    // Until this frame is delivered: an error ends the stream.
    at_end_ = true;
    if (std::max(next_, wanted_) >= times_.frames) return std::nullopt;
    SeekTowards(wanted_);
    for (;;) {
      PLEINAIR_ASSIGN_OR_RETURN(const AVFrame* const decoded, decoder_.Next());
      if (decoded == nullptr) return End();
      PLEINAIR_ASSIGN_OR_RETURN(const std::size_t index, IndexOf(*decoded));
      next_ = index + 1;
      if (index < wanted_) continue;
      if (index > wanted_ && sought_) {
        // The container led behind the wanted frame: decode from the start instead.
        if (!decoder_.SeekToStart()) return Damaged(wanted_, "cannot be reached");
        sought_ = false;
        next_ = 0;
        continue;
      }
      // A film that was cut between key frames may begin behind the recording's last frame.
      if (index >= times_.frames) return std::nullopt;
      PLEINAIR_ASSIGN_OR_RETURN(Frame frame, Deliver(*decoded, index));
      wanted_ = next_;
      sought_ = false;
      at_end_ = false;
      return frame;
    }
  }

  void SkipTo(std::int64_t index) override {
    if (index > 0) wanted_ = std::max(wanted_, static_cast<std::size_t>(index));
  }

  std::optional<std::int64_t> FirstFrameFrom(std::int64_t timestamp_ns) const override {
    std::size_t frame = 0;
    while (frame < times_.frames && times_.Nanoseconds(frame) < timestamp_ns) ++frame;
    return static_cast<std::int64_t>(frame);
  }

  std::optional<std::int64_t> FrameCount() const override {
    return static_cast<std::int64_t>(times_.frames);
  }

 private:
  // Goes to the key frame before a frame of the recording, if it lies ahead.
  void SeekTowards(std::size_t frame) {
    if (frame <= next_ || !times_.stored.are_stored()) return;
    const auto entry = times_.stored.EntryFor(frame);
    if (!entry || entry->frame <= next_) return;
    sought_ = decoder_.Seek(entry->ticks);
    if (!sought_ && decoder_.SeekToStart()) next_ = 0;
  }

  Result<std::size_t> IndexOf(const AVFrame& decoded) const {
    if (!times_.stored.are_stored()) return next_;
    const std::optional<std::size_t> index = times_.stored.FrameAt(decoded.best_effort_timestamp);
    if (!index) return Damaged(next_, "has a time that no packet gave it");
    if (sought_) return *index;
    // Frames before the first that can be decoded: a film that was cut between key frames.
    const bool starts_late = next_ == 0;
    if (*index == next_ || starts_late) return *index;
    return Damaged(next_, "cannot be decoded");
  }

  Result<Frame> Deliver(const AVFrame& decoded, std::size_t index) {
    if (ImageSize{decoded.width, decoded.height} != stored_size_) {
      return InputError(decoder_.demuxer().name(),
                        "changes its image size at frame " + std::to_string(index),
                        "convert it to one size");
    }
    if (decoded.decode_error_flags != 0 || (decoded.flags & AV_FRAME_FLAG_CORRUPT) != 0) {
      return Damaged(index, "cannot be decoded without errors");
    }
    Frame frame;
    frame.index = static_cast<std::int64_t>(index);
    frame.timestamp_ns = times_.Nanoseconds(index);
    PLEINAIR_ASSIGN_OR_RETURN(FilmPicture picture, pictures_.Convert(decoded));
    frame.rgb = std::move(picture.rgb);
    frame.deep = std::move(picture.deep);
    frame.grey = GreyOf(frame.rgb);
    return frame;
  }

  tl::unexpected<Error> Damaged(std::size_t frame, const std::string& what) const {
    return InputError(decoder_.demuxer().name(),
                      "is damaged: frame " + std::to_string(frame) + " " + what, kWholeCopy);
  }

  // Checks that the end came at the expected frame.
  Result<std::optional<Frame>> End() const {
    if (next_ >= times_.frames) return std::nullopt;
    return InputError(decoder_.demuxer().name(),
                      "is cut short or damaged: only " + std::to_string(next_) + " of " +
                          std::to_string(times_.frames) + " frames can be decoded",
                      kWholeCopy);
  }

  FilmDecoder decoder_;
  FilmPictures pictures_;
  FrameTimes times_;
  ImageSize stored_size_;
  std::size_t next_ = 0;    // Next frame of the decoder.
  std::size_t wanted_ = 0;  // Earlier frames are not delivered.
  bool sought_ = false;     // Since the last delivered frame.
  bool at_end_ = false;
};

Result<DisplayTurn> TurnOf(const FilmDemuxer& film) {
  std::size_t bytes = 0;
  const std::uint8_t* data =
      av_stream_get_side_data(&film.track(), AV_PKT_DATA_DISPLAYMATRIX, &bytes);
  std::array<std::int32_t, 9> matrix{};
  if (data == nullptr || bytes < sizeof matrix) return DisplayTurn();
  std::memcpy(matrix.data(), data, sizeof matrix);
  return DisplayTurn::FromMatrix(matrix, film.name());
}

/// The container's rate where it agrees with the intervals of the frames, else theirs.
std::optional<double> RateOf(const FilmDemuxer& film, const FilmStamps& stamps) {
  constexpr double kAgreement = 0.05;
  constexpr double kMaxRate_hz = 1e5;
  const std::optional<double> typical_hz = stamps.TypicalRate_hz();
  for (const AVRational rate : {film.track().avg_frame_rate, film.track().r_frame_rate}) {
    if (rate.num <= 0 || rate.den <= 0) continue;
    const double rate_hz = av_q2d(rate);
    if (rate_hz > kMaxRate_hz) continue;
    if (!typical_hz || std::abs(rate_hz / *typical_hz - 1.0) < kAgreement) return rate_hz;
  }
  return typical_hz;
}

Result<FrameTimes> TimesOf(const FilmDemuxer& film, FilmStamps stamps, const VideoMetadata& facts,
                           double* rate_hz) {
  constexpr double kSameRate = 0.01;
  FrameTimes times;
  const std::optional<double> own_hz = RateOf(film, stamps);
  if (!own_hz && !facts.frame_rate_hz) {
    return InputError(film.name(), "does not say its frame rate",
                      "put it into a folder with a recording.json that has frame_rate_hz");
  }
  *rate_hz = facts.frame_rate_hz.value_or(own_hz.value_or(0.0));
  const bool is_overridden =
      facts.frame_rate_hz && own_hz && std::abs(*facts.frame_rate_hz / *own_hz - 1.0) > kSameRate;
  if (is_overridden || !stamps.are_stored()) times.rate_hz = *rate_hz;
  times.timestamps_s = facts.timestamps_s;
  times.frames = stamps.frames();
  if (facts.frame_count) {
    const auto promised = static_cast<std::size_t>(*facts.frame_count);
    if (promised > times.frames) {
      return InputError(film.name(),
                        "is cut short or damaged: only " + std::to_string(times.frames) + " of " +
                            std::to_string(promised) + " frames are there",
                        kWholeCopy);
    }
    times.frames = promised;
  }
  if (!times.timestamps_s.empty()) {
    times.frames = std::min(times.frames, times.timestamps_s.size());
  }
  times.stored = std::move(stamps);
  return times;
}

/// Adds the duration and the longest time between two frames.
void AddTimes(const FilmStamps& stamps, FilmFacts* facts) {
  if (!stamps.are_stored()) return;
  constexpr double kSecond_ns = 1e9;
  for (std::size_t i = 1; i < stamps.frames(); ++i) {
    const double interval_s =
        static_cast<double>(stamps.Nanoseconds(i) - stamps.Nanoseconds(i - 1)) / kSecond_ns;
    if (interval_s <= facts->longest_interval_s) continue;
    facts->longest_interval_s = interval_s;
    facts->longest_interval_after = static_cast<std::int64_t>(i) - 1;
  }
  facts->duration_s = static_cast<double>(stamps.Nanoseconds(stamps.frames() - 1)) / kSecond_ns;
}

FilmFacts FactsOf(const FilmDemuxer& film, const FilmColors& colors, const DisplayTurn& turn,
                  const FilmStamps& stamps) {
  FilmFacts facts;
  facts.codec = film.codec();
  facts.colors = colors.Text();
  facts.is_hdr = colors.IsHdr();
  facts.clockwise_deg = turn.clockwise_deg();
  facts.is_mirrored = turn.mirrored();
  facts.sound_codec = film.sound_codec();
  facts.tags = TagsOfFilm(film.metadata());
  AddTimes(stamps, &facts);
  return facts;
}

Result<OpenedVideo> Open(const std::filesystem::path& file, const VideoMetadata& facts) {
  PLEINAIR_ASSIGN_OR_RETURN(FilmDemuxer film, FilmDemuxer::Open(file));
  PLEINAIR_ASSIGN_OR_RETURN(const DisplayTurn turn, TurnOf(film));
  const ImageSize stored{film.track().codecpar->width, film.track().codecpar->height};
  OpenedVideo opened;
  opened.size = turn.Turned(stored);
  if (facts.size != ImageSize{} && opened.size != facts.size) {
    return InputError(
        film.name(),
        "has " + std::to_string(opened.size.width) + "x" + std::to_string(opened.size.height) +
            " pixels, but the calibration is for " + std::to_string(facts.size.width) + "x" +
            std::to_string(facts.size.height),
        "use the calibration of this camera at this size");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<FilmPacket> packets, film.Scan());
  const AVRational unit = film.track().time_base;
  PLEINAIR_ASSIGN_OR_RETURN(FilmStamps stamps,
                            FilmStamps::Create(packets, {unit.num, unit.den}, film.name()));
  PLEINAIR_ASSIGN_OR_RETURN(const FilmColors colors,
                            FilmColors::Create(film.color_tags(), stored.height, film.name()));
  opened.facts = FactsOf(film, colors, turn, stamps);
  PLEINAIR_ASSIGN_OR_RETURN(FrameTimes times,
                            TimesOf(film, std::move(stamps), facts, &opened.frame_rate_hz));
  opened.curve = colors.curve();
  if (times.HasStored()) opened.start_s = times.stored.start_s();
  FilmPictures pictures(film.name(), colors, turn);
  PLEINAIR_ASSIGN_OR_RETURN(FilmDecoder decoder, FilmDecoder::Create(std::move(film)));
  opened.frames = std::make_unique<VideoFile>(std::move(decoder), std::move(pictures),
                                              std::move(times), stored);
  return opened;
}

}  // namespace

Result<OpenedVideo> OpenVideo(const std::filesystem::path& file, const VideoMetadata& facts) {
  PLEINAIR_RETURN_IF_ERROR(files::CheckRegularFile(file));
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) {
    return InputError(file.string(), "cannot be read: " + error.message(), "check the name");
  }
  if (bytes == 0) return InputError(file.string(), "is empty", kWholeCopy);
  PLEINAIR_RETURN_IF_ERROR(CheckContainerIsWhole(file));
  PLEINAIR_RETURN_IF_ERROR(CheckFrameTables(file));
  return Open(file, facts);
}

}  // namespace pleinair::devices
