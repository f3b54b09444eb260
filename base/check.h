#pragma once

#include <cstdlib>
#include <iostream>

/// Checks an invariant of this library; prints both operands and aborts if it is broken. Never used
/// to validate input.
#define PLEINAIR_CHECK_OP(a, op, b)                                                         \
  do {                                                                                      \
    const auto& check_a = (a);                                                              \
    const auto& check_b = (b);                                                              \
    if (!(check_a op check_b)) {                                                            \
      std::cerr << __FILE__ << ":" << __LINE__ << ": CHECK failed: " #a " " #op " " #b " (" \
                << check_a << " vs. " << check_b << ")\n";                                  \
      std::abort();                                                                         \
    }                                                                                       \
  } while (false)

#define CHECK_EQ(a, b) PLEINAIR_CHECK_OP(a, ==, b)
#define CHECK_NE(a, b) PLEINAIR_CHECK_OP(a, !=, b)
#define CHECK_LT(a, b) PLEINAIR_CHECK_OP(a, <, b)
#define CHECK_LE(a, b) PLEINAIR_CHECK_OP(a, <=, b)
#define CHECK_GT(a, b) PLEINAIR_CHECK_OP(a, >, b)
#define CHECK_GE(a, b) PLEINAIR_CHECK_OP(a, >=, b)
