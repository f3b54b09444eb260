#pragma once

// Internal: owners of libav's objects; not installed.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <memory>
#include <string>

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

/// libav's words for its error number.
inline std::string LibavText(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

}  // namespace pleinair::devices
