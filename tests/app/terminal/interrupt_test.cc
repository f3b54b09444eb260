#include "app/terminal/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "app/terminal/interrupt_deadline.h"

namespace pleinair::app {
namespace {

TEST(InterruptGuard, OutlivesSignalsThatComeTogether) {
  const InterruptGuard guard;
  EXPECT_FALSE(InterruptGuard::Interrupted());
  for (int i = 0; i < 10; ++i) raise(i % 3 == 0 ? SIGINT : i % 3 == 1 ? SIGTERM : SIGHUP);
  EXPECT_TRUE(InterruptGuard::Interrupted());
}

TEST(InterruptGuard, ForgetsTheSignalsOfAnEarlierOne) {
  {
    const InterruptGuard guard;
    raise(SIGINT);
  }
  const InterruptGuard guard;
  EXPECT_FALSE(InterruptGuard::Interrupted());
}

TEST(InterruptDeadlineDeathTest, EndsWorkThatDoesNotLookAndCleansUp) {
  EXPECT_EXIT(
      {
        const InterruptGuard guard;
        const InterruptDeadline deadline("walk", [] { std::fputs("cleaned up\n", stderr); });
        raise(SIGINT);
        sleep(30);  // As a long step; ends sooner.
      },
      testing::ExitedWithCode(1), "cleaned up\npleinair: walk: interrupted; nothing was written");
}

TEST(InterruptDeadline, LeavesWorkThatEndsInTimeAlone) {
  const InterruptGuard guard;
  {
    const InterruptDeadline deadline("walk", [] { ADD_FAILURE(); });
  }
  const InterruptDeadline deadline("walk", [] { ADD_FAILURE(); });
  raise(SIGINT);
}

TEST(InterruptGuardDeathTest, EndsTheProgramWhenSignalsGoOn) {
  EXPECT_EXIT(
      {
        const InterruptGuard guard;
        raise(SIGINT);
        raise(SIGINT);
        sleep(3);  // Longer than the interval in which a second signal counts as the same request.
        raise(SIGINT);
        _exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace pleinair::app
