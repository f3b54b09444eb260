#pragma once

#include <string>

#include "base/error.h"

namespace pleinair::app {

/// While an object exists, Ctrl-C (SIGINT, SIGTERM) or a closed terminal (SIGHUP) only sets a flag.
/// The work can thus stop between two frames and clean up. The third or a later signal ends the
/// program, if two seconds have passed since the first.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool Interrupted();
};

/// Error if a stop was requested. `work`: name of the unfinished work, of which nothing was
/// written.
Result<void> CheckInterrupt(const std::string& work);

}  // namespace pleinair::app
