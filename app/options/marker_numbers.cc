#include "app/options/marker_numbers.h"

#include <charconv>

namespace pleinair::app {

Result<std::vector<int>> MarkerNumbersOf(const std::vector<std::string>& texts) {
  std::vector<int> numbers;
  for (const std::string& text : texts) {
    int first = -1, last = -1;
    const char* end = text.data() + text.size();
    auto [at, status] = std::from_chars(text.data(), end, first);
    last = first;
    if (status == std::errc() && at != end && *at == '-') {
      const auto second = std::from_chars(at + 1, end, last);
      at = second.ptr;
      status = second.ec;
    }
    if (status != std::errc() || at != end || first < 0 || last < first || last > 4095) {
      return InputError("--numbers", "\"" + text + "\" is no number or range within 0-4095",
                        "write for example 17 or 0-49");
    }
    for (int number = first; number <= last; ++number) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace pleinair::app
