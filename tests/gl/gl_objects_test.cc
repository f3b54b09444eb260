#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/shader_library.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "tests/gl/gl_fixture.h"

namespace pleinair::gl {
namespace {

using ::testing::HasSubstr;

constexpr const char* kVertex =
    "#version 450 core\nlayout(location = 0) in vec2 position;\n"
    "void main() { gl_Position = vec4(position, 0.0, 1.0); }\n";
constexpr const char* kFragment =
    "#version 450 core\nuniform vec3 color;\nlayout(location = 0) out vec4 result;\n"
    "void main() { result = vec4(color, 1.0); }\n";
constexpr EmbeddedShader kBroken[] = {
    {"objects_test/broken.vert",
     "#version 450 core\n#include \"objects_test/part.glsl\"\nvoid main() {}\n"},
    {"objects_test/part.glsl", "float F() {\n  return nonsense;\n}\n"},
};

using GlObjects = GlTest;

TEST_F(GlObjects, DrawATriangleIntoOneLayerOfAnArray) {
  Result<GlTexture> picture = GlTexture::Create2DArray(GL_RGBA32F, 8, 4, 3);
  ASSERT_TRUE(picture.has_value()) << picture.error().Message();
  const Result<GlFramebuffer> framebuffer =
      GlFramebuffer::Create({.colors = {{.texture = &*picture, .layer = 1}}});
  ASSERT_TRUE(framebuffer.has_value()) << framebuffer.error().Message();
  const Result<GlProgram> program = GlProgram::FromText(
      {{GL_VERTEX_SHADER, kVertex, "vertex"}, {GL_FRAGMENT_SHADER, kFragment, "fragment"}});
  ASSERT_TRUE(program.has_value()) << program.error().Message();
  // The left half of the image.
  const std::array<float, 8> corners{-1, -1, 0, -1, -1, 1, 0, 1};
  const Result<GlBuffer> vertices = GlBuffer::FromSpan(std::span<const float>(corners));
  ASSERT_TRUE(vertices.has_value());
  GlVertexArray array = GlVertexArray::Create();
  array.SetFloatAttribute(0, 2, *vertices, 2 * sizeof(float));

  framebuffer->Bind();
  framebuffer->ClearColor(0, 0.0F, 0.0F, 0.0F, 0.0F);
  program->Use();
  program->Set("color", glm::vec3(0.25F, 0.5F, 4.0F));
  array.Bind();
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);

  std::vector<float> pixels(8 * 4 * 4 * 3);
  picture->Download(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(pixels)));
  const auto at = [&](int x, int y, int layer) { return &pixels[((layer * 4 + y) * 8 + x) * 4]; };
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(at(x, y, 1)[2], x < 4 ? 4.0F : 0.0F) << x << "," << y;
    }
  }
  std::vector<float> rows(8 * 4 * 4);
  framebuffer->ReadPixels(0, GL_RGBA, GL_FLOAT, rows.data());
  EXPECT_EQ(std::memcmp(rows.data(), at(0, 0, 1), rows.size() * sizeof(float)), 0);
}

TEST_F(GlObjects, ResolveFourSamplesAPixel) {
  Result<GlTexture> samples = GlTexture::Create2DMultisample(GL_RGBA32F, 4, 4, 4);
  Result<GlTexture> resolved = GlTexture::Create2D(GL_RGBA32F, 4, 4);
  ASSERT_TRUE(samples.has_value()) << samples.error().Message();
  ASSERT_TRUE(resolved.has_value());
  const Result<GlFramebuffer> from = GlFramebuffer::Create({.colors = {{.texture = &*samples}}});
  const Result<GlFramebuffer> to = GlFramebuffer::Create({.colors = {{.texture = &*resolved}}});
  ASSERT_TRUE(from.has_value() && to.has_value());
  from->ClearColor(0, 0.75F, 0.0F, 0.0F, 1.0F);
  from->BlitTo(*to);
  std::vector<float> pixels(4 * 4 * 4);
  resolved->Download(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(pixels)));
  EXPECT_EQ(pixels[0], 0.75F);
}

TEST_F(GlObjects, ReportWhichFileOfAShaderIsBroken) {
  ShaderLibrary::Register(kBroken);
  const Result<GlProgram> program = GlProgram::Create({.vertex = "objects_test/broken.vert"});
  ASSERT_FALSE(program.has_value());
  EXPECT_THAT(program.error().Message(), HasSubstr("1 = objects_test/part.glsl"));
  EXPECT_THAT(program.error().Message(), HasSubstr("1:2"));
  EXPECT_THAT(program.error().Message(), HasSubstr("nonsense"));
  context_->TakeErrors();  // Some drivers also report what the log contains.
}

TEST_F(GlObjects, RefuseTexturesBeyondTheLimits) {
  const Result<GlTexture> huge = GlTexture::Create2D(GL_RGBA8, 100'000, 100'000);
  ASSERT_FALSE(huge.has_value());
  EXPECT_EQ(huge.error().kind, ErrorKind::kSystem);
  EXPECT_THAT(huge.error().Message(), HasSubstr("100000×100000"));
  EXPECT_FALSE(GlTexture::Create2D(GL_RGBA8, 0, 4).has_value());
  EXPECT_FALSE(GlTexture::Create2DMultisample(GL_RGBA8, 4, 4, 1024).has_value());
}

TEST_F(GlObjects, MoveWithoutDeletingTwice) {
  Result<GlTexture> texture = GlTexture::Create2D(GL_RGBA8, 2, 2);
  ASSERT_TRUE(texture.has_value());
  const GLuint id = texture->id();
  GlTexture moved = std::move(*texture);
  EXPECT_EQ(moved.id(), id);
  moved = GlTexture();
  EXPECT_FALSE(glIsTexture(id));
}

TEST_F(GlObjects, BuffersKeepWhatTheyAreGiven) {
  const std::array<int, 3> numbers{1, 2, 3};
  Result<GlBuffer> buffer = GlBuffer::FromSpan(std::span<const int>(numbers));
  ASSERT_TRUE(buffer.has_value());
  const int seven = 7;
  buffer->Update(&seven, sizeof seven, sizeof seven);
  std::array<int, 3> read{};
  glGetNamedBufferSubData(buffer->id(), 0, sizeof read, read.data());
  EXPECT_EQ(read, (std::array<int, 3>{1, 7, 3}));
  EXPECT_TRUE(GlBuffer::Create(0).has_value());
}

}  // namespace
}  // namespace pleinair::gl
