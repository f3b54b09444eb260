#include "app/terminal/interrupt_deadline.h"

#include <unistd.h>

#include <iostream>
#include <optional>
#include <utility>

#include "app/terminal/interrupt.h"

namespace pleinair::app {
namespace {

using WatchClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPoll{50};
constexpr int kInterruptedExit = 1;  // kExitSystem

}  // namespace

InterruptDeadline::InterruptDeadline(std::string work, std::function<void()> clean_up,
                                     std::string outcome, std::chrono::milliseconds grace)
    : work_(std::move(work)),
      outcome_(std::move(outcome)),
      clean_up_(std::move(clean_up)),
      grace_(grace),
      watcher_([this] { Watch(); }) {}

InterruptDeadline::~InterruptDeadline() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  watcher_.join();
}

void InterruptDeadline::Watch() {
  std::optional<WatchClock::time_point> interrupted;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!changed_.wait_for(lock, kPoll, [this] { return done_; })) {
    if (!interrupted && InterruptGuard::Interrupted()) interrupted = WatchClock::now();
    if (!interrupted || WatchClock::now() - *interrupted < grace_) continue;
    // The lock is kept: from here on, the work cannot end before the program.
    clean_up_();
    std::cerr << "pleinair: " << work_ << ": interrupted; " << outcome_ << std::endl;
    _exit(kInterruptedExit);
  }
}

}  // namespace pleinair::app
