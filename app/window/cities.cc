#include "app/window/cities.h"

#include <array>
#include <cctype>
#include <string>

namespace pleinair::app {
namespace {

// City halls and main squares, to a hundredth of a degree: 1 km, which does not visibly change the
// sun.
constexpr std::array kCities = {
    City{"Accra", 5.56, -0.20},         City{"Addis Ababa", 9.03, 38.74},
    City{"Amsterdam", 52.37, 4.90},     City{"Anchorage", 61.22, -149.90},
    City{"Athens", 37.98, 23.73},       City{"Auckland", -36.85, 174.76},
    City{"Bangkok", 13.76, 100.50},     City{"Barcelona", 41.39, 2.17},
    City{"Beijing", 39.90, 116.41},     City{"Berlin", 52.52, 13.40},
    City{"Bogotá", 4.71, -74.07},       City{"Brno", 49.20, 16.61},
    City{"Brussels", 50.85, 4.35},      City{"Buenos Aires", -34.60, -58.38},
    City{"Cairo", 30.04, 31.24},        City{"Cape Town", -33.92, 18.42},
    City{"Chicago", 41.88, -87.63},     City{"Copenhagen", 55.68, 12.57},
    City{"Delhi", 28.61, 77.21},        City{"Denver", 39.74, -104.99},
    City{"Dubai", 25.20, 55.27},        City{"Dublin", 53.35, -6.26},
    City{"Edinburgh", 55.95, -3.19},    City{"Hanoi", 21.03, 105.85},
    City{"Helsinki", 60.17, 24.94},     City{"Hong Kong", 22.32, 114.17},
    City{"Honolulu", 21.31, -157.86},   City{"Istanbul", 41.01, 28.98},
    City{"Jakarta", -6.21, 106.85},     City{"Johannesburg", -26.20, 28.05},
    City{"Kuala Lumpur", 3.14, 101.69}, City{"Kyiv", 50.45, 30.52},
    City{"Lagos", 6.52, 3.38},          City{"Lima", -12.05, -77.04},
    City{"Lisbon", 38.72, -9.14},       City{"London", 51.51, -0.13},
    City{"Longyearbyen", 78.22, 15.65}, City{"Los Angeles", 34.05, -118.24},
    City{"Madrid", 40.42, -3.70},       City{"Manila", 14.60, 120.98},
    City{"Melbourne", -37.81, 144.96},  City{"Mexico City", 19.43, -99.13},
    City{"Milan", 45.46, 9.19},         City{"Montréal", 45.50, -73.57},
    City{"Moscow", 55.76, 37.62},       City{"Mumbai", 19.08, 72.88},
    City{"Munich", 48.14, 11.58},       City{"Nairobi", -1.29, 36.82},
    City{"New York", 40.71, -74.01},    City{"Oslo", 59.91, 10.75},
    City{"Paris", 48.86, 2.35},         City{"Perth", -31.95, 115.86},
    City{"Prague", 50.09, 14.42},       City{"Quito", -0.18, -78.47},
    City{"Reykjavík", 64.15, -21.94},   City{"Rio de Janeiro", -22.91, -43.17},
    City{"Rome", 41.90, 12.50},         City{"San Francisco", 37.77, -122.42},
    City{"Santiago", -33.45, -70.67},   City{"São Paulo", -23.55, -46.63},
    City{"Seattle", 47.61, -122.33},    City{"Seoul", 37.57, 126.98},
    City{"Shanghai", 31.23, 121.47},    City{"Singapore", 1.35, 103.82},
    City{"Stockholm", 59.33, 18.07},    City{"Sydney", -33.87, 151.21},
    City{"Tehran", 35.69, 51.39},       City{"Tel Aviv", 32.09, 34.78},
    City{"Tokyo", 35.68, 139.69},       City{"Toronto", 43.65, -79.38},
    City{"Tromsø", 69.65, 18.96},       City{"Ushuaia", -54.80, -68.30},
    City{"Vancouver", 49.28, -123.12},  City{"Vienna", 48.21, 16.37},
    City{"Warsaw", 52.23, 21.01},       City{"Wellington", -41.29, 174.78},
    City{"Zürich", 47.37, 8.54},
};

/// Converts to lower case and replaces the accented letters of the list's names.
std::string Plain(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 10> kLetters{{{"á", 'a'},
                                                                        {"ã", 'a'},
                                                                        {"é", 'e'},
                                                                        {"í", 'i'},
                                                                        {"ø", 'o'},
                                                                        {"ü", 'u'},
                                                                        {"Ø", 'o'},
                                                                        {"Ü", 'u'},
                                                                        {"Á", 'a'},
                                                                        {"É", 'e'}}};
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t length = 0;
    for (const auto& [letter, replacement] : kLetters) {
      if (text.substr(i).starts_with(letter)) {
        plain += replacement;
        length = letter.size();
        break;
      }
    }
    if (length == 0) {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
      length = 1;
    }
    i += length;
  }
  return plain;
}

}  // namespace

std::span<const City> Cities() { return kCities; }

std::vector<City> FindCities(std::string_view text) {
  const std::string wanted = Plain(text);
  std::vector<City> found;
  for (const City& city : kCities) {
    const std::string name = Plain(city.name);
    for (std::size_t word = 0; word != std::string::npos;) {
      if (name.compare(word, wanted.size(), wanted) == 0) {
        found.push_back(city);
        break;
      }
      word = name.find(' ', word);
      if (word != std::string::npos) ++word;
    }
  }
  return found;
}

}  // namespace pleinair::app
