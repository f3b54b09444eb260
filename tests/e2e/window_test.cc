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

#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

using Clock = std::chrono::steady_clock;
// A busy machine draws a frame in seconds; nothing is timed here.
constexpr std::chrono::seconds kPatience{200};

/// A program in the background, ended with the test.
class Background {
 public:
  explicit Background(const std::string& command) : pid_(fork()) {
    if (pid_ != 0) return;
    // A shell in its own process group, so that the whole group can be ended.
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
  /// After it has ended.
  int exit_code() const { return exit_code_; }

 private:
  pid_t pid_;
  int exit_code_ = -1;
};

/// Polls a condition until it holds or a timeout passes.
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

/// Number of pixels that clearly differ between two images.
int Differing(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference, grey;
  cv::absdiff(a, b, difference);
  cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey > 24);
}

/// A virtual display with a session's window, and simulated input.
class Window : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* program : {"Xvfb", "xdotool", "xprop"}) {
      if (!Runs(program))
        GTEST_SKIP() << program << " is not installed (scripts/setup --tests does)";
    }
    if (RunPleinair({"live", "--camera", "v4l2:none"}).err.find("without a window") !=
        std::string::npos) {
      GTEST_SKIP() << "built without GLFW and Dear ImGui";
    }
    screen_.emplace(
        fmt::format("Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp -noreset "
                    "3>'{}' >/dev/null 2>&1",
                    (folder_ / "display").string()));
    ASSERT_TRUE(Until([&] { return ReadFile(folder_ / "display").ends_with('\n'); }));
    display_ = ":" + ReadFile(folder_ / "display");
    display_.pop_back();
    std::filesystem::create_directory(folder_ / "pictures");
  }

  void Open(const std::string& arguments) {
    session_.emplace(
        fmt::format("env DISPLAY={} {} live --pictures '{}' {} {} 2>'{}'", display_,
                    PleinairProgram(), (folder_ / "pictures").string(),
                    arguments.find("--window") == std::string::npos ? "--window 1280x800" : "",
                    arguments, (folder_ / "err").string()));
    ASSERT_TRUE(Until([&] {
      return !session_->running() || Hands("search --onlyvisible --name 'pleinair live'");
    }));
    ASSERT_TRUE(session_->running()) << ReadFile(folder_ / "err");
  }

  bool Hands(const std::string& what) const {
    return std::system(("DISPLAY=" + display_ + " xdotool " + what + " >/dev/null 2>&1").c_str()) ==
           0;
  }

  /// Presses the screenshot keys and waits for the file.
  cv::Mat Screenshot(const std::string& keys) {
    // Names contain the time: the newest is the last one.
    const auto newest = [&] {
      std::string last;
      for (const std::string& name : Listing(folder_ / "pictures")) {
        const bool is_kind = name.starts_with(keys == "ctrl+p" ? "picture" : "window");
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

  /// The camera image as soon as it clearly differs from `before`; empty after a timeout. `again`
  /// runs before every fourth attempt: a very busy machine may miss a click.
  cv::Mat Changed(const cv::Mat& before, int pixels, const std::string& again = "") {
    cv::Mat now;
    int looks = 0;
    const bool changed = Until([&] {
      if (!again.empty() && looks++ % 4 == 0) {
        EXPECT_TRUE(Hands(again));
      }
      now = Screenshot("ctrl+p");
      return !now.empty() && Differing(before, now) > pixels;
    });
    return changed ? now : cv::Mat();
  }

  /// The whole window once it shows the camera image.
  cv::Mat WithPicture() {
    Screenshot("ctrl+p");
    return Screenshot("ctrl+shift+p");
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
  // One frame repeated: every change comes from the scene.
  MakeShortRecording(folder_ / "site", 1, /*with_object=*/true);
  Open(fmt::format("--camera 'file:{0}' --loop --rate 5 --light stated --save-scene '{0}/set.toml'",
                   (folder_ / "site").string()));
  const cv::Mat start = Screenshot("ctrl+p");
  ASSERT_EQ(start.cols, 640);
  // The only object is selected already.
  ASSERT_TRUE(Hands("key --delay 60 Right Right Right"));
  const cv::Mat moved = Changed(start, 500);
  ASSERT_FALSE(moved.empty()) << "by a key";
  // Its centre in the frame, at its position in the window.
  const cv::Mat whole = Screenshot("ctrl+shift+p");
  ASSERT_EQ(whole.cols, 1280);
  ASSERT_TRUE(Hands("key Home"));
  const cv::Mat back = Changed(moved, 500);
  ASSERT_FALSE(back.empty()) << "by a key";
  ASSERT_TRUE(
      Hands("mousemove 590 300 mousedown 1 mousemove 560 300 mousemove 500 320 sleep 0.3 "
            "mouseup 1"));
  const cv::Mat dragged = Changed(back, 500);
  ASSERT_FALSE(dragged.empty()) << "by the mouse";
  // At the drop position the wheel enlarges it and the right button turns it.
  const cv::Mat larger = Changed(dragged, 500, "mousemove 500 320 click 4 click 4 click 4");
  ASSERT_FALSE(larger.empty()) << "by the wheel";
  const cv::Mat turned =
      Changed(larger, 300, "mousemove 500 320 mousedown 3 mousemove 560 320 sleep 0.2 mouseup 3");
  ASSERT_FALSE(turned.empty()) << "by the right button";
  // The slider of the time of day, at 15:00: shadows turn.
  const cv::Mat later =
      Changed(turned, 500, "mousemove 1150 170 sleep 0.2 mousedown 1 sleep 0.3 mouseup 1");
  ASSERT_FALSE(later.empty()) << "by the panel";
  // The partitions of the shadow maps tint most of the image while the sun shines. Both tints
  // reduce blue. Light that is still being computed changes less.
  const auto blue = [&] { return cv::mean(Screenshot("ctrl+p"))[0]; };
  const double plain = blue();
  ASSERT_TRUE(Hands("key m"));
  EXPECT_TRUE(Until([&] { return blue() < 0.8 * plain; })) << "by the key of the shadow maps";
  ASSERT_TRUE(Hands("key m"));
  EXPECT_TRUE(Until([&] { return blue() > 0.9 * plain; })) << "and back";
  // The right end of the cloud slider: without a sun the shadow disappears.
  EXPECT_FALSE(
      Changed(later, 500, "mousemove 1130 347 sleep 0.2 mousedown 1 sleep 0.3 mouseup 1").empty())
      << "by clouds";
  EXPECT_GT(Differing(whole, Screenshot("ctrl+shift+p")), 2000) << "the window shows it";
  ASSERT_TRUE(Hands("key ctrl+s"));
  EXPECT_TRUE(Until([&] { return std::filesystem::exists(folder_ / "site/set.toml"); }));
  EXPECT_THAT(ReadFile(folder_ / "site/set.toml"), testing::HasSubstr("[[object]]"));
  ExpectToClose();
}

TEST_F(Window, RecordsWhileItIsShownAndTheLockHoldsTheBrightness) {
  MakeShortRecording(folder_ / "site", 1, /*with_object=*/true);
  Open(fmt::format("--camera 'file:{}' --loop --rate 5 --light stated",
                   (folder_ / "site").string()));
  const cv::Mat start = Screenshot("ctrl+p");
  ASSERT_TRUE(Hands("key ctrl+r"));
  const auto recorded = [&] {
    for (const std::string& name : Listing(folder_ / "pictures")) {
      if (name.ends_with("frames.pack")) return folder_ / ("pictures/" + name);
    }
    return std::filesystem::path();
  };
  // Five frames of 640 × 480 in RGB.
  EXPECT_TRUE(Until([&] {
    return !recorded().empty() && std::filesystem::file_size(recorded()) > 5 * 640 * 480 * 3;
  }));
  ASSERT_TRUE(Hands("key ctrl+r"));
  // With exposure locked at noon the evening becomes dark. Unlocked it is as bright as the marker
  // again.
  ASSERT_TRUE(Hands("key l"));
  std::string later = "key --delay 30";
  for (int i = 0; i < 36; ++i) later += " bracketright";
  ASSERT_TRUE(Hands(later));
  // Three pixel value steps over the whole image. The evening's light appears when it is computed.
  const auto green = [&] { return cv::mean(Screenshot("ctrl+p"))[1]; };
  const double noon = cv::mean(start)[1];
  double dark = noon;
  EXPECT_TRUE(Until([&] { return (dark = green()) < noon - 1.5; })) << dark << " of " << noon;
  ASSERT_TRUE(Hands("key l"));
  EXPECT_TRUE(Until([&] { return green() > dark + 1.5; })) << "by letting the exposure go";
  ExpectToClose();
  const RunResult replay =
      RunPleinair({"live", "--camera", "file:" + recorded().parent_path().string(), "--headless",
                   "--lossless", "--json"});
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_THAT(replay.out, testing::HasSubstr("\"with_pose\":")) << "it opens";
}

TEST_F(Window, IsUsableWhenItIsSmallAndTwiceAsLargeOnAScreenOfTwiceTheScale) {
  MakeShortRecording(folder_ / "site", 1, /*with_object=*/false);
  const std::string camera =
      fmt::format("--camera 'file:{}' --loop --rate 5", (folder_ / "site").string());
  Open(camera + " --window 320x240");
  cv::Mat top;
  const cv::Mat empty(240, 50, CV_8UC3, cv::Scalar(18, 17, 15));
  EXPECT_TRUE(Until([&] {
    top = Screenshot("ctrl+shift+p");
    return top.size() == cv::Size(320, 240) && Differing(top.colRange(0, 50), empty) > 500;
  })) << "some of the picture is seen beside the panel";
  // The panel is longer than the window: the wheel scrolls to its end.
  ASSERT_TRUE(Hands("mousemove 200 120"));
  EXPECT_TRUE(Until([&] {
    EXPECT_TRUE(Hands("click 5"));
    return Differing(top, Screenshot("ctrl+shift+p")) > 3000;
  })) << "by the wheel over the panel";
  ASSERT_TRUE(Hands("key F2"));
  EXPECT_TRUE(Until([&] { return Differing(top, Screenshot("ctrl+shift+p")) > 20000; }))
      << "without the panel";
  ExpectToClose();

  // What desktops report to GLFW for a high-density display.
  ASSERT_EQ(std::system(("DISPLAY=" + display_ +
                         " xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi: 192'")
                            .c_str()),
            0);
  Open(camera + " --window 640x400");
  const cv::Mat scaled = WithPicture();
  ASSERT_EQ(scaled.size(), cv::Size(1280, 800)) << "twice the pixels";
  ExpectToClose();
  ASSERT_EQ(std::system(("DISPLAY=" + display_ + " xprop -root -remove RESOURCE_MANAGER").c_str()),
            0);
  Open(camera + " --window 1280x800 --ui-scale 2");
  const cv::Mat large = WithPicture();
  ASSERT_EQ(large.size(), scaled.size());
  // Identical except for the counts in its statistics.
  EXPECT_LT(Differing(large, scaled), 1280 * 800 / 50);
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
  EXPECT_FALSE(Screenshot("ctrl+shift+p").empty()) << "it is drawn while it waits";
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
