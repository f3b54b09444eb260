#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstddef>
#include <span>
#include <vector>

#include "tracker/quads/dark_mask.h"

namespace pleinair::tracker {

/// Dark pixels begin … end - 1 of a row, and the next run of the same component (-1: none).
struct DarkRun {
  int y, begin, end;
  int next;
  int component;  ///< Component at the time of the scan; it may have been merged since.
};

/// A connected component of dark pixels (8-connected).
struct DarkComponent {
  int parent;  ///< Own index for a root; otherwise the component it was merged into.
  int min_x, max_x, min_y, max_y;
  int area;  ///< Pixels.
  int first_run, last_run;
};

/// Connected components of a mask by union-find over the runs of its rows, in one scan. He, Chao,
/// Suzuki, "A run-based two-scan labeling algorithm", IEEE TIP 17(5), 2008, section III. The runs
/// of a component form a linked list. A merge thus has constant cost, and a component's outline
/// needs no second scan.
class DarkComponents {
 public:
  /// Finds the components of at least one pixel. Buffers keep their capacity.
  void Find(const BitMask& mask);

  /// In the order of their first pixels; entries with parent != own index have been merged.
  const std::vector<DarkComponent>& components() const { return components_; }
  std::span<const DarkRun> runs() const { return {runs_.data(), static_cast<std::size_t>(count_)}; }

 private:
  int Root(int component);
  void Join(int run, int component);
  int Melt(int a, int b);

  std::vector<DarkRun> runs_;  // The first count_ are valid.
  int count_ = 0;
  std::vector<DarkComponent> components_;
};

}  // namespace pleinair::tracker
