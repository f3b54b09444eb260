#include "app/window/live_window.h"

// GLFW must not include OpenGL itself.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <utility>

#include "app/terminal/interrupt.h"
#include "app/window/frame_thread.h"
#include "app/window/picture_mouse.h"
#include "app/window/scene_panel.h"
#include "app/window/screen.h"
#include "app/window/window_layout.h"
#include "app/window/window_state.h"
#include "base/atomic_file.h"
#include "devices/cameras/camera.h"
#include "devices/cameras/live_camera.h"
#include "export/images/image_writer.h"

namespace pleinair::app {
namespace {

using Clock = std::chrono::steady_clock;

// Max. time between redraws, for blinking and counting elements.
constexpr double kIdle_s = 0.1;
constexpr double kRateWeight = 0.05;

UtcTime WallClock() {
  return UtcTime(std::chrono::duration_cast<std::chrono::nanoseconds>(
                     std::chrono::system_clock::now().time_since_epoch())
                     .count());
}

/// "20250914T110500Z", for file names.
std::string Compact(UtcTime time) {
  std::string text = time.ToString();
  std::erase_if(text, [](char c) { return c == '-' || c == ':' || c == '.'; });
  return text;
}

/// ImGui stores a texture name in a pointer.
ImTextureID TextureOf(const Screen& screen) {
  return reinterpret_cast<ImTextureID>(  // NOLINT(performance-no-int-to-ptr)
      static_cast<std::uintptr_t>(screen.texture()));
}

/// Shortens a line that is too long, with an ellipsis.
std::string CutTo(float width, std::string words) {
  if (ImGui::CalcTextSize(words.c_str()).x <= width) return words;
  do {
    // Removes whole UTF-8 characters.
    while (!words.empty() && (words.back() & 0xC0) == 0x80) words.pop_back();
    if (!words.empty()) words.pop_back();
  } while (!words.empty() && ImGui::CalcTextSize((words + "…").c_str()).x > width);
  return words + "…";
}

/// Displayed frame rate, from a moving average of the periods.
class FrameRate {
 public:
  /// Adds a frame displayed at this time; 0 for the first.
  double Add(Clock::time_point now) {
    if (last_) {
      const double period_s = std::chrono::duration<double>(now - *last_).count();
      mean_period_s_ = mean_period_s_ == 0.0
                           ? period_s
                           : mean_period_s_ + kRateWeight * (period_s - mean_period_s_);
    }
    last_ = now;
    return mean_period_s_ > 0.0 ? 1.0 / mean_period_s_ : 0.0;
  }

 private:
  std::optional<Clock::time_point> last_;
  double mean_period_s_ = 0.0;
};

/// One run of the window.
class LiveWindow {
 public:
  LiveWindow(LiveSession& session, const LiveWindowOptions& options, Screen& screen)
      : session_(session),
        options_(options),
        screen_(screen),
        state_(WindowState::For(options.scene, options.drawing, options.convergence)) {
    state_.frame.camera = options.camera;
    state_.boxes = BoxesOf(session.placed(), options.scene);
    edit_ = state_.edit;
    frames_.emplace(session);
  }

  Result<void> Run() {
    auto start = Clock::now();
    bool has_shown = false;
    while (glfwWindowShouldClose(screen_.window()) == GLFW_FALSE && !state_.requests.close &&
           !InterruptGuard::Interrupted()) {
      const double ran_s = std::chrono::duration<double>(Clock::now() - start).count();
      if (options_.seconds && ran_s >= *options_.seconds) break;
      if (auto error = frames_->error()) return tl::make_unexpected(*error);
      WaitForSomething();
      TakeFrame();
      Draw();
      PLEINAIR_RETURN_IF_ERROR(DoWishes());
      glfwSwapBuffers(screen_.window());
      if (fresh_) {
        if (!std::exchange(has_shown, true))
          start = Clock::now();  // The time limit counts from it.
        session_.Shown(*std::exchange(fresh_, std::nullopt), frames_->late());
      }
      if (!(state_.edit == edit_)) {
        edit_ = state_.edit;
        session_.Edit(edit_);
      }
    }
    frames_->Stop();
    if (options_.scene_file != nullptr && options_.scene_file->IsUnsaved(state_.edit)) {
      std::cerr << "warning: the changes of the scene were not saved (Ctrl+S saves them)\n";
    }
    return {};
  }

