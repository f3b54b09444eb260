#include "devices/films/film_decoder.h"

#include <cstdint>
#include <utility>

namespace pleinair::devices {
namespace {

constexpr const char* kWholeCopy = "get a whole copy of it";

// Decoders pad images to blocks of at most 128 pixels.
constexpr std::int64_t kPadding_px = 128;

Error OutOfMemory(const std::string& name) {
  return {ErrorKind::kSystem, name, "not enough memory to decode it", "close other programs"};
}

}  // namespace

FilmDecoder::FilmDecoder(FilmDemuxer demuxer, LibavPointer<AVCodecContext> codec)
    : demuxer_(std::move(demuxer)),
      codec_(std::move(codec)),
      packet_(av_packet_alloc()),
      frame_(av_frame_alloc()) {}

Result<FilmDecoder> FilmDecoder::Create(FilmDemuxer demuxer) {
  const AVCodecParameters& coded = *demuxer.track().codecpar;
  const AVCodec* decoder = avcodec_find_decoder(coded.codec_id);
  if (decoder == nullptr) {
    return InputError(demuxer.name(),
                      std::string("is coded as ") + avcodec_get_name(coded.codec_id) +
                          ", which libavcodec here cannot decode",
                      "convert it to MP4 with H.264");
  }
  LibavPointer<AVCodecContext> codec(avcodec_alloc_context3(decoder));
  if (!codec) return tl::make_unexpected(OutOfMemory(demuxer.name()));
  int code = avcodec_parameters_to_context(codec.get(), &coded);
  if (code >= 0) {
    codec->thread_count = 0;  // One a processor.
    codec->pkt_timebase = demuxer.track().time_base;
    // A damaged header cannot ask for more memory than the container's size needs.
    codec->max_pixels = (coded.width + kPadding_px) * (coded.height + kPadding_px);
    code = avcodec_open2(codec.get(), decoder, nullptr);
  }
  if (code < 0) {
    return InputError(demuxer.name(), "cannot be decoded: " + LibavText(code), kWholeCopy);
  }
  FilmDecoder made(std::move(demuxer), std::move(codec));
  if (!made.packet_ || !made.frame_) return tl::make_unexpected(OutOfMemory(made.demuxer_.name()));
  return made;
}

Result<bool> FilmDecoder::Feed() {
  PLEINAIR_ASSIGN_OR_RETURN(const bool more, demuxer_.Read(packet_.get()));
  const int code = avcodec_send_packet(codec_.get(), more ? packet_.get() : nullptr);
  if (code >= 0 || code == AVERROR_EOF) return more;
  return InputError(demuxer_.name(), "is damaged: " + LibavText(code), kWholeCopy);
}

Result<const AVFrame*> FilmDecoder::Next() {
  for (;;) {
    const int code = avcodec_receive_frame(codec_.get(), frame_.get());
    if (code == AVERROR_EOF) return nullptr;
    if (code == AVERROR(EAGAIN)) {
      PLEINAIR_RETURN_IF_ERROR(Feed());
      continue;
    }
    if (code < 0) {
      return InputError(demuxer_.name(), "is damaged: " + LibavText(code), kWholeCopy);
    }
    return frame_.get();
  }
}

bool FilmDecoder::Seek(std::int64_t ticks) { return AfterSeek(demuxer_.Seek(ticks)); }

bool FilmDecoder::SeekToStart() { return AfterSeek(demuxer_.SeekToStart()); }

bool FilmDecoder::AfterSeek(bool done) {
  // Also after a failure: the position is then unknown.
  avcodec_flush_buffers(codec_.get());
  return done;
}

}  // namespace pleinair::devices
