#include "app/terminal/interrupt.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace pleinair::app {
namespace {

// Signals so soon after the first are the same request: a terminal and `timeout` signal a whole
// process group, and users press Ctrl-C twice.
constexpr std::int64_t kSameWish_ns = 2'000'000'000;
constexpr int kSignalsThatEnd = 3;

std::atomic<int> signals{0};
std::atomic<std::int64_t> first_ns{0};
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free);  // Required in signal handlers.

void Install(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // Not under nohup.
}

void Remember(int signal) {
  const int saved_errno = errno;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  const int count = ++signals;
  if (count == 1) first_ns = now_ns;
  if (count >= kSignalsThatEnd && now_ns - first_ns > kSameWish_ns) {
    Install(SIG_DFL);
    raise(signal);  // Blocked until this handler returns, then fatal.
  }
  errno = saved_errno;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  signals = 0;
  Install(Remember);
}

InterruptGuard::~InterruptGuard() { Install(SIG_DFL); }

bool InterruptGuard::Interrupted() { return signals != 0; }

Result<void> CheckInterrupt(const std::string& work) {
  if (!InterruptGuard::Interrupted()) return {};
  return SystemError(work, "interrupted", "nothing was written");
}

}  // namespace pleinair::app
