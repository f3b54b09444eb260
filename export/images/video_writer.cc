#include "export/images/video_writer.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "devices/films/libav_pointer.h"
#include "export/images/sound_copy.h"

namespace pleinair::exports {
namespace {

using devices::LibavPointer;

// Resolution of irregular time stamps: at least a hundredth of a frame, and half a millisecond
// unless frames are minutes apart.
constexpr int kMinTicksPerFrame = 100;
constexpr double kTicksPerSecond = 2000.0, kMinFineRate_hz = 0.01;
// Stamps are moved to the regular raster over at most this time, and a fiftieth of a frame.
constexpr double kMaxSnap_s = 0.5e-3;
constexpr int kEncoderThreads = 4;  // Fixed: x264's decisions depend on it.

constexpr double kFastestNtsc_hz = 1000.0;

/// Converts the rate to the intended fraction: 29.97 is 30000/1001, a frame in five minutes 1/300.
AVRational RateFraction(double rate_hz) {
  const double whole = std::round(rate_hz);
  if (whole >= 1.0 && std::abs(rate_hz - whole) < 1e-3) return {static_cast<int>(whole), 1};
  const double ntsc = std::round(rate_hz * 1.001);
  if (ntsc >= 1.0 && ntsc <= kFastestNtsc_hz && std::abs(rate_hz - ntsc / 1.001) < 5e-3) {
    return {static_cast<int>(ntsc) * 1000, 1001};
  }
  const AVRational fraction = av_d2q(rate_hz, 10000);
  if (fraction.num > 0) return fraction;
  constexpr double kMaxPeriod_s = std::numeric_limits<int>::max();
  return {1, static_cast<int>(std::min(std::round(1.0 / rate_hz), kMaxPeriod_s))};
}

AVColorTransferCharacteristic TransferTag(devices::FilmCurve curve) {
  switch (curve) {
    case devices::FilmCurve::kBt709:
      return AVCOL_TRC_BT709;
    case devices::FilmCurve::kGamma22:
      return AVCOL_TRC_GAMMA22;
    case devices::FilmCurve::kGamma28:
      return AVCOL_TRC_GAMMA28;
    case devices::FilmCurve::kSrgb:
      break;
  }
  return AVCOL_TRC_IEC61966_2_1;
}

int TicksPerFrame(double rate_hz) {
  if (rate_hz < kMinFineRate_hz) return kMinTicksPerFrame;
  return std::max(kMinTicksPerFrame, static_cast<int>(std::ceil(kTicksPerSecond / rate_hz)));
}

/// Converts libav's error number to an Error about `file`. System errors about files keep their
/// text. EINVAL is libav's own code for an unsupported setting.
Error LibavError(const std::filesystem::path& file, int code) {
  const int error_number = AVUNERROR(code);
  if (error_number > 0 && error_number < 4096 && error_number != EINVAL) {
    return WriteError(file, error_number);
  }
  return {ErrorKind::kSystem, file.string(), "cannot encode video: " + devices::LibavText(code),
          "try --no-video"};
}

class LibavVideoWriter final : public VideoWriter {
 public:
  LibavVideoWriter(std::filesystem::path file, const Options& options)
      : file_(std::move(file)), options_(options) {}

  Result<void> Open() {
    av_log_set_level(AV_LOG_QUIET);  // Every failure returns a code and is reported by us.
    const AVCodec* codec = nullptr;
    for (const char* name : {"libx264", "libopenh264"}) {
      codec = avcodec_find_encoder_by_name(name);
      if (codec != nullptr) break;
    }
    if (codec == nullptr) {
      return SystemError(file_.string(), "this machine's libavcodec has no H.264 encoder",
                         "install Debian's libavcodec59 with libx264-164, or use --no-video");
    }
    AVFormatContext* format = nullptr;
    int code = avformat_alloc_output_context2(&format, nullptr, "mp4", file_.c_str());
    if (code < 0) return tl::make_unexpected(LibavError(file_, code));
    format_.reset(format);
    // No creation time, no library versions: the bytes depend only on the frames.
    format_->flags |= AVFMT_FLAG_BITEXACT;
    codec_.reset(avcodec_alloc_context3(codec));
    frame_.reset(av_frame_alloc());
    packet_.reset(av_packet_alloc());
    stream_ = avformat_new_stream(format_.get(), nullptr);
    if (!codec_ || !frame_ || !packet_ || stream_ == nullptr) {
      return tl::make_unexpected(LibavError(file_, AVERROR(ENOMEM)));
    }
    ConfigureCodec(*codec);
    AVDictionary* settings = nullptr;
    if (encoder_name() == "libx264") {
      av_dict_set(&settings, "preset", "veryfast", 0);
      av_dict_set(&settings, "crf", "18", 0);
    }
    code = avcodec_open2(codec_.get(), codec, &settings);
    av_dict_free(&settings);
    if (code < 0) return tl::make_unexpected(LibavError(file_, code));
    return OpenFile();
  }

