#include "app/options/picture_size.h"

#include <charconv>
#include <system_error>

namespace pleinair::app {

Result<ImageSize> ParsePictureSize(const std::string& option, const std::string& text) {
  constexpr int kMin = 16, kMax = 16384;
  ImageSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool has_cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = has_cross ? std::from_chars(width.ptr + 1, end, size.height)
                                : std::from_chars_result{end, std::errc::invalid_argument};
  const auto fits = [](int side) { return side >= kMin && side <= kMax; };
  if (height.ec != std::errc() || height.ptr != end || !fits(size.width) || !fits(size.height)) {
    return InputError(option, "\"" + text.substr(0, 40) + "\" is not a size",
                      "write WIDTHxHEIGHT in pixels, 16 to 16384 each, for example 1280x720");
  }
  return size;
}

}  // namespace pleinair::app
