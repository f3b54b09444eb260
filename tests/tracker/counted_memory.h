#pragma once

namespace pleinair::tracker {

// Counts the memory that a test program allocates. A program with counted_memory.cc among its
// sources counts every operator new and delete, including those of its libraries.

/// Number of allocations since the program's start.
long Allocations();

/// Bytes allocated now, as reported by malloc.
long LiveBytes();

}  // namespace pleinair::tracker
