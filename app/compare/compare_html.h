#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/compare/image_scores.h"

namespace pleinair::app {

/// One picture beside its truth; JPEG bytes.
struct ComparedPicture {
  std::string name;
  PictureScores scores;
  std::vector<std::uint8_t> truth_jpeg, picture_jpeg, difference_jpeg;
};

struct Comparison {
  std::string command, pictures, truth;  ///< As called; the two folders.
  std::vector<ComparedPicture> compared;
  PictureScores mean;
  std::string time_lapse;  ///< Part of the page that shows the day; empty without.
};

/// A page without any external resource: scores as a table, and of every picture the truth, ours
/// and the difference.
std::string CompareHtml(const Comparison& comparison);

}  // namespace pleinair::app
