#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace pleinair::gl {

/// Owns the name of a GL object. The context that created it must be current when it is destroyed.
/// Move-only.
template <void (*Delete)(GLuint)>
class GlHandle {
 public:
  GlHandle() = default;
  explicit GlHandle(GLuint id) : id_(id) {}
  GlHandle(GlHandle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlHandle& operator=(GlHandle&& other) noexcept {
    if (this != &other) {
      Reset();
      id_ = std::exchange(other.id_, 0);
    }
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;
  ~GlHandle() { Reset(); }

  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }
  void Reset() {
    if (id_ != 0) Delete(std::exchange(id_, 0));
  }

 private:
  GLuint id_ = 0;
};

}  // namespace pleinair::gl
