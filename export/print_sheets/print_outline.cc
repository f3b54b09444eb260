#include "export/print_sheets/print_outline.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace pleinair::exports {
namespace {

// Directions clockwise with y down, so that right is +1 and left is +3.
enum Direction { kEast, kSouth, kWest, kNorth };
constexpr std::array<ModuleCorner, 4> kStep = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

class BlackModules {
 public:
  explicit BlackModules(const tracker::MarkerPattern& print) : print_(print) {}
  bool operator()(int x, int y) const {
    if (x < 0 || y < 0 || x >= print_.modules || y >= print_.modules) return false;
    return print_.white[static_cast<std::size_t>(y) * print_.modules + x] == 0;
  }
  /// The module to the right or left of the edge from `corner` in `direction`.
  bool RightOf(ModuleCorner corner, int direction) const {
    constexpr std::array<ModuleCorner, 4> kModule = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
    return (*this)(corner.x + kModule[direction].x, corner.y + kModule[direction].y);
  }
  bool LeftOf(ModuleCorner corner, int direction) const {
    return RightOf(corner, (direction + 3) % 4);
  }

 private:
  const tracker::MarkerPattern& print_;
};

}  // namespace

std::vector<std::vector<ModuleCorner>> TraceBlackOutlines(const tracker::MarkerPattern& print) {
  const BlackModules black(print);
  // A loop has black on its right. Each loop contains an edge going east with black below. These
  // edges are marked, so that each loop is traced once.
  std::vector<std::uint8_t> walked(static_cast<std::size_t>(print.modules) * print.modules, 0);
  std::vector<std::vector<ModuleCorner>> loops;
  for (int y = 0; y < print.modules; ++y) {
    for (int x = 0; x < print.modules; ++x) {
      const std::size_t module = static_cast<std::size_t>(y) * print.modules + x;
      if (walked[module] != 0 || !black(x, y) || black(x, y - 1)) continue;
      std::vector<ModuleCorner> loop;
      ModuleCorner at{x, y};
      int direction = kEast;
      do {
        if (direction == kEast) walked[static_cast<std::size_t>(at.y) * print.modules + at.x] = 1;
        at = {at.x + kStep[direction].x, at.y + kStep[direction].y};
        // Follow the module on the right: turn right where it ends, so that modules touching at a
        // corner stay separate. Turn left where black lies ahead on the left.
        int next = direction;
        if (!black.RightOf(at, direction)) {
          next = (direction + 1) % 4;
        } else if (black.LeftOf(at, direction)) {
          next = (direction + 3) % 4;
        }
        if (next != direction) loop.push_back(at);
        direction = next;
      } while (!(at == ModuleCorner{x, y} && direction == kEast));
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

}  // namespace pleinair::exports
