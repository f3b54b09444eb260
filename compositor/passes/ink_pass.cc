#include "compositor/passes/ink_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>

#include "compositor/passes/glm_vectors.h"
#include "compositor/passes/scene_shadows.h"
#include "compositor/surfaces/texture_rows.h"
#include "shadows/fading_shadow_maps.h"

namespace pleinair::compositor {
namespace {

// As shaders/ink.frag.
constexpr int kTexelsPerRow = 4096, kSegmentsPerRow = 2048, kShapesPerRow = 1365;
constexpr std::size_t kMaxLevels = 16;
constexpr int kFirstUnit = 24;

using ShapeTexels = std::array<glm::vec4, 3>;

ShapeTexels TexelsOf(const InkShape& shape) {
  const auto& [color, opacity, blend] = shape.style;
  const InkPen& pen = shape.pen;
  return {glm::vec4(ToGlm(color), opacity),
          glm::vec4(0.5F * pen.width_m, pen.width_m > 0.0F ? 0.0F : 0.5F * pen.width_px, pen.dash_m,
                    pen.gap_m),
          glm::vec4(static_cast<float>(blend), shape.rings.empty() ? 0.0F : 1.0F, 0.0F, 0.0F)};
}

}  // namespace

Result<void> InkPass::SetShapes(std::span<const InkShape> shapes, const Mat3& marker_from_map) {
  grid_ = InkGrid(shapes);
  marker_from_map_ = marker_from_map;
  Content content;
  for (const InkShape& shape : shapes) {
    content.areas = content.areas || !shape.rings.empty();
    content.paint = content.paint || shape.style.blend == InkBlend::kPaint;
    if (shape.pen.width_m <= 0.0F) {
      content.widest_px = std::max(content.widest_px, shape.pen.width_px);
    }
  }
  if (content.areas != content_.areas || content.paint != content_.paint) ClearPrograms();
  content_ = content;
  if (grid_.empty()) return {};
  if (!no_attributes_) no_attributes_ = gl::GlVertexArray::Create();
  return Upload(shapes);
}

Result<void> InkPass::Upload(std::span<const InkShape> shapes) {
  std::vector<std::array<std::uint32_t, 2>> cells = grid_.cells();
  PLEINAIR_RETURN_IF_ERROR(
      UploadRows(cells, kTexelsPerRow, GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, &tables_.cells));
  std::vector<std::array<std::uint32_t, 4>> entries;
  entries.reserve(grid_.entries().size());
  for (const InkGrid::Entry& entry : grid_.entries()) {
    entries.push_back(
        {entry.shape, entry.first_part, entry.count, std::bit_cast<std::uint32_t>(entry.inside)});
  }
  PLEINAIR_RETURN_IF_ERROR(UploadRows(entries, kTexelsPerRow, GL_RGBA32UI, GL_RGBA_INTEGER,
                                      GL_UNSIGNED_INT, &tables_.entries));
  std::vector<std::uint32_t> parts = grid_.parts();
  PLEINAIR_RETURN_IF_ERROR(
      UploadRows(parts, kTexelsPerRow, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &tables_.parts));
  std::vector<InkPart> segments = grid_.segments();
  PLEINAIR_RETURN_IF_ERROR(
      UploadRows(segments, kSegmentsPerRow, GL_RGBA32F, GL_RGBA, GL_FLOAT, &tables_.segments, 2));
  std::vector<ShapeTexels> texels;
  texels.reserve(shapes.size());
  for (const InkShape& shape : shapes) texels.push_back(TexelsOf(shape));
  return UploadRows(texels, kShapesPerRow, GL_RGBA32F, GL_RGBA, GL_FLOAT, &tables_.shapes, 3);
}

ImageTiles InkPass::TilesOf(SceneProjection image, const shadows::Box& bounds) const {
  ImageTiles tiles(image);
  const Mat3 map_from_marker = marker_from_map_.Transposed();
  double low = 1e30, high = -1e30;
  for (int corner = 0; corner < 8; ++corner) {
    const auto pick = [&](int axis) {
      return (corner >> axis & 1) == 0 ? bounds.min[axis] : bounds.max[axis];
    };
    const double up = (map_from_marker * Vec3{pick(0), pick(1), pick(2)}).z;
    low = std::min(low, up);
    high = std::max(high, up);
  }
  image.spread_px += 2;
  static constexpr std::array<std::uint32_t, 36> kSides = {0, 1, 2, 1, 2, 3, 4, 5, 6, 5, 6, 7,
                                                           0, 1, 4, 1, 4, 5, 2, 3, 6, 3, 6, 7,
                                                           0, 2, 4, 2, 4, 6, 1, 3, 5, 3, 5, 7};
  std::vector<glm::vec3> corners;
  std::vector<std::uint32_t> indices;
  for (const InkGrid::Box& box : grid_.Boxes()) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at{(corner & 1) == 0 ? box.low_m.x : box.high_m.x,
                    (corner & 2) == 0 ? box.low_m.y : box.high_m.y, (corner & 4) == 0 ? low : high};
      corners.push_back(ToGlm(marker_from_map_ * at));
    }
    for (const std::uint32_t index : kSides) indices.push_back(first + index);
  }
  tiles.Include(image, corners, indices);
  return tiles;
}