  Result<void> Add(ImageView<const std::uint8_t> rgb, std::int64_t timestamp_ns) override {
    CHECK_EQ(rgb.width(), options_.width);
    CHECK_EQ(rgb.height(), options_.height);
    PadToEven(rgb);
    if (const int code = av_frame_make_writable(frame_.get()); code < 0) {
      return tl::make_unexpected(LibavError(file_, code));
    }
    const std::uint8_t* rows[1] = {padded_.data()};
    const int strides[1] = {codec_->width * 3};
    sws_scale(scaler_.get(), rows, strides, 0, codec_->height, frame_->data, frame_->linesize);
    frame_->pts = NextStamp(timestamp_ns);
    return Encode(frame_.get());
  }

  Result<void> Finish() override {
    PLEINAIR_RETURN_IF_ERROR(Encode(nullptr));
    PLEINAIR_RETURN_IF_ERROR(WriteSoundUntil(stamps_.last_tick + stamps_.ticks_per_frame));
    if (const int code = av_write_trailer(format_.get()); code < 0) {
      return tl::make_unexpected(LibavError(file_, code));
    }
    // The file's own buffer may hold the last bytes. An earlier failure stays in `error`.
    avio_flush(format_->pb);
    const int write_code = format_->pb->error;
    const int close_code = avio_closep(&format_->pb);
    if (const int code = std::min(write_code, close_code); code < 0) {
      return tl::make_unexpected(LibavError(file_, code));
    }
    return {};
  }

  std::string encoder_name() const override { return codec_->codec->name; }

  std::string why_silent() const override { return why_silent_; }

 private:
  void ConfigureCodec(const AVCodec& codec) {
    const AVRational rate = RateFraction(options_.frame_rate_hz);
    stamps_.ticks_per_frame = TicksPerFrame(options_.frame_rate_hz);
    codec_->width = options_.width + options_.width % 2;
    codec_->height = options_.height + options_.height % 2;
    codec_->pix_fmt = AV_PIX_FMT_YUV420P;
    codec_->framerate = rate;
    codec_->time_base = {rate.den, rate.num * stamps_.ticks_per_frame};
    codec_->colorspace = AVCOL_SPC_BT709;
    codec_->color_primaries = AVCOL_PRI_BT709;
    codec_->color_trc = TransferTag(options_.curve);
    codec_->color_range = AVCOL_RANGE_MPEG;
    codec_->thread_count = kEncoderThreads;
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    if (std::string_view(codec.name) != "libx264") {
      codec_->bit_rate = static_cast<std::int64_t>(codec_->width) * codec_->height * 8;
    }
  }

