#include "compositor/passes/coverage_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "compositor/surfaces/texture_rows.h"

namespace pleinair::compositor {
namespace {

// As shaders/covered_pixels.frag.
constexpr int kPixelsPerRow = 1024, kTexelsPerPixel = 3;
static_assert(sizeof(PixelPieces) == kTexelsPerPixel * 4 * sizeof(std::uint32_t));

/// The words of marks in halves, each with the number of its first pixel.
std::vector<std::array<std::uint32_t, 2>> TexelsOf(const PixelMarks& marks) {
  std::vector<std::array<std::uint32_t, 2>> texels;
  texels.reserve(2 * static_cast<std::size_t>(marks.words_per_row() * marks.height()));
  for (int y = 0; y < marks.height(); ++y) {
    for (int word = 0; word < marks.words_per_row(); ++word) {
      const std::uint64_t bits = marks.Word(word, y);
      const auto low = static_cast<std::uint32_t>(bits);
      const auto first = static_cast<std::uint32_t>(marks.FirstOf(word, y));
      texels.push_back({low, first});
      texels.push_back({static_cast<std::uint32_t>(bits >> 32U),
                        first + static_cast<std::uint32_t>(std::popcount(low))});
    }
  }
  return texels;
}

}  // namespace

Result<CoveragePass> CoveragePass::Create(int places, bool textured) {
  CoveragePass pass;
  gl::ProgramStages stages{.vertex = "compositor/shaders/screen_triangle.vert",
                           .fragment = "compositor/shaders/covered_pixels.frag"};
  PLEINAIR_ASSIGN_OR_RETURN(pass.real_program_, gl::GlProgram::Create(stages));
  stages.defines.emplace_back("OBJECT");
  if (textured) stages.defines.emplace_back("TEXTURED");
  PLEINAIR_ASSIGN_OR_RETURN(pass.object_program_, gl::GlProgram::Create(stages));
  pass.no_attributes_ = gl::GlVertexArray::Create();
  pass.coverage_.emplace(places, textured);
  return pass;
}

void CoveragePass::Measure(SceneSurfaces& surfaces, const FrameUniforms& frame,
                           const RenderTargets& targets, std::span<const PixelRect> within) {
  rectangles_.clear();
  if (!coverage_ || frame.place.behind.dioptres != nullptr) return;
  for (const PixelRect& tiles : within) drawn_px_ += std::int64_t{tiles.width} * tiles.height;
  coverage_->Measure(
      surfaces.DrawnMeshes(),
      {frame.clip_from_marker, targets.seen().width(), targets.seen().height(), within}, &pieces_);
  const PixelMarks& marks = coverage_->marks();
  if (marks.Count() == 0) return;
  const auto measured = std::ranges::count_if(pieces_, [](const PixelPieces& pieces) {
    return pieces.object_kind != PixelPieces::kKeepSamples;
  });
  if (!Upload()) return;
  measured_px_ += measured;
  rectangles_ = marks.Tiles().Rectangles();
}

Result<void> CoveragePass::Upload() {
  const PixelMarks& marks = coverage_->marks();
  const auto texels = TexelsOf(marks);
  if (!marks_) {  // The size is that of the render targets.
    PLEINAIR_ASSIGN_OR_RETURN(
        marks_, gl::GlTexture::Create2D(GL_RG32UI, 2 * marks.words_per_row(), marks.height()));
    marks_.SetFilter(GL_NEAREST, GL_NEAREST);
  }
  marks_.Upload(GL_RG_INTEGER, GL_UNSIGNED_INT, texels.data());
  return UploadRows(pieces_, kPixelsPerRow, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                    &piece_texels_, kTexelsPerPixel);
}

void CoveragePass::DrawOver(bool objects, int samples) const {
  if (rectangles_.empty()) return;
  marks_.Bind(20);
  piece_texels_.Bind(21);
  const gl::GlProgram& program = objects ? object_program_ : real_program_;
  program.Use();
  program.Set("u_samples", samples);
  no_attributes_.Bind();
  DrawWithin(rectangles_);
}

}  // namespace pleinair::compositor
