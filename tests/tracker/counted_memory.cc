#include "tests/tracker/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> allocations = 0;
std::atomic<long> live_bytes = 0;

void* Take(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) return nullptr;
  ++allocations;
  live_bytes += static_cast<long>(malloc_usable_size(memory));
  return memory;
}

void Release(void* memory) {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* const memory = Take(size)) return memory;
  throw std::bad_alloc();
}
// The standard library takes and frees temporary buffers without exceptions.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return Take(size); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { Release(memory); }
void operator delete(void* memory) noexcept { Release(memory); }
void operator delete(void* memory, std::size_t) noexcept { Release(memory); }

namespace pleinair::tracker {

long Allocations() { return allocations; }
long LiveBytes() { return live_bytes; }

}  // namespace pleinair::tracker
