#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstddef>
#include <span>
#include <vector>

#include "tracker/quads/dark_mask.h"

namespace pleinair::tracker {

/// Dark pixels begin … end - 1 of a row, and the next run of the same component (-1: none).
struct DarkRun {
  int y, begin, end;
  int next;
  int component;  ///< When it was found; may have melted into another since.
};

/// Dark pixels that hang together over edges and corners.
struct DarkComponent {
  int parent;  ///< Its own number where it is one; of those melted into others, another's.
  int min_x, max_x, min_y, max_y;
  int area;  ///< Pixels.
  int first_run, last_run;
};

/// Connected components of a mask by union-find over the runs of its rows (He, Chao, Suzuki, "A
/// run-based two-scan labeling algorithm", IEEE TIP 17(5), 2008, section III), in one scan: the
/// runs of a component are a linked list, so that joining two is of constant cost and a component's
/// outline needs no second scan.
class DarkComponents {
 public:
  /// Components of at least one pixel. Buffers keep their capacity.
  void Find(const BitMask& mask);

  /// In order of their first pixels; those with parent != own number are none any more.
  const std::vector<DarkComponent>& components() const { return components_; }
  std::span<const DarkRun> runs() const { return {runs_.data(), static_cast<std::size_t>(count_)}; }

 private:
  int Root(int component);
  void Join(int run, int component);
  int Melt(int a, int b);

  std::vector<DarkRun> runs_;  // The first count_ of them.
  int count_ = 0;
  std::vector<DarkComponent> components_;
};

}  // namespace pleinair::tracker
