#include "app/place/transform_warnings.h"

namespace pleinair::app {

std::vector<std::string> TransformWarnings(const content::TransformFacts& facts) {
  std::vector<std::string> warnings;
  if (facts.datum_unknown) {
    warnings.emplace_back(
        "PROJ knows no relation of its datum to WGS 84; places may be wrong by hundreds of metres");
  }
  if (!facts.missing_grids.empty()) {
    const std::string& grid = facts.missing_grids.front();
    warnings.push_back("a more accurate transformation needs the grid " + grid +
                       "; \"projsync --file " + grid + "\" (package proj-bin) installs it");
  }
  if (facts.place_outside_area) {
    warnings.push_back("the marker lies outside the area of use of " + facts.crs + ", " +
                       facts.area);
  }
  return warnings;
}

}  // namespace pleinair::app
