#include "tracker/calibration/aruco_dictionaries.h"

#include <algorithm>
#include <cctype>
#include <opencv2/aruco.hpp>

namespace pleinair::tracker {
namespace {

struct Known {
  const char* name;
  int number;
  int markers;
};

/// Grouped by code size, the smallest of each first.
constexpr Known kKnown[] = {{"4x4_50", cv::aruco::DICT_4X4_50, 50},
                            {"4x4_100", cv::aruco::DICT_4X4_100, 100},
                            {"4x4_250", cv::aruco::DICT_4X4_250, 250},
                            {"4x4_1000", cv::aruco::DICT_4X4_1000, 1000},
                            {"5x5_50", cv::aruco::DICT_5X5_50, 50},
                            {"5x5_100", cv::aruco::DICT_5X5_100, 100},
                            {"5x5_250", cv::aruco::DICT_5X5_250, 250},
                            {"5x5_1000", cv::aruco::DICT_5X5_1000, 1000},
                            {"6x6_50", cv::aruco::DICT_6X6_50, 50},
                            {"6x6_100", cv::aruco::DICT_6X6_100, 100},
                            {"6x6_250", cv::aruco::DICT_6X6_250, 250},
                            {"6x6_1000", cv::aruco::DICT_6X6_1000, 1000},
                            {"7x7_50", cv::aruco::DICT_7X7_50, 50},
                            {"7x7_100", cv::aruco::DICT_7X7_100, 100},
                            {"7x7_250", cv::aruco::DICT_7X7_250, 250},
                            {"7x7_1000", cv::aruco::DICT_7X7_1000, 1000},
                            {"aruco_original", cv::aruco::DICT_ARUCO_ORIGINAL, 1024},
                            {"apriltag_16h5", cv::aruco::DICT_APRILTAG_16h5, 30},
                            {"apriltag_25h9", cv::aruco::DICT_APRILTAG_25h9, 35},
                            {"apriltag_36h10", cv::aruco::DICT_APRILTAG_36h10, 2320},
                            {"apriltag_36h11", cv::aruco::DICT_APRILTAG_36h11, 587}};

std::string_view KindOf(std::string_view name) {
  return name.starts_with("a") ? name : name.substr(0, 3);
}

Result<Known> Find(const std::string& name) {
  std::string plain;
  for (const char c : name) {
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (plain.starts_with("dict_")) plain.erase(0, 5);
  for (const Known& known : kKnown) {
    if (plain == known.name) return known;
  }
  std::string all;
  for (const Known& known : kKnown) all += (all.empty() ? "" : ", ") + std::string(known.name);
  return InputError("--dictionary", "\"" + name.substr(0, 64) + "\" is not known",
                    "known are " + all);
}

}  // namespace

Result<int> FindDictionary(const std::string& name) {
  PLEINAIR_ASSIGN_OR_RETURN(const Known known, Find(name));
  return known.number;
}

Result<void> CheckDictionary(const std::string& name, int markers) {
  PLEINAIR_ASSIGN_OR_RETURN(const Known known, Find(name));
  if (known.markers >= markers) return {};
  return InputError("--dictionary",
                    std::string(known.name) + " has " + std::to_string(known.markers) +
                        " markers, and the board needs " + std::to_string(markers),
                    "look on the board's sheet for the dictionary's name");
}

std::vector<std::string> DictionariesFor(int markers) {
  std::vector<std::string> names;
  std::string_view last_kind;
  for (const Known& known : kKnown) {
    if (known.markers < markers || KindOf(known.name) == last_kind) continue;
    last_kind = KindOf(known.name);
    names.emplace_back(known.name);
  }
  return names;
}

Result<MarkerPattern> ArucoMarkerPattern(const std::string& dictionary, int id) {
  PLEINAIR_ASSIGN_OR_RETURN(const Known known, Find(dictionary));
  PLEINAIR_RETURN_IF_ERROR(CheckDictionary(dictionary, id + 1));
  const auto codes = cv::aruco::getPredefinedDictionary(known.number);
  MarkerPattern marker;
  marker.modules = marker.edge_modules = codes->markerSize + 2;
  cv::Mat image;
  codes->drawMarker(id, marker.modules, image, 1);
  marker.white.assign(image.begin<std::uint8_t>(), image.end<std::uint8_t>());
  for (std::uint8_t& module : marker.white) module = module != 0 ? 1 : 0;
  return marker;
}

}  // namespace pleinair::tracker
