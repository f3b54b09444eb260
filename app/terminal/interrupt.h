#pragma once

#include <string>

#include "base/error.h"

namespace pleinair::app {

/// While one of these lives, Ctrl-C (SIGINT, SIGTERM) only sets a flag, so that the work can stop
/// between two frames and clean up. The third one, or a later one, ends the program as usual once
/// two seconds have passed since the first.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool Interrupted();
};

/// Error where somebody asked to stop; `work` is what is worked on, of which nothing was written.
Result<void> CheckInterrupt(const std::string& work);

}  // namespace pleinair::app
