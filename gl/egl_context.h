#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::gl {

struct EglContextOptions {
  /// Ask for a debug context and collect what the driver reports (TakeErrors). Costs little with
  /// a software renderer; tests switch it on and fail on any error.
  bool debug = false;
};

/// What the machine gave.
struct EglContextInfo {
  std::string platform;   ///< "surfaceless", "device 0", "default".
  std::string vendor;     ///< GL_VENDOR.
  std::string renderer;   ///< GL_RENDERER.
  std::string version;    ///< GL_VERSION.
  bool software = false;  ///< A CPU renders (llvmpipe, softpipe, swrast).
};

/// An OpenGL 4.5 core context without window, display or surface (EGL 1.5): drawing goes to
/// framebuffer objects. Tried in order: Mesa's surfaceless platform, EGL devices, the default
/// display; a GPU goes before a software renderer. Move-only; the context is released and destroyed
/// with the object, so GL objects must go first. One thread at a time may have it current.
class EglContext {
 public:
  /// Creates the context and makes it current on the calling thread.
  /// Errors (kSystem): no libEGL or libGL, no platform with OpenGL 4.5 core; the message names what
  /// was tried and which Debian packages help.
  static Result<EglContext> Create(const EglContextOptions& options = {});

  EglContext(EglContext&&) noexcept;
  EglContext& operator=(EglContext&&) noexcept;
  ~EglContext();

  /// Makes the context current on the calling thread.
  Result<void> MakeCurrent() const;
  /// Detaches the context from the calling thread, so that another may take it.
  void ReleaseCurrent() const;

  const EglContextInfo& info() const;

  /// Errors and undefined behaviour that the driver reported since the last call (debug contexts).
  std::vector<std::string> TakeErrors();

 private:
  struct State;
  explicit EglContext(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace pleinair::gl
