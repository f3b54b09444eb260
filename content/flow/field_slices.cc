#include "content/flow/field_slices.h"

#include <algorithm>

namespace pleinair::content {
namespace {

std::size_t BytesOf(const FieldSlice& slice) {
  return slice.singles.size() * sizeof(float) + slice.doubles.size() * sizeof(double);
}

template <typename T>
void BlendValues(const std::vector<T>& a, const std::vector<T>& b, double weight,
                 std::vector<T>* out) {
  out->resize(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    (*out)[i] = static_cast<T>((1.0 - weight) * static_cast<double>(a[i]) +
                               weight * static_cast<double>(b[i]));
  }
}

}  // namespace

Result<SharedSlice> FieldSlices::At(std::size_t time) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const auto& kept) { return kept.first == time; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().second;
  }
  // Room first: two slices are the most that memory has to hold.
  if (!kept_.empty()) {
    const std::size_t slice_bytes = std::max<std::size_t>(1, BytesOf(*kept_.front().second));
    const std::size_t room = std::max<std::size_t>(2, budget_bytes_ / slice_bytes);
    while (kept_.size() >= room) kept_.pop_back();
  }
  PLEINAIR_ASSIGN_OR_RETURN(FieldSlice read, read_(time));
  kept_.emplace_front(time, std::make_shared<const FieldSlice>(std::move(read)));
  return kept_.front().second;
}

FieldSlice Blend(const FieldSlice& a, const FieldSlice& b, double weight) {
  FieldSlice blended;
  BlendValues(a.singles, b.singles, weight, &blended.singles);
  BlendValues(a.doubles, b.doubles, weight, &blended.doubles);
  return blended;
}

}  // namespace pleinair::content
