#include "app/window/screen.h"

// GLFW must not include OpenGL itself.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>

#include "app/window/window_style.h"

namespace pleinair::app {
namespace {

constexpr int kUsualWidth = 1280, kUsualHeight = 800;

/// Last error of GLFW, whose state is global in a process.
std::string& LastError() {
  static std::string words;
  return words;
}

tl::unexpected<Error> Refuse(const std::string& what) {
  return tl::make_unexpected(Error{ErrorKind::kSystem, "the screen", what + ": " + LastError(),
                                   "run it on a desktop, or give --headless"});
}

Screen* Of(GLFWwindow* window) { return static_cast<Screen*>(glfwGetWindowUserPointer(window)); }

}  // namespace

Result<std::unique_ptr<Screen>> Screen::Open(const Options& options) {
  std::unique_ptr<Screen> screen(new Screen());
  glfwSetErrorCallback([](int /*code*/, const char* words) { LastError() = words; });
  if (glfwInit() == GLFW_FALSE) return Refuse("no window can be opened");
  screen->initialized_ = true;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  const int width = options.width > 0 ? options.width : kUsualWidth;
  const int height = options.height > 0 ? options.height : kUsualHeight;
  screen->window_ = glfwCreateWindow(width, height, "pleinair live", nullptr, nullptr);
  if (screen->window_ == nullptr) return Refuse("no window with OpenGL 3.3 can be opened");
  glfwMakeContextCurrent(screen->window_);
  glfwSwapInterval(1);
  float scale_x = 1.0F, scale_y = 1.0F;
  glfwGetWindowContentScale(screen->window_, &scale_x, &scale_y);
  screen->HearKeysAndMouse();
  ImGui::CreateContext();
  screen->has_imgui_ = true;
  SetWindowStyle(options.ui_scale > 0.0 ? static_cast<float>(options.ui_scale)
                                        : std::max(scale_x, 1.0F));
  ImGui_ImplGlfw_InitForOpenGL(screen->window_, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  glGenTextures(1, &screen->texture_);
  return screen;
}

// Installed before ImGui's callbacks, which forward to these. ImGui samples the state only: it
// would miss a key pressed and released within one slow frame.
void Screen::HearKeysAndMouse() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    if (action != GLFW_RELEASE) Of(window)->keys_.push_back({key, mods});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    Of(window)->mouse_ = {x, y};
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    if (button != GLFW_MOUSE_BUTTON_LEFT && button != GLFW_MOUSE_BUTTON_RIGHT) return;
    Screen* self = Of(window);
    self->buttons_.push_back({button == GLFW_MOUSE_BUTTON_LEFT ? ButtonEvent::Button::kLeft
                                                               : ButtonEvent::Button::kRight,
                              action == GLFW_PRESS, (mods & GLFW_MOD_SHIFT) != 0, self->mouse_});
  });
}

Screen::~Screen() {
  if (has_imgui_) {
    if (texture_ != 0) glDeleteTextures(1, &texture_);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  if (window_ != nullptr) glfwDestroyWindow(window_);
  if (initialized_) glfwTerminate();
}

void Screen::Upload(const RgbImage& picture) {
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (picture.width() == width_ && picture.height() == height_) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE,
                    picture.data());
    return;
  }
  width_ = picture.width();
  height_ = picture.height();
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width_, height_, 0, GL_RGB, GL_UNSIGNED_BYTE,
               picture.data());
}

RgbImage Screen::Read() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  RgbImage upside_down(width, height, 3), picture(width, height, 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  for (int y = 0; y < height; ++y) {
    std::copy_n(upside_down.view().row(height - 1 - y), static_cast<std::size_t>(width) * 3,
                picture.view().row(y));
  }
  return picture;
}

}  // namespace pleinair::app
