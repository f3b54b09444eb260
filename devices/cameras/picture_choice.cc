#include "devices/cameras/picture_choice.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pleinair::devices {
namespace {

constexpr double kSmooth_hz = 25.0;
constexpr int kLargestWidth = 1920, kLargestHeight = 1080;

std::string Words(PictureSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string Words(double rate_hz) {
  std::string text = std::to_string(std::round(rate_hz * 100.0) / 100.0);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " Hz";
}

int Rank(PixelFormat format) {
  return static_cast<int>(std::find(std::begin(kPixelFormats), std::end(kPixelFormats), format) -
                          std::begin(kPixelFormats));
}

double NearestRate(const std::vector<double>& rates, double wish) {
  return *std::min_element(rates.begin(), rates.end(), [&](double a, double b) {
    return std::fabs(a - wish) < std::fabs(b - wish);
  });
}

}  // namespace

Result<PictureChoice> ChoosePictures(const std::vector<FormatDescription>& formats,
                                     const PictureWish& wish, const std::string& where) {
  // Greater is better: smooth, then the size, then the rate, then the format we like best.
  using Merit = std::tuple<bool, double, double, int>;
  std::optional<Merit> best;
  PictureChoice choice;
  std::string names;
  for (const FormatDescription& format : formats) {
    names += (names.empty() ? "" : ", ") + format.name;
    if (!format.format || (wish.format && format.format != wish.format)) continue;
    std::vector<FormatDescription::Size> sizes = format.sizes;
    if (sizes.empty()) sizes.push_back({wish.size.value_or(PictureSize{}), {}});
    for (const FormatDescription::Size& at : sizes) {
      const double rate = at.rates_hz.empty() ? wish.rate_hz.value_or(0.0)
                          : wish.rate_hz      ? NearestRate(at.rates_hz, *wish.rate_hz)
                                              : at.rates_hz.front();
      const bool smooth =
          at.rates_hz.empty() || rate >= std::min(kSmooth_hz, wish.rate_hz.value_or(kSmooth_hz));
      const bool fits = at.size.width <= kLargestWidth && at.size.height <= kLargestHeight;
      const double area = static_cast<double>(at.size.width) * at.size.height;
      const double size_merit = wish.size ? -std::hypot(at.size.width - wish.size->width,
                                                        at.size.height - wish.size->height)
                                : fits    ? area
                                          : -area;
      // Faster than 60 Hz gains nothing.
      const double rate_merit =
          wish.rate_hz ? -std::fabs(rate - *wish.rate_hz) : std::min(rate, 60.0);
      const Merit merit = wish.size ? Merit{true, size_merit, rate_merit, -Rank(*format.format)}
                                    : Merit{smooth, size_merit, rate_merit, -Rank(*format.format)};
      if (best && merit <= *best) continue;
      best = merit;
      choice.format = *format.format;
      choice.size = at.size.width > 0 ? std::optional(wish.size.value_or(at.size)) : std::nullopt;
      choice.rate_hz = wish.rate_hz          ? wish.rate_hz
                       : at.rates_hz.empty() ? std::nullopt
                                             : std::optional(rate);
    }
  }
  if (best) return choice;
  const std::string wanted = wish.format ? std::string(NameOf(*wish.format)) : "";
  return InputError(where,
                    wish.format ? "does not send " + wanted + " but " + names
                                : "sends no pictures that are read here, but " +
                                      (names.empty() ? std::string("nothing") : names),
                    wish.format ? "ask for one of these, or for none in particular"
                                : "use it through libcamera, or another camera");
}

std::vector<std::string> Differences(const PictureWish& wish, const PictureAgreement& agreement) {
  std::vector<std::string> words;
  if (wish.format && *wish.format != agreement.format) {
    words.push_back("asked for " + std::string(NameOf(*wish.format)) + ", got " +
                    std::string(NameOf(agreement.format)));
  }
  if (wish.size && *wish.size != agreement.size) {
    words.push_back("asked for " + Words(*wish.size) + ", got " + Words(agreement.size));
  }
  if (wish.rate_hz && !agreement.rate_hz) {
    words.push_back("asked for " + Words(*wish.rate_hz) + ", but the camera says no rate");
  } else if (wish.rate_hz && std::fabs(*wish.rate_hz - *agreement.rate_hz) > 0.01 * *wish.rate_hz) {
    words.push_back("asked for " + Words(*wish.rate_hz) + ", got " + Words(*agreement.rate_hz));
  }
  return words;
}

}  // namespace pleinair::devices
