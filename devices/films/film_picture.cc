#include "devices/films/film_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "base/parallel_for.h"
#include "devices/images/rounded_image.h"

namespace pleinair::devices {
namespace {

constexpr std::size_t kSignals = 65'536;
// In steps of the square root of light, since powers of 1/2.2 and 1/2.8 are infinitely steep at
// black. One step changes the signal by less than a tenth of an 8-bit step in every curve.
constexpr std::size_t kLights = 65'536;
constexpr std::size_t kPixelsTogether = 65'536;

int ScalerMatrix(int matrix) {
  switch (matrix) {
    case AVCOL_SPC_FCC:
      return SWS_CS_FCC;
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M:
      return SWS_CS_ITU601;
    case AVCOL_SPC_SMPTE240M:
      return SWS_CS_SMPTE240M;
    case AVCOL_SPC_BT2020_NCL:
      return SWS_CS_BT2020;
    default:
      return SWS_CS_ITU709;
  }
}

/// Bits of a pixel's deepest component.
int BitsOf(const AVPixFmtDescriptor& format) {
  int bits = 0;
  for (int i = 0; i < format.nb_components; ++i) bits = std::max(bits, format.comp[i].depth);
  return bits;
}

/// What libswscale makes of white in 16 bits: not 65,535 (FilmColors.EachStepOf10BitsIsKept,
/// FilmColors.WhiteIsTheLastStep).
int WhiteOf(const AVPixFmtDescriptor& format, bool full_range) {
  constexpr int kLimited = 65'283, kFull = 65'535;
  const int bits = BitsOf(format);
  if ((format.flags & AV_PIX_FMT_FLAG_RGB) != 0) return bits > 8 ? kFull : kLimited;
  return full_range ? ((1 << bits) - 1) << (16 - bits) : kLimited;
}

void StretchToWhite(int white, DeepImage* signal) {
  const auto factor = static_cast<std::uint64_t>((kSignals << 16) / static_cast<unsigned>(white));
  ParallelForBlocks(signal->size(), 3 * kPixelsTogether, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const std::uint64_t stretched = (signal->data()[i] * factor + 0x8000) >> 16;
      signal->data()[i] = static_cast<std::uint16_t>(std::min<std::uint64_t>(stretched, 0xFFFF));
    }
  });
}

}  // namespace

FilmPictures::FilmPictures(std::string name, FilmColors colors, DisplayTurn turn)
    : name_(std::move(name)), colors_(std::move(colors)), turn_(turn) {
  if (!colors_.IsConverted()) return;
  light_.resize(kSignals);
  for (std::size_t i = 0; i < kSignals; ++i) {
    light_[i] = static_cast<float>(colors_.Light(static_cast<double>(i) / (kSignals - 1)));
  }
  encoded_.resize(kLights);
  for (std::size_t i = 0; i < kLights; ++i) {
    const double root = static_cast<double>(i) / (kLights - 1);
    encoded_[i] =
        static_cast<std::uint16_t>(std::lround(colors_.Encoded(root * root) * (kSignals - 1)));
  }
}

Result<FilmPicture> FilmPictures::Convert(const AVFrame& frame) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  const auto refused = [&] {
    const char* words = av_get_pix_fmt_name(format);
    return InputError(name_,
                      std::string("has pixels of the form ") +
                          (words != nullptr ? words : "unknown") + ", which cannot be converted",
                      "convert it to MP4 with H.264");
  };
  const AVPixFmtDescriptor* facts = av_pix_fmt_desc_get(format);
  if (facts == nullptr || sws_isSupportedInput(format) == 0) return refused();
  const bool converted = colors_.IsConverted();
  const bool deep = converted || BitsOf(*facts) > 8;
  if (BitsOf(*facts) > 16) return refused();
  SwsContext* scaler = sws_getCachedContext(
      scaler_.release(), frame.width, frame.height, format, frame.width, frame.height,
      deep ? AV_PIX_FMT_RGB48 : AV_PIX_FMT_RGB24,
      SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr);
  scaler_.reset(scaler);
  if (scaler == nullptr) return refused();
  sws_setColorspaceDetails(scaler, sws_getCoefficients(ScalerMatrix(colors_.matrix)),
                           colors_.full_range ? 1 : 0, sws_getCoefficients(SWS_CS_ITU709), 1, 0,
                           1 << 16, 1 << 16);
  const auto scale = [&](std::uint8_t* target, int bytes_per_pixel) {
    std::uint8_t* rows[] = {target, nullptr, nullptr, nullptr};
    const int strides[] = {frame.width * bytes_per_pixel, 0, 0, 0};
    return sws_scale(scaler, frame.data, frame.linesize, 0, frame.height, rows, strides) ==
           frame.height;
  };
  FilmPicture picture;
  if (!deep) {
    RgbImage rgb(frame.width, frame.height, 3);
    if (!scale(rgb.data(), 3)) return refused();
    picture.rgb = turn_.Turned(std::move(rgb));
    return picture;
  }
  DeepImage signal(frame.width, frame.height, 3);
  if (!scale(reinterpret_cast<std::uint8_t*>(signal.data()), 6)) return refused();
  StretchToWhite(WhiteOf(*facts, colors_.full_range), &signal);
  if (converted) ThroughLight(&signal);
  picture.deep = turn_.Turned(std::move(signal));
  picture.rgb = RoundedTo8Bits(picture.deep);
  return picture;
}

void FilmPictures::ThroughLight(DeepImage* signal) const {
  std::array<float, 9> matrix{};
  std::copy(colors_.rec709_from_film.m.begin(), colors_.rec709_from_film.m.end(), matrix.begin());
  constexpr auto kMaxRoot = static_cast<float>(kLights - 1);
  ParallelForBlocks(signal->size() / 3, kPixelsTogether, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = 3 * first; i < 3 * end; i += 3) {
      std::uint16_t* pixel = signal->data() + i;
      const float r = light_[pixel[0]], g = light_[pixel[1]], b = light_[pixel[2]];
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = matrix[3 * c] * r + matrix[3 * c + 1] * g + matrix[3 * c + 2] * b;
        const float scaled = std::sqrt(std::clamp(light, 0.0F, 1.0F)) * kMaxRoot + 0.5F;
        pixel[c] = encoded_[static_cast<std::size_t>(scaled)];
      }
    }
  });
}

}  // namespace pleinair::devices
