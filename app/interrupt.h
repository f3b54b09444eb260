#pragma once

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

}  // namespace pleinair::app
