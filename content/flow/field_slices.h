#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/error.h"

namespace pleinair::content {

/// The velocities of all nodes of a grid at one time, in the order of StructuredGrid: node by node,
/// the components along GridField::axes(). Not a number: a wall. In the precision of the file; the
/// other vector is empty.
struct FieldSlice {
  std::vector<float> singles;
  std::vector<double> doubles;

  std::size_t size() const { return singles.size() + doubles.size(); }
};
using SharedSlice = std::shared_ptr<const FieldSlice>;

/// The times of a field. Reads them when they are needed, and keeps as many as fit into a budget,
/// at least two. Thread-safe.
class FieldSlices {
 public:
  using Read = std::function<Result<FieldSlice>(std::size_t time)>;

  /// `read` gives the slice of a time; it is called by one thread at a time.
  explicit FieldSlices(Read read, std::size_t budget_bytes = kUsualBudgetBytes)
      : read_(std::move(read)), budget_bytes_(budget_bytes) {}

  Result<SharedSlice> At(std::size_t time);

  static constexpr std::size_t kUsualBudgetBytes = std::size_t{512} << 20;

 private:
  Read read_;
  std::size_t budget_bytes_;
  std::mutex mutex_;
  std::list<std::pair<std::size_t, SharedSlice>> kept_;  // The latest used first.
};

/// (1 − weight) a + weight b. Both have the same precision and size.
FieldSlice Blend(const FieldSlice& a, const FieldSlice& b, double weight);

}  // namespace pleinair::content