  Result<void> OpenFile() {
    int code = avcodec_parameters_from_context(stream_->codecpar, codec_.get());
    stream_->time_base = codec_->time_base;
    stream_->avg_frame_rate = codec_->framerate;
    if (code >= 0) {
      frame_->format = codec_->pix_fmt;
      frame_->width = codec_->width;
      frame_->height = codec_->height;
      frame_->color_range = AVCOL_RANGE_MPEG;
      frame_->colorspace = AVCOL_SPC_BT709;
      code = av_frame_get_buffer(frame_.get(), 0);
    }
    if (code < 0) return tl::make_unexpected(LibavError(file_, code));
    scaler_.reset(sws_getContext(codec_->width, codec_->height, AV_PIX_FMT_RGB24, codec_->width,
                                 codec_->height, AV_PIX_FMT_YUV420P,
                                 SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_BITEXACT,
                                 nullptr, nullptr, nullptr));
    if (!scaler_) return tl::make_unexpected(LibavError(file_, AVERROR(ENOMEM)));
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(scaler_.get(), bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
    padded_.resize(static_cast<std::size_t>(codec_->width) * codec_->height * 3);
    if (options_.sound) {
      PLEINAIR_ASSIGN_OR_RETURN(sound_,
                                SoundCopy::Add(*options_.sound, format_.get(), &why_silent_));
    }
    code = avio_open(&format_->pb, file_.c_str(), AVIO_FLAG_WRITE);
    if (code < 0) return tl::make_unexpected(LibavError(file_, code));
    AVDictionary* settings = nullptr;
    av_dict_set(&settings, "movflags", "+faststart", 0);  // The index first: plays while it loads.
    code = avformat_write_header(format_.get(), &settings);
    av_dict_free(&settings);
    if (code < 0) return tl::make_unexpected(LibavError(file_, code));
    return {};
  }

  void PadToEven(ImageView<const std::uint8_t> rgb) {
    for (int y = 0; y < codec_->height; ++y) {
      const std::uint8_t* source = rgb.row(std::min(y, rgb.height() - 1));
      std::uint8_t* target = padded_.data() + static_cast<std::size_t>(y) * codec_->width * 3;
      std::memcpy(target, source, static_cast<std::size_t>(rgb.width()) * 3);
      if (codec_->width > rgb.width()) {
        std::memcpy(target + rgb.width() * 3, source + (rgb.width() - 1) * 3, 3);
      }
    }
  }

  std::int64_t NextStamp(std::int64_t timestamp_ns) {
    if (!stamps_.first_ns) stamps_.first_ns = timestamp_ns;
    const double seconds = static_cast<double>(timestamp_ns - *stamps_.first_ns) * 1e-9;
    std::int64_t tick = std::llround(seconds / av_q2d(codec_->time_base));
    const int each = stamps_.ticks_per_frame;
    const std::int64_t raster = (tick + each / 2) / each * each;
    const double off_s =
        std::abs(seconds - static_cast<double>(raster) * av_q2d(codec_->time_base));
    if (std::abs(tick - raster) <= each / 50 && off_s <= kMaxSnap_s) tick = raster;
    stamps_.last_tick = std::max(tick, stamps_.last_tick + 1);
    return stamps_.last_tick;
  }

  /// Writes the sound before a time in the encoder's ticks.
  Result<void> WriteSoundUntil(std::int64_t tick) {
    if (!sound_) return {};
    const int code = sound_->WriteUntil(static_cast<double>(tick) * av_q2d(codec_->time_base));
    if (code < 0) return tl::make_unexpected(LibavError(file_, code));
    return {};
  }

  Result<void> Encode(const AVFrame* frame) {
    int code = avcodec_send_frame(codec_.get(), frame);
    while (code >= 0) {
      code = avcodec_receive_packet(codec_.get(), packet_.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
      if (code < 0) break;
      packet_->duration = stamps_.ticks_per_frame;
      PLEINAIR_RETURN_IF_ERROR(WriteSoundUntil(packet_->dts));
      av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
      packet_->stream_index = stream_->index;
      code = av_interleaved_write_frame(format_.get(), packet_.get());
      if (code >= 0) code = format_->pb->error;
    }
    return tl::make_unexpected(LibavError(file_, code));
  }

  std::filesystem::path file_;
  Options options_;
  LibavPointer<AVFormatContext> format_;
  LibavPointer<AVCodecContext> codec_;
  LibavPointer<SwsContext> scaler_;
  LibavPointer<AVFrame> frame_;
  LibavPointer<AVPacket> packet_;
  AVStream* stream_ = nullptr;  // Owned by the format.
  std::vector<std::uint8_t> padded_;
  struct Stamps {
    int ticks_per_frame = kMinTicksPerFrame;
    std::optional<std::int64_t> first_ns;
    std::int64_t last_tick = -1;  // One before the first.
  };
  Stamps stamps_;
  std::unique_ptr<SoundCopy> sound_;  // Null: none. Refers to the format.
  std::string why_silent_;
};

}  // namespace

Result<std::unique_ptr<VideoWriter>> VideoWriter::Create(const std::filesystem::path& file,
                                                         const Options& options) {
  auto writer = std::make_unique<LibavVideoWriter>(file, options);
  PLEINAIR_RETURN_IF_ERROR(writer->Open());
  return writer;
}

}  // namespace pleinair::exports
