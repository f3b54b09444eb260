#include "gl/buffer.h"

#include <string>

#include "base/check.h"

namespace pleinair::gl {

Result<GlBuffer> GlBuffer::Create(std::size_t bytes, const void* data, GLbitfield flags) {
  while (glGetError() != GL_NO_ERROR) {
  }
  GLuint id = 0;
  glCreateBuffers(1, &id);
  GlBuffer buffer;
  buffer.handle_ = GlHandle<&DeleteBuffer>(id);
  buffer.bytes_ = bytes;
  // GL rejects storage of size 0, but an empty mesh is valid here.
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes == 0 ? 1 : bytes),
                       bytes == 0 ? nullptr : data, flags);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    return SystemError("OpenGL",
                       "no memory for a buffer of " + std::to_string(bytes) + " bytes (GL error " +
                           std::to_string(error) + ")",
                       "use a smaller model");
  }
  return buffer;
}

void GlBuffer::Update(const void* data, std::size_t bytes, std::size_t offset) {
  CHECK_LE(offset + bytes, bytes_);
  glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void GlBuffer::BindBase(GLenum target, int index) const {
  glBindBufferBase(target, static_cast<GLuint>(index), id());
}

}  // namespace pleinair::gl
