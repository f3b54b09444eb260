#pragma once

// Internal: between the .cc files of this module; not installed.

#include <arv.h>

#include <memory>
#include <string>

namespace pleinair::devices {

/// A reference to a GObject, given back at its end.
struct GObjectUnref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <typename T>
using GObjectPtr = std::unique_ptr<T, GObjectUnref>;

/// Where Aravis' calls put their errors.
class GErrorSlot {
 public:
  GErrorSlot() = default;
  GErrorSlot(const GErrorSlot&) = delete;
  GErrorSlot& operator=(const GErrorSlot&) = delete;
  ~GErrorSlot() { g_clear_error(&error_); }

  /// For the next call.
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
