#include "app/terminal/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

namespace pleinair::app {
namespace {

TEST(InterruptGuard, OutlivesSignalsThatComeTogether) {
  const InterruptGuard guard;
  EXPECT_FALSE(InterruptGuard::Interrupted());
  for (int i = 0; i < 10; ++i) raise(i % 2 == 0 ? SIGINT : SIGTERM);
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
