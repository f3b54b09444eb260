#include "scene/leaf_contents.h"

#include <cmath>
#include <cstdio>

namespace pleinair::scene {
namespace {

std::string ShortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace

Result<void> CheckLeafQuantity(const LeafQuantity& quantity, double value,
                               const std::string& where) {
  // Written so that NaN is refused.
  if (value >= quantity.low && value <= quantity.high) return {};
  return InputError(where,
                    std::string(quantity.key) + " is " + ShortNumber(value) + ": " +
                        ShortNumber(quantity.low) + " to " + ShortNumber(quantity.high) +
                        quantity.unit,
                    quantity.remedy);
}

Result<double> ChlorophyllOfSpad(double spad, const std::string& where) {
  constexpr double kMaxSpad = 82.0;                   // 147 µg/cm².
  constexpr double kMicrogramsPerMicromole = 0.0893;  // Per cm² and per m².
  if (spad >= 0.0 && spad <= kMaxSpad) {
    return kMicrogramsPerMicromole * std::pow(10.0, std::pow(spad, 0.265));
  }
  return InputError(where, "spad is " + ShortNumber(spad) + ": 0 to " + ShortNumber(kMaxSpad),
                    "leaves read 20 to 60");
}

}  // namespace pleinair::scene
