#pragma once

// Internal: owners of libav's objects; not installed.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>
#include <system_error>

namespace pleinair::devices {

struct LibavDeleter {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* context) const { sws_freeContext(context); }
  /// Of input and of output.
  void operator()(AVFormatContext* context) const {
    if (context->iformat != nullptr) {
      avformat_close_input(&context);
      return;
    }
    if (context->pb != nullptr) avio_closep(&context->pb);
    avformat_free_context(context);
  }
};

template <typename T>
using LibavPointer = std::unique_ptr<T, LibavDeleter>;

/// Message for an error code of libav. It continues a sentence about the file ("is damaged: …").
inline std::string LibavText(int code) {
  if (code == AVERROR_INVALIDDATA) return "its data contradict its format";
  if (code == AVERROR_EOF) return "it ends too early";
  if (code == AVERROR_PATCHWELCOME || code == AVERROR(ENOSYS)) {
    return "it uses a part of its format that cannot be decoded here";
  }
  // libav's own codes are large; the others are those of the system.
  constexpr int kMaxSystemCode = 4096;
  const int system = AVUNERROR(code);
  if (system > 0 && system < kMaxSystemCode && system != EINVAL) {
    return std::generic_category().message(system);
  }
  return "libavcodec refuses it with code " + std::to_string(code);
}

}  // namespace pleinair::devices
