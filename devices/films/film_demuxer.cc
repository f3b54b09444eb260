#include "devices/films/film_demuxer.h"

#include <algorithm>
#include <utility>

extern "C" {
#include <libavutil/dovi_meta.h>
#include <libavutil/pixdesc.h>
}

#include "devices/films/libav_input.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {
namespace {

constexpr const char* kWholeCopy = "get a whole copy of it";

std::optional<std::int64_t> Ticks(std::int64_t ticks) {
  return ticks == AV_NOPTS_VALUE ? std::nullopt : std::optional<std::int64_t>(ticks);
}

FilmColorTags TagsOf(const AVCodecParameters& coded) {
  FilmColorTags tags;
  tags.primaries = coded.color_primaries;
  tags.transfer = coded.color_trc;
  tags.matrix = coded.color_space;
  tags.full_range = coded.color_range == AVCOL_RANGE_JPEG;
  const AVPixFmtDescriptor* pixels = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(coded.format));
  if (pixels == nullptr || coded.codec_type != AVMEDIA_TYPE_VIDEO) return tags;
  // Formats whose name says full range ("yuvj420p" of Motion JPEG).
  if (std::string(pixels->name).starts_with("yuvj")) tags.full_range = true;
  tags.is_rgb = (pixels->flags & AV_PIX_FMT_FLAG_RGB) != 0;
  return tags;
}

/// `states_range`: whether the coded images state theirs.
FilmColorTags Merged(FilmColorTags coded, bool states_range, const FilmColorTags& container) {
  const auto fill = [](int from, int* to) {
    if (*to == AVCOL_PRI_UNSPECIFIED) *to = from;
  };
  fill(container.primaries, &coded.primaries);
  fill(container.transfer, &coded.transfer);
  fill(container.matrix, &coded.matrix);
  if (!states_range && container.full_range) coded.full_range = true;
  return coded;
}

/// Dolby Vision without a base layer of its own colors: profile 5.
bool IsDolbyVisionAlone(const AVStream& track) {
  std::size_t bytes = 0;
  const std::uint8_t* data = av_stream_get_side_data(&track, AV_PKT_DATA_DOVI_CONF, &bytes);
  if (data == nullptr || bytes < sizeof(AVDOVIDecoderConfigurationRecord)) return false;
  return reinterpret_cast<const AVDOVIDecoderConfigurationRecord*>(data)
             ->dv_bl_signal_compatibility_id == 0;
}

}  // namespace

Result<FilmDemuxer> FilmDemuxer::Open(const std::filesystem::path& file) {
  const std::string name = file.string();
  LibavPointer<AVFormatContext> format = OpenLibavInput(file);
  if (!format) {
    return InputError(name, "cannot be opened as a video: no known format, or cut short",
                      "get a whole copy of it, or convert it to MP4 with H.264");
  }
  // The container's color tags: a decoder forgets them where the coded images state none.
  std::vector<FilmColorTags> stated;
  for (unsigned i = 0; i < format->nb_streams; ++i) {
    stated.push_back(TagsOf(*format->streams[i]->codecpar));
  }
  if (avformat_find_stream_info(format.get(), nullptr) < 0) {
    return InputError(name, "cannot be opened as a video: its tracks are damaged", kWholeCopy);
  }
  const int track = av_find_best_stream(format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  const bool is_cover =
      track >= 0 && (format->streams[track]->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0;
  if (track < 0 || is_cover) {
    return InputError(name, "holds no video, only other tracks", "name a film");
  }
  const AVCodecParameters& coded = *format->streams[track]->codecpar;
  if (coded.width < 1 || coded.height < 1 || coded.width > kMaxImageSide ||
      coded.height > kMaxImageSide) {
    return InputError(name,
                      "has images of " + std::to_string(coded.width) + "x" +
                          std::to_string(coded.height) + " pixels; at most " +
                          std::to_string(kMaxImageSide) + " a side can be read",
                      "convert it to a smaller size");
  }
  if (IsDolbyVisionAlone(*format->streams[track])) {
    return InputError(name, "has Dolby Vision colors without a compatible base layer",
                      "film in HLG or SDR, or convert it to BT.709 in a video editor");
  }
  FilmColorTags colors = TagsOf(coded);
  if (static_cast<std::size_t>(track) < stated.size()) {
    colors = Merged(colors, coded.color_range != AVCOL_RANGE_UNSPECIFIED,
                    stated[static_cast<std::size_t>(track)]);
  }
  for (unsigned i = 0; i < format->nb_streams; ++i) {
    if (static_cast<int>(i) != track) format->streams[i]->discard = AVDISCARD_ALL;
  }
  return FilmDemuxer(name, std::move(format), track, colors);
}

std::map<std::string, std::string> FilmDemuxer::metadata() const {
  std::map<std::string, std::string> metadata;
  for (const AVDictionary* tags : {format_->metadata, track().metadata}) {
    const AVDictionaryEntry* tag = nullptr;
    while ((tag = av_dict_get(tags, "", tag, AV_DICT_IGNORE_SUFFIX)) != nullptr) {
      metadata.insert_or_assign(tag->key, tag->value);
    }
  }
  return metadata;
}

std::string FilmDemuxer::codec() const { return avcodec_get_name(track().codecpar->codec_id); }

std::string FilmDemuxer::sound_codec() const {
  const int sound = av_find_best_stream(format_.get(), AVMEDIA_TYPE_AUDIO, -1, track_, nullptr, 0);
  return sound < 0 ? "" : avcodec_get_name(format_->streams[sound]->codecpar->codec_id);
}

Result<bool> FilmDemuxer::Read(AVPacket* packet) {
  for (;;) {
    av_packet_unref(packet);
    const int code = av_read_frame(format_.get(), packet);
    if (code == AVERROR_EOF) {
      // A read error of the disk, or a container that ends within its own structure.
      if (format_->pb == nullptr || format_->pb->error >= 0) return false;
      return InputError(name_, "cannot be read: " + LibavText(format_->pb->error), kWholeCopy);
    }
    if (code < 0) {
      return InputError(name_, "is cut short or damaged: " + LibavText(code), kWholeCopy);
    }
    if (packet->stream_index != track_ || packet->size == 0) continue;
    if ((packet->flags & AV_PKT_FLAG_CORRUPT) != 0) {
      return InputError(name_, "is cut short or damaged: a frame is incomplete", kWholeCopy);
    }
    return true;
  }
}

Result<std::vector<FilmPacket>> FilmDemuxer::Scan() {
  std::vector<FilmPacket> packets;
  const LibavPointer<AVPacket> packet(av_packet_alloc());
  for (;;) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, Read(packet.get()));
    if (!more) break;
    packets.push_back({Ticks(packet->pts), Ticks(packet->dts),
                       (packet->flags & AV_PKT_FLAG_KEY) != 0,
                       (packet->flags & AV_PKT_FLAG_DISCARD) != 0});
  }
  for (const FilmPacket& each : packets) {
    start_ticks_ = std::min(start_ticks_, each.decoded.value_or(each.shown.value_or(0)));
  }
  if (!packets.empty() && !SeekToStart()) {
    return InputError(name_, "cannot be read twice", "convert it to MP4 with H.264");
  }
  return packets;
}

bool FilmDemuxer::Seek(std::int64_t ticks) {
  return avformat_seek_file(format_.get(), track_, INT64_MIN, ticks, ticks, 0) >= 0;
}

bool FilmDemuxer::SeekToStart() { return Seek(start_ticks_); }

}  // namespace pleinair::devices
