#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

// Same definitions as libepoxy.
bool epoxy_has_egl_extension(EGLDisplay display, const char* extension);
extern PFNEGLGETPLATFORMDISPLAYEXTPROC pleinair_eglGetPlatformDisplayEXT;
extern PFNEGLQUERYDEVICESEXTPROC pleinair_eglQueryDevicesEXT;
extern PFNEGLQUERYDEVICESTRINGEXTPROC pleinair_eglQueryDeviceStringEXT;
#define eglGetPlatformDisplayEXT pleinair_eglGetPlatformDisplayEXT
#define eglQueryDevicesEXT pleinair_eglQueryDevicesEXT
#define eglQueryDeviceStringEXT pleinair_eglQueryDeviceStringEXT
