#include "files/base64.h"

#include <algorithm>
#include <cstddef>

namespace pleinair::files {

std::string Base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned word = static_cast<unsigned>(bytes[i]) << 16;
    if (count > 1) word |= static_cast<unsigned>(bytes[i + 1]) << 8;
    if (count > 2) word |= bytes[i + 2];
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kAlphabet[(word >> (18 - 6 * k)) & 63] : '=';
    }
  }
  return text;
}

}  // namespace pleinair::files
