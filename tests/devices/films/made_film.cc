#include "tests/devices/films/made_film.h"

extern "C" {
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "devices/films/libav_pointer.h"

namespace pleinair::tests {
namespace {

using devices::LibavPointer;

int Check(int code, const char* step) {
  if (code < 0) throw std::runtime_error(std::string(step) + ": " + devices::LibavText(code));
  return code;
}

class FilmMaker {
 public:
  FilmMaker(const std::filesystem::path& file, const MadeFilm& film) : film_(film) {
    av_log_set_level(AV_LOG_QUIET);
    AVFormatContext* format = nullptr;
    Check(avformat_alloc_output_context2(&format, nullptr, nullptr, file.c_str()), "container");
    format_.reset(format);
    for (const auto& [key, value] : film.tags) {
      av_dict_set(&format_->metadata, key.c_str(), value.c_str(), 0);
    }
    AddPictures();
    if (!film.sound_encoder.empty()) AddSound();
    Check(avio_open(&format_->pb, file.c_str(), AVIO_FLAG_WRITE), "open");
    AVDictionary* options = nullptr;
    for (const auto& [key, value] : film.muxer_options) {
      av_dict_set(&options, key.c_str(), value.c_str(), 0);
    }
    const int code = avformat_write_header(format_.get(), &options);
    av_dict_free(&options);
    Check(code, "header");
  }

  void Write(const std::function<void(AVFrame*, int)>& draw) {
    for (std::size_t i = 0; i < film_.ticks.size(); ++i) {
      LibavPointer<AVFrame> frame(av_frame_alloc());
      frame->format = pictures_->pix_fmt;
      frame->width = film_.width;
      frame->height = film_.height;
      frame->color_range = pictures_->color_range;
      frame->colorspace = pictures_->colorspace;
      frame->color_primaries = pictures_->color_primaries;
      frame->color_trc = pictures_->color_trc;
      Check(av_frame_get_buffer(frame.get(), 0), "frame");
      draw(frame.get(), static_cast<int>(i));
      frame->pts = film_.ticks[i];
      Encode(pictures_.get(), frame.get(), 0);
      WriteSoundUntil(static_cast<double>(film_.ticks[i]) / film_.ticks_per_s);
    }
    WriteSoundUntil(film_.sound_s);
    Encode(pictures_.get(), nullptr, 0);
    if (sound_) Encode(sound_.get(), nullptr, 1);
    Check(av_write_trailer(format_.get()), "trailer");
  }

 private:
  void AddPictures() {
    const AVCodec* codec = avcodec_find_encoder_by_name(film_.encoder.c_str());
    if (codec == nullptr) throw std::runtime_error("no encoder " + film_.encoder);
    pictures_.reset(avcodec_alloc_context3(codec));
    pictures_->width = film_.width;
    pictures_->height = film_.height;
    pictures_->pix_fmt = av_get_pix_fmt(film_.pixels.c_str());
    pictures_->time_base = {1, film_.ticks_per_s};
    if (codec->id == AV_CODEC_ID_MPEG4) pictures_->time_base = {1, 25};
    pictures_->gop_size = film_.key_every;
    pictures_->thread_count = 1;
    pictures_->color_primaries = static_cast<AVColorPrimaries>(film_.primaries);
    pictures_->color_trc = static_cast<AVColorTransferCharacteristic>(film_.transfer);
    pictures_->colorspace = static_cast<AVColorSpace>(film_.matrix);
    pictures_->color_range = film_.full_range ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    pictures_->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      pictures_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    AVDictionary* options = nullptr;
    if (film_.encoder == "libx264") av_dict_set(&options, "preset", "ultrafast", 0);
    if (film_.encoder == "libx264") av_dict_set(&options, "qp", "4", 0);
    if (film_.encoder == "libx264") av_dict_set(&options, "bf", "2", 0);
    if (film_.encoder == "libx265") {
      av_dict_set(&options, "preset", "ultrafast", 0);
      av_dict_set(&options, "x265-params", "log-level=none:qp=4:pools=none", 0);
    }
    const int code = avcodec_open2(pictures_.get(), codec, &options);
    av_dict_free(&options);
    Check(code, "encoder");
    AVStream* stream = avformat_new_stream(format_.get(), nullptr);
    Check(avcodec_parameters_from_context(stream->codecpar, pictures_.get()), "parameters");
    if (codec->id == AV_CODEC_ID_HEVC) stream->codecpar->codec_tag = MKTAG('h', 'v', 'c', '1');
    stream->time_base = pictures_->time_base;
    if (film_.display) {
      auto* matrix = reinterpret_cast<std::int32_t*>(
          av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, 9 * sizeof(std::int32_t)));
      std::fill_n(matrix, 9, 0);
      const auto& [a, b, c, d] = *film_.display;
      matrix[0] = static_cast<std::int32_t>(std::lround(a * 65536));
      matrix[1] = static_cast<std::int32_t>(std::lround(b * 65536));
      matrix[3] = static_cast<std::int32_t>(std::lround(c * 65536));
      matrix[4] = static_cast<std::int32_t>(std::lround(d * 65536));
      matrix[8] = 1 << 30;
    }
  }

  void AddSound() {
    const AVCodec* codec = avcodec_find_encoder_by_name(film_.sound_encoder.c_str());
    if (codec == nullptr) throw std::runtime_error("no encoder " + film_.sound_encoder);
    sound_.reset(avcodec_alloc_context3(codec));
    sound_->sample_rate = 48'000;
    sound_->sample_fmt = codec->sample_fmts[0];
    av_channel_layout_default(&sound_->ch_layout, 1);
    sound_->time_base = {1, sound_->sample_rate};
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      sound_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    Check(avcodec_open2(sound_.get(), codec, nullptr), "sound encoder");
    AVStream* stream = avformat_new_stream(format_.get(), nullptr);
    Check(avcodec_parameters_from_context(stream->codecpar, sound_.get()), "sound");
    stream->time_base = sound_->time_base;
  }

  // A tone of 440 Hz.
  void WriteSoundUntil(double end_s) {
    if (!sound_) return;
    const int samples = sound_->frame_size > 0 ? sound_->frame_size : 1024;
    while (static_cast<double>(samples_) / sound_->sample_rate < std::min(end_s, film_.sound_s)) {
      LibavPointer<AVFrame> frame(av_frame_alloc());
      frame->format = sound_->sample_fmt;
      frame->sample_rate = sound_->sample_rate;
      frame->nb_samples = samples;
      Check(av_channel_layout_copy(&frame->ch_layout, &sound_->ch_layout), "channels");
      Check(av_frame_get_buffer(frame.get(), 0), "samples");
      for (int i = 0; i < samples; ++i) {
        const double value = 0.3 * std::sin(2 * M_PI * 440.0 * static_cast<double>(samples_ + i) /
                                            sound_->sample_rate);
        if (sound_->sample_fmt == AV_SAMPLE_FMT_FLTP) {
          reinterpret_cast<float*>(frame->data[0])[i] = static_cast<float>(value);
        } else {
          reinterpret_cast<std::int16_t*>(frame->data[0])[i] =
              static_cast<std::int16_t>(value * 32767);
        }
      }
      frame->pts = samples_;
      samples_ += samples;
      Encode(sound_.get(), frame.get(), 1);
    }
  }

  void Encode(AVCodecContext* codec, const AVFrame* frame, int stream) {
    const LibavPointer<AVPacket> packet(av_packet_alloc());
    Check(avcodec_send_frame(codec, frame), "encode");
    for (;;) {
      const int code = avcodec_receive_packet(codec, packet.get());
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
      Check(code, "encode");
      if (stream == 0) packet->duration = film_.ticks_per_s / 30 + (film_.ticks_per_s < 30 ? 1 : 0);
      av_packet_rescale_ts(packet.get(), codec->time_base, format_->streams[stream]->time_base);
      packet->stream_index = stream;
      Check(av_interleaved_write_frame(format_.get(), packet.get()), "write");
    }
  }

  const MadeFilm& film_;
  LibavPointer<AVFormatContext> format_;
  LibavPointer<AVCodecContext> pictures_;
  LibavPointer<AVCodecContext> sound_;
  std::int64_t samples_ = 0;
};

}  // namespace

void WriteFilm(const std::filesystem::path& file, const MadeFilm& film,
               const std::function<void(AVFrame*, int)>& draw) {
  FilmMaker(file, film).Write(draw);
}

void FillPlanes(AVFrame* frame, int y, int u, int v) {
  const auto format = static_cast<AVPixelFormat>(frame->format);
  const AVPixFmtDescriptor* description = av_pix_fmt_desc_get(format);
  const int values[] = {y, u, v};
  for (int plane = 0; plane < std::min<int>(description->nb_components, 3); ++plane) {
    const int rows =
        plane == 0 ? frame->height : AV_CEIL_RSHIFT(frame->height, description->log2_chroma_h);
    for (int row = 0; row < rows; ++row) {
      std::uint8_t* line = frame->data[plane] + row * frame->linesize[plane];
      if (description->comp[0].depth > 8) {
        std::fill_n(reinterpret_cast<std::uint16_t*>(line), frame->linesize[plane] / 2,
                    static_cast<std::uint16_t>(values[plane]));
      } else {
        std::fill_n(line, frame->linesize[plane], static_cast<std::uint8_t>(values[plane]));
      }
    }
  }
}

std::vector<std::int64_t> NtscTicks(int frames) {
  std::vector<std::int64_t> ticks;
  for (int i = 0; i < frames; ++i) ticks.push_back(i * std::int64_t{1001});
  return ticks;
}

}  // namespace pleinair::tests
