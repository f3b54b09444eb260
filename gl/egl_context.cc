#include "gl/egl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <sys/resource.h>

#include <mutex>
#include <string>
#include <utility>

namespace pleinair::gl {
namespace {

constexpr const char* kRemedy =
    "install the Debian packages libegl1, libgl1 and libgl1-mesa-dri (Mesa's software renderer "
    "needs no GPU)";

// With 600 to 900 MB, Mesa's software renderer starts and then ends the process by a signal.
constexpr rlim_t kMinAddressSpace_bytes = rlim_t{1} << 30;

Result<void> CheckAddressSpace() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
      limit.rlim_cur >= kMinAddressSpace_bytes) {
    return {};
  }
  return SystemError("OpenGL",
                     "this process may use " + std::to_string(limit.rlim_cur >> 20) +
                         " MiB of address space, and drawing needs " +
                         std::to_string(kMinAddressSpace_bytes >> 20),
                     "raise the limit (ulimit -v)");
}

bool LibraryPresent(const char* name) {
  void* handle = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) return false;
  dlclose(handle);
  return true;
}

std::string EglErrorName(EGLint error) {
  switch (error) {
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    case EGL_CONTEXT_LOST:
      return "EGL_CONTEXT_LOST";
    default:
      return "EGL error " + std::to_string(error);
  }
}

struct Candidate {
  std::string platform;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

// Ends the context. The display stays initialised until the process ends: a process has one display
// per platform, so eglTerminate would end it for other users too, and drivers leak when they are
// unloaded and loaded again.
void Destroy(const Candidate& candidate) {
  if (candidate.context != EGL_NO_CONTEXT) {
    if (eglGetCurrentContext() == candidate.context) {
      eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(candidate.display, candidate.context);
  }
}

// Creates a 4.5 core context on the display and makes it current, or returns the reason why not.
Result<Candidate> TryDisplay(const std::string& platform, EGLDisplay display, bool debug) {
  if (display == EGL_NO_DISPLAY) return SystemError(platform, "no display");
  if (!eglInitialize(display, nullptr, nullptr)) {
    return SystemError(platform, "eglInitialize: " + EglErrorName(eglGetError()));
  }
  Candidate candidate{platform, display, EGL_NO_CONTEXT};
  const auto fail = [&](const std::string& what) {
    const std::string cause = what + ": " + EglErrorName(eglGetError());
    Destroy(candidate);
    return SystemError(platform, cause);
  };
  if (!eglBindAPI(EGL_OPENGL_API)) return fail("eglBindAPI(EGL_OPENGL_API)");
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) {
      return fail("no EGL configuration for OpenGL");
    }
  }
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_DEBUG,
                               debug ? EGL_TRUE : EGL_FALSE,
                               EGL_NONE};
  candidate.context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (candidate.context == EGL_NO_CONTEXT) return fail("no OpenGL 4.5 core context");
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, candidate.context)) {
    return fail("eglMakeCurrent without a surface");
  }
  return candidate;
}

std::string GlString(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "";
}

bool IsSoftware(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"}) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

std::vector<EGLDeviceEXT> Devices() {
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
    return {};
  }
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count) || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(count);
  if (!eglQueryDevicesEXT(count, devices.data(), &count)) return {};
  devices.resize(count);
  return devices;
}

bool IsSoftwareDevice(EGLDeviceEXT device) {
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
    return false;
  }
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions != nullptr &&
         std::string(extensions).find("EGL_MESA_device_software") != std::string::npos;
}

}  // namespace

struct EglContext::State {
  Candidate egl;
  EglContextInfo info;
  std::mutex mutex;  // Drivers may report from their own threads.
  std::vector<std::string> errors;

  ~State() { Destroy(egl); }

