#include "devices/cameras/format_choice.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pleinair::devices {
namespace {

constexpr double kSmooth_hz = 25.0;
constexpr int kMaxWidth = 1920, kMaxHeight = 1080;

std::string Text(ImageSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string Text(double rate_hz) {
  std::string text = std::to_string(std::round(rate_hz * 100.0) / 100.0);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " Hz";
}

int Rank(PixelFormat format) {
  return static_cast<int>(std::find(std::begin(kPixelFormats), std::end(kPixelFormats), format) -
                          std::begin(kPixelFormats));
}

double NearestRate(const std::vector<double>& rates, double requested) {
  return *std::min_element(rates.begin(), rates.end(), [&](double a, double b) {
    return std::fabs(a - requested) < std::fabs(b - requested);
  });
}

}  // namespace

Result<FormatChoice> ChooseFormat(const std::vector<FormatDescription>& formats,
                                  const FormatRequest& requested, const std::string& where) {
  // Greater is better: first a smooth rate, then size, then rate, then our preferred format.
  using Merit = std::tuple<bool, double, double, int>;
  std::optional<Merit> best;
  FormatChoice choice;
  std::string names;
  for (const FormatDescription& format : formats) {
    names += (names.empty() ? "" : ", ") + format.name;
    if (!format.format || (requested.format && format.format != requested.format)) continue;
    std::vector<FormatDescription::Size> sizes = format.sizes;
    if (sizes.empty()) sizes.push_back({requested.size.value_or(ImageSize{}), {}});
    for (const FormatDescription::Size& at : sizes) {
      const double rate = at.rates_hz.empty() ? requested.rate_hz.value_or(0.0)
                          : requested.rate_hz ? NearestRate(at.rates_hz, *requested.rate_hz)
                                              : at.rates_hz.front();
      const bool smooth = at.rates_hz.empty() ||
                          rate >= std::min(kSmooth_hz, requested.rate_hz.value_or(kSmooth_hz));
      const bool fits = at.size.width <= kMaxWidth && at.size.height <= kMaxHeight;
      const double area = static_cast<double>(at.size.width) * at.size.height;
      const double size_merit = requested.size
                                    ? -std::hypot(at.size.width - requested.size->width,
                                                  at.size.height - requested.size->height)
                                : fits ? area
                                       : -area;
      // More than 60 Hz has no benefit.
      const double rate_merit =
          requested.rate_hz ? -std::fabs(rate - *requested.rate_hz) : std::min(rate, 60.0);
      const Merit merit = requested.size
                              ? Merit{true, size_merit, rate_merit, -Rank(*format.format)}
                              : Merit{smooth, size_merit, rate_merit, -Rank(*format.format)};
      if (best && merit <= *best) continue;
      best = merit;
      choice.format = *format.format;
      choice.size =
          at.size.width > 0 ? std::optional(requested.size.value_or(at.size)) : std::nullopt;
      choice.rate_hz = requested.rate_hz     ? requested.rate_hz
                       : at.rates_hz.empty() ? std::nullopt
                                             : std::optional(rate);
    }
  }
  if (best) return choice;
  const std::string wanted = requested.format ? std::string(NameOf(*requested.format)) : "";
  return InputError(where,
                    requested.format ? "does not send " + wanted + " but " + names
                                     : "sends no supported format, but " +
                                           (names.empty() ? std::string("nothing") : names),
                    requested.format ? "request one of these, or leave the format out"
                                     : "use it through libcamera, or another camera");
}

std::vector<std::string> Differences(const FormatRequest& requested,
                                     const NegotiatedFormat& negotiated) {
  std::vector<std::string> details;
  if (requested.format && *requested.format != negotiated.format) {
    details.push_back("requested " + std::string(NameOf(*requested.format)) + ", got " +
                      std::string(NameOf(negotiated.format)));
  }
  if (requested.size && *requested.size != negotiated.size) {
    details.push_back("requested " + Text(*requested.size) + ", got " + Text(negotiated.size));
  }
  if (requested.rate_hz && !negotiated.rate_hz) {
    details.push_back("requested " + Text(*requested.rate_hz) + ", but the camera reports no rate");
  } else if (requested.rate_hz &&
             std::fabs(*requested.rate_hz - *negotiated.rate_hz) > 0.01 * *requested.rate_hz) {
    details.push_back("requested " + Text(*requested.rate_hz) + ", got " +
                      Text(*negotiated.rate_hz));
  }
  return details;
}

}  // namespace pleinair::devices
