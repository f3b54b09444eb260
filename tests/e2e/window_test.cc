#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "run_program.h"

namespace pleinair::e2e {
namespace {

using Clock = std::chrono::steady_clock;
// A busy machine draws a frame in seconds; nothing is timed here.
constexpr std::chrono::seconds kPatience{90};

/// A program in the background, ended with the test.
class Background {
 public:
  explicit Background(const std::string& command) : pid_(fork()) {
    if (pid_ != 0) return;
    // A shell in its own group, so that all of it can be ended.
    setpgid(0, 0);
    execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
    _exit(127);
  }
  ~Background() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  bool running() {
    if (pid_ <= 0) return false;
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == 0) return true;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    pid_ = -1;
    return false;
  }
  /// After it ended.
  int exit_code() const { return exit_code_; }

 private:
  pid_t pid_;
  int exit_code_ = -1;
};

/// Asks again and again until it holds or patience is over.
bool Until(const std::function<bool()>& holds) {
  const auto limit = Clock::now() + kPatience;
  while (!holds()) {
    if (Clock::now() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

bool Runs(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// Pixels of two pictures that clearly differ.
int Differing(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference, grey;
  cv::absdiff(a, b, difference);
  cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey > 24);
}

/// A screen of its own with a session's window on it, and hands.
class Window : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"Xvfb", "xdotool"}) {
      if (!Runs(program)) GTEST_SKIP() << program << " is not installed (scripts/setup does)";
    }
    if (RunPleinair({"live", "--camera", "v4l2:none"}).err.find("without a window") !=
        std::string::npos) {
      GTEST_SKIP() << "built without GLFW and Dear ImGui";
    }
    screen_.emplace(
        fmt::format("Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp "
                    "3>'{}' >/dev/null 2>&1",
                    (folder_ / "display").string()));
    ASSERT_TRUE(Until([&] { return ReadFile(folder_ / "display").ends_with('\n'); }));
    display_ = ":" + ReadFile(folder_ / "display");
    display_.pop_back();
    std::filesystem::create_directory(folder_ / "pictures");
  }

  void Open(const std::string& arguments) {
    session_.emplace(fmt::format(
        "env DISPLAY={} {} live --pictures '{}' --window 1280x800 {} 2>'{}'", display_,
        PLEINAIR_PROGRAM, (folder_ / "pictures").string(), arguments, (folder_ / "err").string()));
    ASSERT_TRUE(Until([&] {
      return !session_->running() || Hands("search --onlyvisible --name 'pleinair live'");
    }));
    ASSERT_TRUE(session_->running()) << ReadFile(folder_ / "err");
  }

  bool Hands(const std::string& what) const {
    return std::system(("DISPLAY=" + display_ + " xdotool " + what + " >/dev/null 2>&1").c_str()) ==
           0;
  }

  /// Presses the keys of a screenshot and waits for its file.
  cv::Mat Screenshot(const std::string& keys) {
    // Names hold the time: the newest is the last of its kind.
    const auto newest = [&] {
      std::string last;
      for (const std::string& name : Listing(folder_ / "pictures")) {
        const bool is_kind = name.starts_with(keys == "ctrl+s" ? "picture" : "window");
        if (is_kind && name.ends_with(".png")) last = name;
      }
      return last;
    };
    const std::string before = newest();
    EXPECT_TRUE(Hands("key " + keys));
    EXPECT_TRUE(Until([&] { return newest() != before; }));
    cv::Mat picture = cv::imread((folder_ / "pictures" / newest()).string());
    EXPECT_FALSE(picture.empty());
    return picture;
  }

  /// The camera's picture once it clearly differs from `before`; empty where it never does. `again`
  /// is done before each look: a machine that is busy enough misses a click.
  cv::Mat Changed(const cv::Mat& before, int pixels, const std::string& again = "") {
    cv::Mat now;
    const bool changed = Until([&] {
      if (!again.empty()) {
        EXPECT_TRUE(Hands(again));
      }
      now = Screenshot("ctrl+s");
      return !now.empty() && Differing(before, now) > pixels;
    });
    return changed ? now : cv::Mat();
  }

