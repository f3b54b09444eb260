#include "app/interrupt.h"

#include <csignal>

namespace pleinair::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void Remember(int) { interrupted = 1; }

void Install(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() { Install(Remember); }

InterruptGuard::~InterruptGuard() { Install(SIG_DFL); }

bool InterruptGuard::Interrupted() { return interrupted != 0; }

}  // namespace pleinair::app
