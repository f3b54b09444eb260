#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "devices/films/film_colors.h"
#include "devices/films/film_stamps.h"
#include "devices/films/libav_pointer.h"

namespace pleinair::devices {

/// An open film: its container and its video track, read by libavformat. Only the named file is
/// read, whatever it refers to.
class FilmDemuxer {
 public:
  /// Errors (input): no known container, no video track, an image above kMaxImageSide.
  static Result<FilmDemuxer> Open(const std::filesystem::path& file);

  /// Reads all packets of the track without decoding, and returns to the start. Errors: the file
  /// ends or is damaged within a packet.
  Result<std::vector<FilmPacket>> Scan();

  /// Reads the next packet of the track; false at the end. Errors: as Scan().
  Result<bool> Read(AVPacket* packet);

  /// Goes to the last key frame at or before a time in ticks. False: the container cannot.
  bool Seek(std::int64_t ticks);
  /// Goes to the first packet. Requires Scan().
  bool SeekToStart();

  /// What the container and the coded images state; the images' word counts where both do.
  FilmColorTags color_tags() const { return color_tags_; }
  /// Of the container and the track, by libavformat's keys; the track's count where both have one.
  std::map<std::string, std::string> metadata() const;
  /// Names of the codecs; `sound_codec` is empty without sound.
  std::string codec() const;
  std::string sound_codec() const;
  const AVStream& track() const { return *format_->streams[track_]; }
  const std::string& name() const { return name_; }

 private:
  FilmDemuxer(std::string name, LibavPointer<AVFormatContext> format, int track,
              FilmColorTags colors)
      : name_(std::move(name)), format_(std::move(format)), track_(track), color_tags_(colors) {}

  std::string name_;
  LibavPointer<AVFormatContext> format_;
  int track_;
  FilmColorTags color_tags_;
  std::int64_t start_ticks_ = INT64_MAX;
};

}  // namespace pleinair::devices