Result<const gl::GlProgram*> InkPass::ProgramFor(const Picture& picture) {
  std::optional<gl::GlProgram>& made = programs_[content_.paint && picture.fades ? 1 : 0];
  if (!made) {
    std::vector<std::string> defines;
    if (content_.paint) {
      defines = shadows::FadingShadowMaps::ShaderDefines(picture.maps, SceneShadows::kSets,
                                                         picture.fades);
      defines.emplace_back("PAINT");
    }
    if (content_.areas) defines.emplace_back("AREAS");
    PLEINAIR_ASSIGN_OR_RETURN(
        gl::GlProgram program,
        gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                               .fragment = "compositor/shaders/ink.frag",
                               .defines = std::move(defines)}));
    made.emplace(std::move(program));
  }
  return &*made;
}

void InkPass::SetLevels(const gl::GlProgram& program) const {
  std::vector<glm::vec3> levels;
  std::vector<float> first_cells;
  for (const InkGrid::Level& level :
       grid_.levels().first(std::min(grid_.levels().size(), kMaxLevels))) {
    levels.emplace_back(level.cell_m, level.cells.x, level.cells.y);
    first_cells.push_back(static_cast<float>(level.first_cell));
  }
  program.Set("u_last_level", static_cast<int>(levels.size()) - 1);
  levels.resize(kMaxLevels);
  first_cells.resize(kMaxLevels);
  program.SetArray("u_levels", levels);
  program.SetArray("u_first_cells", first_cells);
  program.Set("u_origin_m", grid_.origin_m());
  const auto axis = [&](Vec3 of_marker) {
    return ToGlm(marker_from_map_.Transposed() * of_marker);
  };
  program.Set("u_map_from_marker",
              glm::mat4(glm::mat3(axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1}))));
  program.Set("u_widest_px", content_.widest_px);
}

Result<void> InkPass::Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
                           const ShadowRatioPass& ratio, const FrameUniforms& frame,
                           const ShadowRatioPass::ShadowOptions& shadows, const Picture& picture,
                           const InkImages& images) {
  const std::vector<PixelRect> within = images.tiles.Rectangles();
  images.Begin();
  if (within.empty()) return {};
  PLEINAIR_ASSIGN_OR_RETURN(const gl::GlProgram* program, ProgramFor(picture));
  EnableSurfaceTests();
  ratio.DrawAllSurfaces(targets, surfaces, frame, images.tiles.Bounds());
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  images.framebuffer.Bind();
  targets.ids().Bind(0);
  surfaces.triangles().Bind();
  int unit = kFirstUnit;
  for (const gl::GlTexture* table :
       {&tables_.cells, &tables_.entries, &tables_.parts, &tables_.segments, &tables_.shapes}) {
    table->Bind(unit++);
  }
  program->Use();
  SetLevels(*program);
  frame.Set(*program);
  frame.SetRays(*program);
  frame.SetSunTransmittance(*program);
  program->Set("u_samples", targets.samples());
  program->Set("u_blur_px", picture.blur_px);
  program->Set("u_render_px", picture.render_px);
  program->Set("u_assumes_unmodelled_shadows", shadows.assume_unmodelled ? 1.0F : 0.0F);
  program->Set("u_margin_half_m", static_cast<float>(shadows.margin_size_m / 2));
  no_attributes_.Bind();
  DrawWithin(within);
  return {};
}

}  // namespace pleinair::compositor
