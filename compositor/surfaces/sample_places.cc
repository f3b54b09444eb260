#include "compositor/surfaces/sample_places.h"

namespace pleinair::compositor {
namespace {

constexpr int kLattice = 16, kGenerator = 11, kShift = 12;
constexpr float kWithinCell = 0.125F;

std::vector<glm::vec2> TurnedLattices() {
  std::vector<glm::vec2> places;
  for (int turn = 0; turn < 4; ++turn) {
    for (int i = 0; i < kLattice; ++i) {
      const int row = (kGenerator * i + kShift) % kLattice;
      glm::vec2 at((static_cast<float>(i) + kWithinCell) / kLattice - 0.5F,
                   (static_cast<float>(row) + kWithinCell) / kLattice - 0.5F);
      for (int quarter = 0; quarter < turn; ++quarter) at = {-at.y, at.x};
      places.push_back(at);
    }
  }
  return places;
}

}  // namespace

std::vector<glm::vec2> SamplePlaces(int count) {
  if (count == 4 * kLattice) return TurnedLattices();
  std::vector<glm::vec2> places;
  for (int i = 0; i < count; ++i) {
    int row = 0;
    for (int bit = 1; bit < count; bit *= 2) row = 2 * row + ((i / bit) & 1);
    row ^= count / 2;
    places.emplace_back((static_cast<float>(i) + 0.5F) / static_cast<float>(count) - 0.5F,
                        (static_cast<float>(row) + 0.5F) / static_cast<float>(count) - 0.5F);
  }
  return places;
}

}  // namespace pleinair::compositor
