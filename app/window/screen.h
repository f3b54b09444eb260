#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/window/picture_mouse.h"
#include "base/error.h"
#include "base/image.h"
#include "base/vector.h"

struct GLFWwindow;

namespace pleinair::app {

/// GLFW, a window, its OpenGL context and ImGui's, with one image as a texture. It destroys them
/// in order. Use it only on the thread that opened it.
class Screen {
 public:
  struct Options {
    int width = 0, height = 0;  ///< 0: fits most screens.
    double ui_scale = 0.0;      ///< Font scale; 0: the screen's scale.
  };
  /// Error (system): no display, or no OpenGL 3.3.
  static Result<std::unique_ptr<Screen>> Open(const Options& options);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  GLFWwindow* window() const { return window_; }

  struct Key {
    int key, mods;  ///< GLFW codes.
  };
  /// Keys pressed since the last call, including repeats.
  std::vector<Key> TakeKeys() { return std::exchange(keys_, {}); }
  std::vector<ButtonEvent> TakeButtons() { return std::exchange(buttons_, {}); }

  /// Uploads an image to the texture of texture().
  void Upload(const RgbImage& picture);
  unsigned texture() const { return texture_; }

  /// Reads the window's content, first row at the top.
  RgbImage Read() const;

 private:
  Screen() = default;
  void HearKeysAndMouse();

  bool initialized_ = false, has_imgui_ = false;
  GLFWwindow* window_ = nullptr;
  std::vector<Key> keys_;
  std::vector<ButtonEvent> buttons_;
  Vec2 mouse_;
  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace pleinair::app
