// Replaces libepoxy's function loading; see epoxy/gl.h in this folder.
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string_view>

namespace {

// libEGL's dispatcher returns entry points that serve any context made current later.
template <typename Function>
Function Entry(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

}  // namespace

#define PLEINAIR_DEFINE_GL(type, name) type pleinair_##name = Entry<type>(#name);
PLEINAIR_GL_FUNCTIONS(PLEINAIR_DEFINE_GL)

PFNEGLGETPLATFORMDISPLAYEXTPROC pleinair_eglGetPlatformDisplayEXT =
    Entry<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
PFNEGLQUERYDEVICESEXTPROC pleinair_eglQueryDevicesEXT =
    Entry<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
PFNEGLQUERYDEVICESTRINGEXTPROC pleinair_eglQueryDeviceStringEXT =
    Entry<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");

bool epoxy_has_egl_extension(EGLDisplay display, const char* extension) {
  const char* all = eglQueryString(display, EGL_EXTENSIONS);
  if (all == nullptr) return false;
  const std::string_view names(all), name(extension);
  for (std::size_t at = names.find(name); at != std::string_view::npos;
       at = names.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || names[at - 1] == ' ') && (end == names.size() || names[end] == ' ')) {
      return true;
    }
  }
  return false;
}