 private:
  /// Waits for a frame, a user input, or the maximum redraw time.
  void WaitForSomething() {
    const auto until = Clock::now() + std::chrono::duration<double>(kIdle_s);
    constexpr double kLook_s = 0.004;
    ready_ = frames_->Take();
    while (!ready_ && Clock::now() < until) {
      const auto before = Clock::now();
      glfwWaitEventsTimeout(kLook_s);
      // An early return means that an event arrived.
      const bool early = Clock::now() - before < std::chrono::duration<double>(kLook_s * 0.9);
      ready_ = frames_->Take();
      if (early) break;
    }
    glfwPollEvents();
  }

  void TakeFrame() {
    const auto now = Clock::now();
    state_.status.statistics = session_.statistics();
    state_.status.recording = session_.recording();
    if (options_.poll_camera) {
      const std::string words = options_.poll_camera();
      if (!words.empty()) {
        state_.status.camera = words;
        state_.status.camera_is_away =
            !words.starts_with("camera connected") && !words.starts_with("camera recovered");
      }
    }
    if (!ready_) return;
    screen_.Upload(ready_->picture);
    state_.frame.camera_from_marker = ready_->camera_from_marker;
    state_.frame.moment = ready_->moment;
    state_.frame.light = ready_->light;
    state_.frame.is_there = true;
    state_.status.shown_per_second = rate_.Add(now);
    last_picture_ = ready_->picture;
    fresh_ = std::exchange(ready_, std::nullopt);
  }

