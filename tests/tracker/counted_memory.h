#pragma once

namespace pleinair::tracker {

// What a test program asks of memory. A program that has counted_memory.cc among its sources counts
// every operator new and delete of its own and of the libraries it is linked with.

/// Times that memory was asked for since the program began.
long Allocations();

/// Bytes that are held now, as malloc counts them.
long LiveBytes();

}  // namespace pleinair::tracker
