#include "app/window/live_window.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "app/terminal/interrupt.h"
#include "devices/cameras/live_camera.h"
#include "tests/devices/cameras/fake_camera_device.h"
#include "tests/small_camera.h"

namespace pleinair::app {
namespace {

using devices::FakeCamera;
using std::chrono::milliseconds;

/// A virtual display that ends with the test.
class Screen {
 public:
  Screen() {
    int ends[2];
    if (std::system("command -v Xvfb >/dev/null 2>&1") != 0 || pipe(ends) != 0) return;
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], 3);
      execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "640x480x24", "-nolisten", "tcp",
             nullptr);
      _exit(127);
    }
    close(ends[1]);
    std::string display = ":";
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) display += c;
    close(ends[0]);
    if (display.size() > 1) setenv("DISPLAY", display.c_str(), 1);
    is_there_ = display.size() > 1;
  }
  ~Screen() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  bool is_there() const { return is_there_; }

 private:
  pid_t pid_ = -1;
  bool is_there_ = false;
};

TEST(LiveWindow, StaysThroughAnUnplugAndShowsTheCameraAgainWhenItComesBack) {
  const Screen screen;
  if (!screen.is_there()) GTEST_SKIP() << "Xvfb is not installed (scripts/setup --tests does)";
  FakeCamera fake(tests::kSmallWidth, tests::kSmallHeight);
  devices::LiveCameraOptions camera_options;
  camera_options.uri = {devices::CameraUri::Backend::kV4l2, devices::CameraUri::Key::kNode,
                        "/dev/video0"};
  camera_options.stall_limit = std::chrono::hours(1);  // The test itself may be delayed.
  auto opened = devices::LiveCamera::OpenWith(
      camera_options, [&](const devices::CameraUri& uri, const devices::FormatRequest& requested) {
        return fake.Open(uri, requested);
      });
  ASSERT_TRUE(opened);
  devices::LiveCamera* camera = opened->get();
  LiveOptions options = tests::SmallCameraOptions();
  options.shown_elsewhere = true;
  options.source.stop = [camera] { camera->Stop(); };
  LiveWindowOptions window;
  window.camera = options.camera;
  window.scene = options.scene;
  window.live_camera = camera;
  window.width = 400;
  window.height = 300;
  auto session = LiveSession::Create(*std::move(opened), std::move(options));
  ASSERT_TRUE(session) << session.error().Message();
  using Kind = devices::CameraEvent::Kind;
  std::vector<Kind> told;
  std::atomic<int> told_connected = 0;
  window.poll_camera = [&] {
    for (const devices::CameraEvent& event : camera->TakeEvents()) {
      told.push_back(event.kind);
      told_connected += event.kind == Kind::kConnected ? 1 : 0;
    }
    return std::string();
  };
  const InterruptGuard guard;
  std::atomic<bool> over = false;
  std::atomic<std::int64_t> shown_before = 0, shown_after = 0;
  std::thread hand([&] {
    std::int64_t number = 0;
    // Sends frames until the given number of further frames has been displayed.
    const auto send_until_shown = [&](std::int64_t more) {
      const std::int64_t enough = (*session)->statistics().frames.shown + more;
      while (!over && (*session)->statistics().frames.shown < enough) {
        fake.SendAt(number++, std::chrono::steady_clock::now().time_since_epoch().count(), 90,
                    false);
        std::this_thread::sleep_for(milliseconds(20));
      }
    };
    send_until_shown(3);
    shown_before = (*session)->statistics().frames.shown;
    fake.Unplug();
    std::this_thread::sleep_for(milliseconds(300));  // The window draws without new frames.
    fake.Plug();
    while (!over && told_connected < 2) std::this_thread::sleep_for(milliseconds(5));
    send_until_shown(3);
    shown_after = (*session)->statistics().frames.shown;
    raise(SIGINT);
  });
  const auto shown = ShowInWindow(**session, window);
  over = true;
  hand.join();
  (*session)->Stop();
  EXPECT_TRUE(shown) << shown.error().Message();
  EXPECT_GE(shown_before, 3);
  EXPECT_GE(shown_after, shown_before + 3);
  std::erase(told, Kind::kWaiting);
  EXPECT_THAT(told, testing::ElementsAre(Kind::kConnected, Kind::kGone, Kind::kConnected));
  EXPECT_EQ((*session)->statistics().Unaccounted(), 0);
}

}  // namespace
}  // namespace pleinair::app
