#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace pleinair {

/// Calls `body(chunk)` once for every chunk 0…chunks−1 on `threads` threads (0: one per processor).
/// The assignment of chunks to threads is not deterministic, so the result of a body must depend on
/// its chunk alone. The threads are new ones and inherit the caller's priority.
//
// Not by oneTBB: the threads of its pool have one priority, and the light of a live session is
// computed at a lower one than its frames (session/background_light.h). A pool that both share
// would run light at the priority of frames, or let frames wait for chunks of light.
template <typename Body>
void ParallelFor(std::size_t chunks, int threads, const Body& body) {
  std::size_t count = threads > 0 ? static_cast<std::size_t>(threads)
                                  : std::max(1U, std::thread::hardware_concurrency());
  count = std::min(count, chunks);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) body(chunk);
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < count; ++i) others.emplace_back(work);
  work();
}

/// Calls `body(first, last)` once for every block of `size` indices below `count`, in parallel as
/// ParallelFor(). The last block may be smaller.
template <typename Body>
void ParallelForBlocks(std::size_t count, std::size_t size, const Body& body) {
  ParallelFor((count + size - 1) / size, 0,
              [&](std::size_t block) { body(block * size, std::min(count, (block + 1) * size)); });
}

}  // namespace pleinair