  static void GLAPIENTRY OnMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                                   const GLchar* message, const void* user) {
    const bool wrong = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                       severity == GL_DEBUG_SEVERITY_HIGH;
    if (!wrong) return;
    auto* state = static_cast<State*>(const_cast<void*>(user));
    const std::lock_guard lock(state->mutex);
    state->errors.emplace_back(
        message, length < 0 ? std::string(message).size() : static_cast<std::size_t>(length));
  }
};

EglContext::EglContext(std::unique_ptr<State> state) : state_(std::move(state)) {}
EglContext::EglContext(EglContext&&) noexcept = default;
EglContext& EglContext::operator=(EglContext&&) noexcept = default;
EglContext::~EglContext() = default;

Result<EglContext> EglContext::Create(const EglContextOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckAddressSpace());
  // libepoxy aborts the process if a library is missing, so check first.
  if (!LibraryPresent("libEGL.so.1")) {
    return SystemError("OpenGL", "the library libEGL.so.1 is not installed", kRemedy);
  }
  if (!LibraryPresent("libOpenGL.so.0") && !LibraryPresent("libGL.so.1")) {
    return SystemError("OpenGL", "the library libGL.so.1 is not installed", kRemedy);
  }

  std::vector<Candidate> software;
  Candidate chosen;
  std::string tried;
  // Returns true when the search is over.
  const auto attempt = [&](const std::string& platform, EGLDisplay display) {
    Result<Candidate> candidate = TryDisplay(platform, display, options.debug);
    if (!candidate) {
      tried += (tried.empty() ? "" : ", ") + candidate.error().Message();
      return false;
    }
    if (IsSoftware(GlString(GL_RENDERER))) {
      software.push_back(*candidate);
      return false;
    }
    chosen = *candidate;
    return true;
  };

  bool found = false;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    found = attempt("surfaceless", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                            EGL_DEFAULT_DISPLAY, nullptr));
  } else {
    tried = "surfaceless: EGL_MESA_platform_surfaceless missing";
  }
  if (!found && epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    const std::vector<EGLDeviceEXT> devices = Devices();
    for (std::size_t i = 0; i < devices.size() && !found; ++i) {
      if (!software.empty() && IsSoftwareDevice(devices[i])) continue;
      found = attempt("device " + std::to_string(i),
                      eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
    if (devices.empty()) tried += std::string(tried.empty() ? "" : ", ") + "device: none listed";
  }
  if (!found && software.empty()) found = attempt("default", eglGetDisplay(EGL_DEFAULT_DISPLAY));
  if (!found && !software.empty()) {
    chosen = software.front();
    software.erase(software.begin());
    found = true;
  }
  for (const Candidate& unused : software) Destroy(unused);
  if (!found) {
    return SystemError("OpenGL", "no OpenGL 4.5 core context (tried " + tried + ")", kRemedy);
  }

  auto state = std::make_unique<State>();
  state->egl = chosen;
  if (!eglMakeCurrent(chosen.display, EGL_NO_SURFACE, EGL_NO_SURFACE, chosen.context)) {
    return SystemError("OpenGL", "eglMakeCurrent: " + EglErrorName(eglGetError()), kRemedy);
  }
  state->info = {chosen.platform, GlString(GL_VENDOR), GlString(GL_RENDERER), GlString(GL_VERSION),
                 IsSoftware(GlString(GL_RENDERER))};
  if (options.debug) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&State::OnMessage, state.get());
  }
  return EglContext(std::move(state));
}

Result<void> EglContext::MakeCurrent() const {
  if (!eglMakeCurrent(state_->egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->egl.context)) {
    return SystemError("OpenGL", "eglMakeCurrent: " + EglErrorName(eglGetError()),
                       "is the context current on another thread?");
  }
  return {};
}

void EglContext::ReleaseCurrent() const {
  eglMakeCurrent(state_->egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

const EglContextInfo& EglContext::info() const { return state_->info; }

std::vector<std::string> EglContext::TakeErrors() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->errors, {});
}

}  // namespace pleinair::gl
