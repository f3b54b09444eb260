// Tests the table that shaders use to look up triangles, through texture units.

#include "compositor/surfaces/visibility_buffer.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/gl/gl_fixture.h"

namespace pleinair::compositor {
namespace {

using ::testing::ElementsAre;

/// This number of separate triangles, each its own component.
LitMesh Loose(std::uint32_t triangles) {
  LitMesh mesh;
  mesh.indices.resize(3 * std::size_t{triangles});
  std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
  mesh.positions.resize(mesh.indices.size());
  mesh.normals.resize(mesh.indices.size());
  mesh.ambient_with.resize(mesh.indices.size());
  return mesh;
}

class VisibilityBufferTest : public gl::GlTest {
 protected:
  struct Triangles {
    GLint texture = 0, rows = 0;
    std::vector<std::array<std::uint32_t, 4>> texels;  // By id, from 1 on.
  };
  /// Content of texture unit 1.
  static Triangles Bound(const VisibilityBuffer& table) {
    table.Bind();
    glActiveTexture(GL_TEXTURE1);
    Triangles bound;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound.texture);
    const auto id = static_cast<GLuint>(bound.texture);
    glGetTextureLevelParameteriv(id, 0, GL_TEXTURE_HEIGHT, &bound.rows);
    bound.texels.resize(std::size_t{VisibilityBuffer::kTrianglesPerRow} *
                        static_cast<std::size_t>(bound.rows));
    glGetTextureImage(id, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                      static_cast<GLsizei>(bound.texels.size() * sizeof bound.texels[0]),
                      bound.texels.data());
    return bound;
  }
};

TEST_F(VisibilityBufferTest, NumbersTheTrianglesOfAllMeshesUpToTheirLastEnds) {
  const LitMesh first = Loose(4), second = Loose(2);
  const std::vector<const LitMesh*> meshes{&first, &second};
  auto table = VisibilityBuffer::Create(meshes, std::vector<float>{0.25F, 0.5F});
  ASSERT_TRUE(table.has_value()) << table.error().Message();
  // A different order; the last of the first mesh's four triangles has no id.
  const std::vector<std::uint32_t> order{3, 4, 5, 0, 1, 2, 6, 7, 8, 9, 10, 11};
  const std::array<int, 3> first_ends{3, 3, 9}, second_ends{0, 6, 6};
  const std::vector<SortedTriangles> sorted{{order, first_ends, {}},
                                            {second.indices, second_ends, {}}};
  ASSERT_TRUE(table->SetTriangles(sorted));
  EXPECT_EQ(table->first_id(0), 1);
  EXPECT_EQ(table->first_id(1), 4);
  const Triangles bound = Bound(*table);
  const auto triangle = [&](int id) { return bound.texels[static_cast<std::size_t>(id) - 1]; };
  const auto component_and_kind = [](std::uint32_t component, std::uint32_t kind) {
    return component << VisibilityBuffer::kKindBits | kind;
  };
  EXPECT_THAT(triangle(1), ElementsAre(3, 4, 5, component_and_kind(1, 0)));
  EXPECT_THAT(triangle(2), ElementsAre(0, 1, 2, component_and_kind(0, 2)));
  EXPECT_THAT(triangle(3), ElementsAre(6, 7, 8, component_and_kind(2, 2)));
  // The vertices and components of the second mesh follow those of the complete first one.
  EXPECT_THAT(triangle(4), ElementsAre(12, 13, 14, component_and_kind(4, 1)));
  EXPECT_THAT(triangle(5), ElementsAre(15, 16, 17, component_and_kind(5, 1)));
  // The values per component are at unit 7: four components of one value and two of the other.
  glActiveTexture(GL_TEXTURE7);
  GLint values_texture = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &values_texture);
  std::vector<float> values(VisibilityBuffer::kTrianglesPerRow);
  glGetTextureImage(static_cast<GLuint>(values_texture), 0, GL_RED, GL_FLOAT,
                    static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
  values.resize(6);
  EXPECT_THAT(values, ElementsAre(0.25F, 0.25F, 0.25F, 0.25F, 0.5F, 0.5F));
}

TEST_F(VisibilityBufferTest, KeepsSteadyRatiosByTheNumbersOfTheirTriangles) {
  const LitMesh first = Loose(4), second = Loose(3);
  const std::vector<const LitMesh*> meshes{&first, &second};
  auto table = VisibilityBuffer::Create(meshes, std::vector<float>{0.25F, 0.5F});
  ASSERT_TRUE(table.has_value()) << table.error().Message();
  const auto linear_ratios = [](float mark) {
    LinearShadowRatio ratio{};
    ratio.plane.w = mark;
    ratio.range.x = -mark;
    return ratio;
  };
  const std::vector<LinearShadowRatio> of_first{linear_ratios(3.0F), linear_ratios(4.0F)},
      of_second{linear_ratios(7.0F)};
  const std::array<int, 2> first_ends{6, 12}, second_ends{6, 9};
  const std::vector<SortedTriangles> sorted{{first.indices, first_ends, of_first, 2},
                                            {second.indices, second_ends, of_second, 2}};
  ASSERT_TRUE(table->SetTriangles(sorted));
  table->BindLinearRatios();
  glActiveTexture(GL_TEXTURE1);
  GLint texture = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
  std::vector<LinearShadowRatio> bound(VisibilityBuffer::kLinearRatiosPerRow);
  glGetTextureImage(static_cast<GLuint>(texture), 0, GL_RGBA, GL_FLOAT,
                    static_cast<GLsizei>(bound.size() * sizeof bound[0]), bound.data());
  for (const std::size_t id : {3U, 4U, 7U}) {
    EXPECT_EQ(bound[id - 1].plane.w, static_cast<float>(id));
    EXPECT_EQ(bound[id - 1].range.x, -static_cast<float>(id));
  }
}

TEST_F(VisibilityBufferTest, GrowsWhereMoreTrianglesChangeAndKeepsItsMemoryWhereFewerDo) {
  constexpr int kAll = 3 * (VisibilityBuffer::kTrianglesPerRow + 10);
  const LitMesh mesh = Loose(kAll / 3);
  auto table =
      VisibilityBuffer::Create(std::vector<const LitMesh*>{&mesh}, std::vector<float>{0.0F});
  ASSERT_TRUE(table.has_value()) << table.error().Message();
  std::vector<Triangles> seen;
  for (const int end : {0, 3, kAll, 6, kAll}) {
    const std::array<int, 1> ends{end};
    ASSERT_TRUE(table->SetTriangles(std::vector<SortedTriangles>{{mesh.indices, ends, {}, 0}}));
    seen.push_back(Bound(*table));
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(end) / 3; ++i) {
      ASSERT_THAT(seen.back().texels[i],
                  ElementsAre(3 * i, 3 * i + 1, 3 * i + 2, i << VisibilityBuffer::kKindBits));
    }
  }
  EXPECT_EQ(seen[0].rows, 1);
  EXPECT_EQ(seen[1].texture, seen[0].texture);
  EXPECT_EQ(seen[2].rows, 2);
  for (const std::size_t later : {std::size_t{3}, std::size_t{4}}) {
    EXPECT_EQ(seen[later].rows, 2);
    EXPECT_EQ(seen[later].texture, seen[2].texture);
  }
}

}  // namespace
}  // namespace pleinair::compositor
