#include "scene/cloudiness.h"

#include <cctype>
#include <initializer_list>
#include <string>

namespace pleinair::scene {

std::optional<Cloudiness> ParseCloudiness(std::string_view text) {
  // Padded with single spaces, so that "clear" does not match in "unclear".
  std::string words = " ";
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) != 0) {
      words += static_cast<char>(std::tolower(letter));
    } else if (words.back() != ' ') {
      words += ' ';
    }
  }
  words += ' ';
  const auto says = [&](std::initializer_list<const char*> any_of) {
    for (const char* word : any_of) {
      if (words.find(std::string(" ") + word + " ") != std::string::npos) return true;
    }
    return false;
  };
  if (says({"overcast", "covered"})) return Cloudiness::kOvercast;
  if (says({"partly", "partially", "scattered", "broken"})) return Cloudiness::kPartlyCloudy;
  if (says({"cloudy"})) return Cloudiness::kOvercast;
  if (says({"hazy", "haze"})) return Cloudiness::kHazy;
  if (says({"none", "clear", "cloudless", "few", "sunny", "no clouds"})) return Cloudiness::kClear;
  return std::nullopt;
}

}  // namespace pleinair::scene
