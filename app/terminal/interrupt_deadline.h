#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace pleinair::app {

/// While an object exists, an interrupt ends the program within a second, also during a long step
/// that does not look for one: building a hierarchy of a million triangles, drawing a frame. Work
/// that returns sooner ends as usual. Needs an InterruptGuard.
class InterruptDeadline {
 public:
  /// `work`: its name in the message. `clean_up` removes what is unfinished; it runs on a thread of
  /// its own while the work goes on, and the program ends after it with exit code 1.
  InterruptDeadline(std::string work, std::function<void()> clean_up);
  /// The work has ended, or enters a step that must not be cut.
  ~InterruptDeadline();
  InterruptDeadline(const InterruptDeadline&) = delete;
  InterruptDeadline& operator=(const InterruptDeadline&) = delete;

 private:
  void Watch();

  std::string work_;
  std::function<void()> clean_up_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread watcher_;  // Last: it uses the others.
};

}  // namespace pleinair::app
