#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <arv.h>

#include <memory>
#include <string>

namespace pleinair::devices {

/// Deleter that releases a reference to a GObject.
struct GObjectUnref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <typename T>
using GObjectPtr = std::unique_ptr<T, GObjectUnref>;

/// Receives the GError of an Aravis call.
class GErrorSlot {
 public:
  GErrorSlot() = default;
  GErrorSlot(const GErrorSlot&) = delete;
  GErrorSlot& operator=(const GErrorSlot&) = delete;
  ~GErrorSlot() { g_clear_error(&error_); }

  /// Clears the slot for the next call.
  GError** Fresh() {
    g_clear_error(&error_);
    return &error_;
  }
  bool failed() const { return error_ != nullptr; }
  bool Is(ArvDeviceError code) const {
    return failed() && g_error_matches(error_, ARV_DEVICE_ERROR, code) != FALSE;
  }
  std::string details() const { return failed() ? error_->message : ""; }

 private:
  GError* error_ = nullptr;
};

}  // namespace pleinair::devices
