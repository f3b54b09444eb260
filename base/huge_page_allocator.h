#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace pleinair {

/// Allocator for large tables that are read from end to end. Requests 2 MiB pages from the kernel:
/// the processor's prefetcher stops at page boundaries, and these are fewer. Falls back to normal
/// pages.
template <typename T>
class HugePageAllocator {
 public:
  using value_type = T;

  HugePageAllocator() = default;
  template <typename U>
  explicit HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* at = ::operator new(bytes, AlignmentOf(bytes));
    if (bytes >= kPage) madvise(at, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(at);
  }
  void deallocate(T* at, std::size_t count) {
    ::operator delete(at, AlignmentOf(count * sizeof(T)));
  }

  bool operator==(const HugePageAllocator&) const = default;

 private:
  static constexpr std::size_t kPage = std::size_t{2} << 20;

  static std::align_val_t AlignmentOf(std::size_t bytes) {
    return std::align_val_t{bytes >= kPage ? kPage : alignof(std::max_align_t)};
  }
};

}  // namespace pleinair
