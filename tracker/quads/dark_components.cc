#include "tracker/quads/dark_components.h"

#include <algorithm>
#include <bit>

namespace pleinair::tracker {

int DarkComponents::Root(int component) {
  while (components_[component].parent != component) {
    const int parent = components_[component].parent;
    components_[component].parent = components_[parent].parent;  // Path halving.
    component = parent;
  }
  return component;
}

void DarkComponents::Join(int run, int component) {
  DarkComponent& c = components_[component];
  const DarkRun& r = runs_[run];
  c.min_x = std::min(c.min_x, r.begin);
  c.max_x = std::max(c.max_x, r.end - 1);
  c.max_y = r.y;  // Runs are in the order of rows.
  c.area += r.end - r.begin;
  runs_[c.last_run].next = run;
  c.last_run = run;
}

int DarkComponents::Melt(int a, int b) {
  if (a == b) return a;
  if (a > b) std::swap(a, b);
  DarkComponent &keep = components_[a], &gone = components_[b];
  gone.parent = a;
  keep.min_x = std::min(keep.min_x, gone.min_x);
  keep.max_x = std::max(keep.max_x, gone.max_x);
  keep.min_y = std::min(keep.min_y, gone.min_y);
  keep.max_y = std::max(keep.max_y, gone.max_y);
  keep.area += gone.area;
  runs_[keep.last_run].next = gone.first_run;
  keep.last_run = gone.last_run;
  return a;
}

void DarkComponents::Find(const BitMask& mask) {
  count_ = 0;
  components_.clear();
  int above = 0, above_end = 0;  // Runs of the row above.
  for (int y = 0; y < mask.height; ++y) {
    const int row_begin = count_;
    // A row has at most one run per two pixels: reserve the memory once.
    const std::size_t room = static_cast<std::size_t>(count_) + mask.width / 2 + 1;
    if (runs_.size() < room) runs_.resize(room + room / 2);
    DarkRun* const runs = runs_.data();
    const std::uint64_t* words = mask.row(y);
    std::uint64_t carry = 0;
    int begin = -1;
    const auto add_run = [&](int end) {
      const int run = count_++;
      // 8-connectivity: one pixel of reach on either side.
      while (above < above_end && runs[above].end < begin) ++above;
      int component = -1;
      for (int i = above; i < above_end && runs[i].begin <= end; ++i) {
        const int other = Root(runs[i].component);
        component = component < 0 ? other : Melt(component, other);
      }
      const bool first = component < 0;
      if (first) component = static_cast<int>(components_.size());
      runs[run] = {y, begin, end, -1, component};
      if (first) {
        components_.push_back({component, begin, end - 1, y, y, end - begin, run, run});
      } else {
        Join(run, component);
      }
      begin = -1;
    };
    for (int w = 0; w < mask.words_per_row; ++w) {
      const std::uint64_t word = words[w];
      std::uint64_t changes = word ^ (word << 1 | carry);
      carry = word >> 63;
      while (changes != 0) {
        const int x = 64 * w + std::countr_zero(changes);
        changes &= changes - 1;
        if (begin < 0) {
          begin = x;
        } else {
          add_run(x);
        }
      }
    }
    if (begin >= 0) add_run(mask.width);
    above = row_begin;
    above_end = count_;
  }
}

}  // namespace pleinair::tracker
