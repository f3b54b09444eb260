#include "devices/films/film_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include "base/parallel_for.h"

namespace pleinair::devices {
namespace {

constexpr std::size_t kSignals = 65'536;
// In steps of the square root of light, since powers of 1/2.2 and 1/2.8 are infinitely steep at
// black. One step changes the signal by less than a tenth of an 8-bit step in every curve.
constexpr std::size_t kLights = 65'536;
constexpr std::size_t kRowsTogether = 32;

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
    encoded_[i] = static_cast<std::uint8_t>(std::lround(colors_.Encoded(root * root) * 255.0));
  }
}

Result<RgbImage> FilmPictures::Convert(const AVFrame& frame) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  const auto refused = [&] {
    const char* words = av_get_pix_fmt_name(format);
    return InputError(name_,
                      std::string("has pixels of the form ") +
                          (words != nullptr ? words : "unknown") + ", which cannot be converted",
                      "convert it to MP4 with H.264");
  };
  if (sws_isSupportedInput(format) == 0) return refused();
  const bool converted = colors_.IsConverted();
  SwsContext* scaler = sws_getCachedContext(
      scaler_.release(), frame.width, frame.height, format, frame.width, frame.height,
      converted ? AV_PIX_FMT_RGB48 : AV_PIX_FMT_RGB24,
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
  if (converted) {
    std::vector<std::uint16_t> signal(static_cast<std::size_t>(frame.width) * frame.height * 3);
    if (!scale(reinterpret_cast<std::uint8_t*>(signal.data()), 6)) return refused();
    return turn_.Turned(ThroughLight(signal, frame.width, frame.height));
  }
  RgbImage rgb(frame.width, frame.height, 3);
  if (!scale(rgb.data(), 3)) return refused();
  return turn_.Turned(std::move(rgb));
}

RgbImage FilmPictures::ThroughLight(const std::vector<std::uint16_t>& signal, int width,
                                    int height) const {
  RgbImage rgb(width, height, 3);
  std::array<float, 9> matrix{};
  std::copy(colors_.rec709_from_film.m.begin(), colors_.rec709_from_film.m.end(), matrix.begin());
  constexpr auto kMaxRoot = static_cast<float>(kLights - 1);
  const auto rows = static_cast<std::size_t>(height);
  ParallelFor((rows + kRowsTogether - 1) / kRowsTogether, 0, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kRowsTogether * width * 3;
    const std::size_t end = std::min(rows, (chunk + 1) * kRowsTogether) * width * 3;
    for (std::size_t i = begin; i < end; i += 3) {
      const float r = light_[signal[i]], g = light_[signal[i + 1]], b = light_[signal[i + 2]];
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = matrix[3 * c] * r + matrix[3 * c + 1] * g + matrix[3 * c + 2] * b;
        const float scaled = std::sqrt(std::clamp(light, 0.0F, 1.0F)) * kMaxRoot + 0.5F;
        rgb.data()[i + c] = encoded_[static_cast<std::size_t>(scaled)];
      }
    }
  });
  return rgb;
}

}  // namespace pleinair::devices
