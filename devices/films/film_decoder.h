#pragma once

#include <string>

#include "base/error.h"
#include "devices/films/film_demuxer.h"
#include "devices/films/libav_pointer.h"

namespace pleinair::devices {

/// Decodes the video track of a film, in the order of display.
class FilmDecoder {
 public:
  /// Errors: a codec that this machine's libavcodec lacks; damaged parameters.
  static Result<FilmDecoder> Create(FilmDemuxer demuxer);

  /// The next frame, which stays valid until the next call; null at the end. Errors: damaged data.
  Result<const AVFrame*> Next();

  /// Goes on from the key frame at or before a time in ticks. False: cannot.
  bool Seek(std::int64_t ticks);
  bool SeekToStart();

  const FilmDemuxer& demuxer() const { return demuxer_; }

 private:
  FilmDecoder(FilmDemuxer demuxer, LibavPointer<AVCodecContext> codec);
  Result<bool> Feed();
  bool AfterSeek(bool done);

  FilmDemuxer demuxer_;
  LibavPointer<AVCodecContext> codec_;
  LibavPointer<AVPacket> packet_;
  LibavPointer<AVFrame> frame_;
};

}  // namespace pleinair::devices
