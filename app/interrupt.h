#pragma once

namespace pleinair::app {

/// While one of these lives, the first Ctrl-C (SIGINT, SIGTERM) only sets a flag, so that the work
/// can stop between two frames and clean up; the second one ends the program as usual.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool Interrupted();
};

}  // namespace pleinair::app
