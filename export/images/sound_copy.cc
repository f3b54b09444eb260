#include "export/images/sound_copy.h"

#include <cmath>
#include <utility>

#include "devices/films/libav_input.h"

namespace pleinair::exports {
namespace {

using devices::LibavPointer;

// Codecs of sound need the packet before the first that is heard.
constexpr double kPrimingPackets = 2.0;

}  // namespace

SoundCopy::SoundCopy(LibavPointer<AVFormatContext> input, int from, AVFormatContext* output, int to,
                     double start_s)
    : input_(std::move(input)),
      from_(from),
      to_(to),
      output_(output),
      start_s_(start_s),
      next_(av_packet_alloc()) {}

Result<std::unique_ptr<SoundCopy>> SoundCopy::Add(const CopiedSound& sound, AVFormatContext* output,
                                                  std::string* why_not) {
  const std::string name = sound.film.string();
  LibavPointer<AVFormatContext> input = devices::OpenLibavInput(sound.film);
  if (!input || avformat_find_stream_info(input.get(), nullptr) < 0) {
    return InputError(name, "changed while it was being replayed",
                      "replay it again when nothing writes to it");
  }
  const int from = av_find_best_stream(input.get(), AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
  if (from < 0) return nullptr;
  const AVStream& source = *input->streams[from];
  if (avformat_query_codec(output->oformat, source.codecpar->codec_id, FF_COMPLIANCE_NORMAL) != 1) {
    *why_not = std::string("The film's sound is coded as ") +
               avcodec_get_name(source.codecpar->codec_id) +
               ", which MP4 does not hold: composite.mp4 is silent.";
    return nullptr;
  }
  AVStream* target = avformat_new_stream(output, nullptr);
  if (target == nullptr || avcodec_parameters_copy(target->codecpar, source.codecpar) < 0) {
    return SystemError(name, "not enough memory to copy its sound", "close other programs");
  }
  target->codecpar->codec_tag = 0;  // The container chooses its own.
  target->time_base = source.time_base;
  for (unsigned i = 0; i < input->nb_streams; ++i) {
    if (static_cast<int>(i) != from) input->streams[i]->discard = AVDISCARD_ALL;
  }
  std::unique_ptr<SoundCopy> copy(
      new SoundCopy(std::move(input), from, output, target->index, sound.start_s));
  if (!copy->next_) return SystemError(name, "not enough memory to copy its sound");
  copy->has_next_ = copy->ReadNext();
  return copy;
}

bool SoundCopy::ReadNext() {
  const AVRational unit = input_->streams[from_]->time_base;
  const auto start = static_cast<std::int64_t>(std::llround(start_s_ / av_q2d(unit)));
  for (;;) {
    av_packet_unref(next_.get());
    if (av_read_frame(input_.get(), next_.get()) < 0) return false;
    if (next_->stream_index != from_ || next_->pts == AV_NOPTS_VALUE) continue;
    if (next_->dts == AV_NOPTS_VALUE) next_->dts = next_->pts;
    // The writer refuses times that do not increase; damaged files have such packets.
    if (next_->pts < next_->dts || next_->dts <= last_ticks_) continue;
    last_ticks_ = next_->dts;
    next_->pts -= start;
    next_->dts -= start;
    const auto heard = kPrimingPackets * static_cast<double>(next_->duration);
    if (static_cast<double>(next_->pts) + heard > 0.0) return true;
  }
}

int SoundCopy::WriteUntil(double time_s) {
  const AVRational unit = input_->streams[from_]->time_base;
  while (has_next_ && static_cast<double>(next_->pts) * av_q2d(unit) < time_s) {
    av_packet_rescale_ts(next_.get(), unit, output_->streams[to_]->time_base);
    next_->stream_index = to_;
    next_->pos = -1;
    const int code = av_interleaved_write_frame(output_, next_.get());
    if (code < 0) return code;
    has_next_ = ReadNext();
  }
  return 0;
}

}  // namespace pleinair::exports