  void Draw() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const ImGuiIO& io = ImGui::GetIO();
    const WindowLayout layout = WindowLayout::For(
        {io.DisplaySize.x, io.DisplaySize.y}, ImGui::GetFontSize(), state_.overlays.panel,
        {static_cast<double>(state_.frame.camera.width),
         static_cast<double>(state_.frame.camera.height)});
    const Vec2 area = layout.picture;
    Keys();
    if (state_.frame.is_there) {
      const PictureView view =
          PictureView::Fit(state_.frame.camera.width, state_.frame.camera.height, {}, area);
      const Vec2 low = view.ScreenFromPixel({-0.5, -0.5});
      const Vec2 high =
          view.ScreenFromPixel({state_.frame.camera.width - 0.5, state_.frame.camera.height - 0.5});
      ImGui::GetBackgroundDrawList()->AddImage(
          TextureOf(screen_), {static_cast<float>(low.x), static_cast<float>(low.y)},
          {static_cast<float>(high.x), static_cast<float>(high.y)});
      std::vector<ButtonEvent> buttons = screen_.TakeButtons();
      // The panel and the help handle their own presses. Releases count anywhere.
      std::erase_if(buttons, [&](const ButtonEvent& event) {
        return event.down && (io.WantCaptureMouse || layout.OnPanel(event.screen));
      });
      mouse_.Update(view, buttons, &state_);
    } else {
      DrawWaiting(area);
    }
    DrawStatusLine(static_cast<float>(area.x), static_cast<float>(area.y));
    if (state_.overlays.panel)
      panel_.Draw(layout.panel_corner, layout.panel_size, WallClock(), &state_);
    if (state_.overlays.help)
      DrawKeyHelp(io.DisplaySize.x, io.DisplaySize.y, &state_.overlays.help);
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(screen_.window(), &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(0.06F, 0.065F, 0.07F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  void Keys() {
    for (const Screen::Key& pressed : screen_.TakeKeys()) {
      if (ImGui::GetIO().WantTextInput) continue;
      const bool control = (pressed.mods & GLFW_MOD_CONTROL) != 0;
      const bool shift = (pressed.mods & GLFW_MOD_SHIFT) != 0;
      for (const KeyBinding& binding : KeyBindings()) {
        if (binding.key != pressed.key || binding.control != control) continue;
        if (binding.action == Action::kScreenshot && shift) {
          state_.requests.window_screenshot = true;
        } else {
          Do(binding.action, shift, WallClock(), &state_);
        }
      }
    }
  }

  void DrawWaiting(Vec2 area) const {
    const std::string words = state_.status.camera.empty()
                                  ? std::string("waiting for the first image…")
                                  : state_.status.camera;
    const float letter = ImGui::GetFontSize();
    const auto width = static_cast<float>(area.x), height = static_cast<float>(area.y);
    const float wrap = std::max(width - 4.0F * letter, letter);
    const ImVec2 size = ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
    ImGui::GetBackgroundDrawList()->AddText(ImGui::GetFont(), letter,
                                            {(width - size.x) / 2, (height - size.y) / 2},
                                            0xFFC0C0C0, words.c_str(), nullptr, wrap);
  }

  void DrawStatusLine(float width, float top) {
    const float letter = ImGui::GetFontSize();
    ImDrawList* draw = ImGui::GetBackgroundDrawList();
    const float height = letter * static_cast<float>(kStatusHeight);
    draw->AddRectFilled({0.0F, top}, {width, top + height}, 0xFF15130F);
    const float text_top = top + letter * 0.45F;
    float right = width - letter;
    if (state_.status.recording) {
      draw->AddCircleFilled({right - letter * 0.35F, top + letter * 0.95F}, letter * 0.35F,
                            0xFF3030E0);
      right -= letter * 1.5F;
    }
    const std::string words = StatusMessage();
    std::string rate = fmt::format("{:.0f} ms", state_.status.statistics.latency.median_ms);
    if (state_.status.shown_per_second > 0.0) {
      rate = fmt::format("{:.1f} a second, ", state_.status.shown_per_second) + rate;
    }
    const float rate_width = ImGui::CalcTextSize(rate.c_str()).x;
    // If there is no room for both, show the last action.
    if (ImGui::CalcTextSize(words.c_str()).x + rate_width + letter * 2.0F < right) {
      draw->AddText({right - rate_width, text_top}, 0xFF909090, rate.c_str());
    }
    draw->AddText({letter, text_top}, 0xFFB8B8B8, CutTo(right - letter, words).c_str());
  }

  std::string StatusMessage() const {
    if (state_.status.camera_is_away) return state_.status.camera;
    if (!state_.message.empty()) return state_.message;
    if (state_.frame.is_there && !state_.frame.camera_from_marker) return "no marker in sight";
    if (frames_->ended()) return "the recording is over";
    return "F1: keys and mouse";
  }

  /// Executes the requests of keys and panel.
  Result<void> DoWishes() {
    if (std::exchange(state_.requests.window_screenshot, false)) {
      PLEINAIR_RETURN_IF_ERROR(Save("window", screen_.Read()));
    }
    if (state_.requests.screenshot && !last_picture_.empty()) {
      state_.requests.screenshot = false;
      PLEINAIR_RETURN_IF_ERROR(Save("picture", last_picture_));
    }
    if (std::exchange(state_.requests.save_scene, false) && options_.scene_file != nullptr) {
      const auto file = options_.scene_file->Save(state_.edit);
      state_.message = file ? "saved the scene as " + file->string() : file.error().Message();
    }
    if (std::exchange(state_.requests.recording_change, false)) {
      if (session_.recording()) {
        session_.StopRecording();
        state_.message = "recording ended";
      } else {
        const auto folder = options_.screenshots / ("recording-" + Compact(WallClock()));
        const auto started = session_.StartRecording(folder);
        state_.message = started ? "recording into " + folder.string() : started.error().Message();
      }
    }
    if (auto trouble = session_.recording_trouble()) state_.message = trouble->Message();
    if (std::exchange(state_.requests.exposure_change, false) && options_.live_camera != nullptr) {
      std::vector<devices::ControlRequest> control_requests;
      if (state_.exposure_locked) {
        for (const auto control : {devices::CameraControl::kExposure, devices::CameraControl::kGain,
                                   devices::CameraControl::kWhiteBalance}) {
          control_requests.push_back({control, std::nullopt});
        }
      }
      options_.live_camera->LockControls(std::move(control_requests));
    }
    return {};
  }

  /// A failed write is reported and does not end the window.
  Result<void> Save(const std::string& what, const RgbImage& picture) {
    const auto file = options_.screenshots / fmt::format("{}-{}.png", what, Compact(WallClock()));
    // Renamed when complete, so that nobody reads a partial file.
    const std::filesystem::path part = file.string() + ".part";
    auto written = exports::WritePng(part, picture.view());
    std::error_code renamed;
    if (written) std::filesystem::rename(part, file, renamed);
    if (renamed) written = tl::make_unexpected(WriteError(file, renamed.value()));
    state_.message = written ? "saved " + file.string() : written.error().Message();
    return {};
  }

  LiveSession& session_;
  const LiveWindowOptions& options_;
  Screen& screen_;
  WindowState state_;
  session::SceneEdit edit_;  // Last edit sent to the session.
  ScenePanel panel_;
  PictureMouse mouse_;
  std::optional<FrameThread> frames_;
  std::optional<DrawnFrame> ready_, fresh_;
  RgbImage last_picture_;
  FrameRate rate_;
};

}  // namespace

Result<void> ShowInWindow(LiveSession& session, const LiveWindowOptions& options) {
  // A thread has one current context: release the session's for the window's.
  session.LetGo();
  PLEINAIR_ASSIGN_OR_RETURN(auto screen,
                            Screen::Open({options.width, options.height, options.ui_scale}));
  return LiveWindow(session, options, *screen).Run();
}

}  // namespace pleinair::app