  void ExpectToClose() {
    EXPECT_TRUE(Hands("key ctrl+q"));
    EXPECT_TRUE(Until([&] { return !session_->running(); }));
    EXPECT_EQ(session_->exit_code(), 0) << ReadFile(folder_ / "err");
  }

  TemporaryFolder folder_;
  std::string display_;
  std::optional<Background> screen_, session_;
};

TEST_F(Window, KeysMouseAndPanelChangeTheSceneAndItClosesCleanly) {
  // One frame again and again: whatever changes is the scene's doing.
  MakeShortRecording(folder_ / "site", 1, /*with_object=*/true);
  Open(fmt::format("--camera 'file:{}' --loop --rate 5 --light stated",
                   (folder_ / "site").string()));
  const cv::Mat start = Screenshot("ctrl+s");
  ASSERT_EQ(start.cols, 640);
  // The one object is chosen already.
  ASSERT_TRUE(Hands("key --delay 60 Right Right Right"));
  const cv::Mat moved = Changed(start, 500);
  ASSERT_FALSE(moved.empty()) << "by a key";
  // Its middle in the frame, where the window shows it.
  const cv::Mat whole = Screenshot("ctrl+shift+s");
  ASSERT_EQ(whole.cols, 1280);
  ASSERT_TRUE(Hands("key Home"));
  const cv::Mat back = Changed(moved, 500);
  ASSERT_FALSE(back.empty()) << "by a key";
  ASSERT_TRUE(
      Hands("mousemove 590 300 mousedown 1 mousemove 560 300 mousemove 500 320 sleep 0.3 "
            "mouseup 1"));
  const cv::Mat dragged = Changed(back, 500);
  ASSERT_FALSE(dragged.empty()) << "by the mouse";
  // The bar of the day's time, at three in the afternoon: shadows turn.
  EXPECT_FALSE(
      Changed(dragged, 500, "mousemove 1150 170 sleep 0.2 mousedown 1 sleep 0.3 mouseup 1").empty())
      << "by the panel";
  EXPECT_GT(Differing(whole, Screenshot("ctrl+shift+s")), 2000) << "the window shows it";
  // The partitions of the shadow maps tint most of the picture.
  const cv::Mat plain = Screenshot("ctrl+s");
  ASSERT_TRUE(Hands("key m"));
  const cv::Mat tinted = Changed(plain, 20000);
  ASSERT_FALSE(tinted.empty()) << "by the key of the shadow maps";
  EXPECT_LT(cv::mean(tinted)[0], 0.8 * cv::mean(plain)[0]) << "blue is what both tints take away";
  ASSERT_TRUE(Hands("key m"));
  EXPECT_FALSE(Changed(tinted, 20000).empty()) << "and back";
  ExpectToClose();
}

TEST_F(Window, WaitsForACameraThatIsNotThereAndRecordsNothingOfIt) {
  MakeShortRecording(folder_ / "site", 1, /*with_object=*/false);
  Open(
      fmt::format("--camera 'v4l2:serial=no such camera' --calibration '{0}/recording.json' "
                  "--scene '{0}/scene.toml'",
                  (folder_ / "site").string()));
  EXPECT_TRUE(Until([&] {
    return ReadFile(folder_ / "err").find("camera waiting: v4l2:serial=no such camera") !=
           std::string::npos;
  }));
  EXPECT_FALSE(Screenshot("ctrl+shift+s").empty()) << "it is drawn while it waits";
  ExpectToClose();
}

TEST(WindowWithoutAScreen, IsOneLineThatNamesTheWayOut) {
  const TemporaryFolder folder;
  MakeShortRecording(folder / "site", 1, /*with_object=*/false);
  const RunResult live = RunPleinair({"live", "--camera", "file:" + (folder / "site").string()},
                                     "unset DISPLAY WAYLAND_DISPLAY;");
  EXPECT_NE(live.exit_code, 0);
  EXPECT_THAT(live.err, testing::HasSubstr("--headless"));
}

}  // namespace
}  // namespace pleinair::e2e
