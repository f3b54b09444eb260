#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace pleinair::app {

/// Ends the program within a second of an interrupt, while an object exists. This also holds during
/// a long step that does not check for interrupts: drawing a frame, building a hierarchy of a
/// million triangles. Work that returns sooner ends as usual. Needs an InterruptGuard.
class InterruptDeadline {
 public:
  static constexpr std::chrono::milliseconds kGrace{800};

  /// `work`: name of the work in the message. `clean_up` removes unfinished outputs. It runs on a
  /// thread of its own while the work goes on. After it, the program ends with exit code 1.
  /// `outcome` ends the message. `grace`: time for the work to end by itself; zero while the
  /// program waits for a person's answer.
  InterruptDeadline(std::string work, std::function<void()> clean_up,
                    std::string outcome = "nothing was written",
                    std::chrono::milliseconds grace = kGrace);
  /// Stops watching: the work has ended, or enters a step that must not be interrupted.
  ~InterruptDeadline();
  InterruptDeadline(const InterruptDeadline&) = delete;
  InterruptDeadline& operator=(const InterruptDeadline&) = delete;

 private:
  void Watch();

  std::string work_, outcome_;
  std::function<void()> clean_up_;
  std::chrono::milliseconds grace_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread watcher_;  // Last: it uses the others.
};

}  // namespace pleinair::app
