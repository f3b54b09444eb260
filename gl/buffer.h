#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>

#include "base/error.h"
#include "gl/handle.h"

namespace pleinair::gl {

inline void DeleteBuffer(GLuint id) { glDeleteBuffers(1, &id); }

/// A buffer of fixed size: vertices, indices, uniform blocks.
class GlBuffer {
 public:
  /// `flags`: as for glNamedBufferStorage; with the default, Update() may change the content.
  /// Errors (kSystem): out of memory.
  static Result<GlBuffer> Create(std::size_t bytes, const void* data = nullptr,
                                 GLbitfield flags = GL_DYNAMIC_STORAGE_BIT);

  /// Creates a buffer from an array, vector or span of plain structs.
  template <typename T>
  static Result<GlBuffer> FromSpan(std::span<const T> elements) {
    return Create(elements.size_bytes(), elements.data());
  }

  GlBuffer() = default;

  void Update(const void* data, std::size_t bytes, std::size_t offset = 0);
  /// Binds the whole buffer to an indexed target (GL_UNIFORM_BUFFER).
  void BindBase(GLenum target, int index) const;

  GLuint id() const { return handle_.id(); }
  explicit operator bool() const { return static_cast<bool>(handle_); }
  std::size_t size() const { return bytes_; }

 private:
  GlHandle<&DeleteBuffer> handle_;
  std::size_t bytes_ = 0;
};

}  // namespace pleinair::gl
