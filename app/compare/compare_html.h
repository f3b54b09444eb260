#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/compare/image_scores.h"

namespace pleinair::app {

/// An image with its ground truth; JPEG bytes.
struct ComparedPicture {
  std::string name;
  PictureScores scores;
  std::vector<std::uint8_t> truth_jpeg, picture_jpeg, difference_jpeg;
};

struct Comparison {
  std::string command, pictures, truth;  ///< As called; the two folders.
  std::vector<ComparedPicture> compared;
  PictureScores mean;
  std::string time_lapse;  ///< HTML fragment that shows the day; empty without.
};

/// Returns a page without external resources: a table of scores, and for every image the ground
/// truth, our image and the difference.
std::string CompareHtml(const Comparison& comparison);

}  // namespace pleinair::app
