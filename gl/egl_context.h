#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::gl {

struct EglContextOptions {
  /// Request a debug context and collect the driver's messages (TakeErrors). The cost is small with
  /// a software renderer; the tests enable it and fail on any error.
  bool debug = false;
};

/// The context that was created.
struct EglContextInfo {
  std::string platform;   ///< "surfaceless", "device 0", "default".
  std::string vendor;     ///< GL_VENDOR.
  std::string renderer;   ///< GL_RENDERER.
  std::string version;    ///< GL_VERSION.
  bool software = false;  ///< The CPU renders (llvmpipe, softpipe, swrast).
};

/// An OpenGL 4.5 core context without window, display or surface (EGL 1.5); all drawing goes to
/// framebuffer objects. Platforms are tried in this order: Mesa's surfaceless platform, EGL
/// devices, the default display. A GPU is preferred to a software renderer. Move-only. Destroy all
/// GL objects before the context. It can be current on one thread at a time.
class EglContext {
 public:
  /// Creates the context and makes it current on the calling thread. Errors (kSystem): no libEGL or
  /// libGL, no platform with OpenGL 4.5 core. The message lists what was tried and which Debian
  /// packages help.
  static Result<EglContext> Create(const EglContextOptions& options = {});

  EglContext(EglContext&&) noexcept;
  EglContext& operator=(EglContext&&) noexcept;
  ~EglContext();

  /// Makes the context current on the calling thread.
  Result<void> MakeCurrent() const;
  /// Detaches the context from the calling thread, so that another thread can make it current.
  void ReleaseCurrent() const;

  const EglContextInfo& info() const;

  /// Errors and undefined behaviour that the driver has reported since the last call (debug
  /// contexts only).
  std::vector<std::string> TakeErrors();

 private:
  struct State;
  explicit EglContext(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace pleinair::gl
