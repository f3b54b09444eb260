#pragma once

#include <epoxy/gl.h>

#include "gl/buffer.h"
#include "gl/handle.h"

namespace pleinair::gl {

inline void DeleteVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }

/// Assigns vertex buffers to the inputs of a shader. Does not own the buffers. Create() needs a
/// current context; a default-constructed object is empty. An array without attributes is used for
/// full-screen triangles made from gl_VertexID.
class GlVertexArray {
 public:
  static GlVertexArray Create() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    GlVertexArray array;
    array.handle_ = GlHandle<&DeleteVertexArray>(id);
    return array;
  }

  GlVertexArray() = default;

  /// Reads the input at `location` as `components` floats from `buffer`, one every `stride_bytes`
  /// from `offset_bytes` on. Uses the binding point of the same number.
  void SetFloatAttribute(int location, int components, const GlBuffer& buffer, int stride_bytes,
                         int offset_bytes = 0) {
    const auto index = static_cast<GLuint>(location);
    glVertexArrayVertexBuffer(id(), index, buffer.id(), offset_bytes, stride_bytes);
    glVertexArrayAttribFormat(id(), index, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(id(), index, index);
    glEnableVertexArrayAttrib(id(), index);
  }
  void SetElementBuffer(const GlBuffer& buffer) { glVertexArrayElementBuffer(id(), buffer.id()); }

  void Bind() const { glBindVertexArray(id()); }
  GLuint id() const { return handle_.id(); }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  GlHandle<&DeleteVertexArray> handle_;
};

}  // namespace pleinair::gl
