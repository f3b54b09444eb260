#include "compositor/picture/camera_picture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "compositor/light/sampling.h"
#include "compositor/picture/grain.h"

namespace pleinair::compositor {
namespace {

// Edge spread of the rendering itself, camera pixels, standard deviation: a pixel's width. A warped
// image has a smaller pixel plus interpolation.
constexpr double kOwnBlurPx = 0.29, kWarpedBlurPx = 0.33;
// Minimum visible blur. Minimum noise in 8-bit steps: weaker noise cannot be distinguished from
// compression artefacts.
constexpr double kMinBlur_px = 0.3, kMinNoiseSteps = 2.0;
constexpr double kMaxBlur_px = 12.0;
constexpr int kGrainSide = 256, kPixelValueTableSize = 4096;
// Sixteen steps for each step of 8 bits.
constexpr int kLightTableSize = 16 * 255 + 1;
// Reach of a sample beside its position. The farther texel of a position on a border has no weight.
constexpr float kInterpolation_px = 0.49F;

}  // namespace

CameraPicture::Sampled CameraPicture::SampledFrom(int x, int y, const Image<float>& positions) {
  Sampled sampled;
  sampled.tile = {x, y, std::min(ImageTiles::kSide_px, positions.width() - x),
                  std::min(ImageTiles::kSide_px, positions.height() - y)};
  for (int v = y; v < y + sampled.tile.height; ++v) {
    for (int u = x; u < x + sampled.tile.width; ++u) {
      const glm::vec2 at(positions(u, v, 0), positions(u, v, 1));
      sampled.low = glm::min(sampled.low, at - kInterpolation_px);
      sampled.high = glm::max(sampled.high, at + kInterpolation_px);
    }
  }
  return sampled;
}

Result<CameraPicture> CameraPicture::Create(const CameraModel& camera, const RenderCamera& render,
                                            double supersampling, const CameraResponse& response) {
  CameraPicture picture;
  picture.camera_ = camera;
  picture.response_.curve = response;
  picture.supersampling_ = supersampling;
  for (gl::GlTexture* texture : {&picture.background_, &picture.output_.picture}) {
    PLEINAIR_ASSIGN_OR_RETURN(*texture,
                              gl::GlTexture::Create2D(GL_RGBA8, camera.width, camera.height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(picture.positions_,
                            gl::GlTexture::Create2D(GL_RG32F, camera.width, camera.height));
  const Image<float> positions = RenderPositions(camera, render);
  picture.positions_.Upload(GL_RG, GL_FLOAT, positions.data());
  for (int y = 0; y < camera.height; y += ImageTiles::kSide_px) {
    for (int x = 0; x < camera.width; x += ImageTiles::kSide_px) {
      picture.sampled_.push_back(SampledFrom(x, y, positions));
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(picture.camera_positions_,
                            gl::GlTexture::Create2D(GL_RG32F, render.width, render.height));
  picture.camera_positions_.Upload(GL_RG, GL_FLOAT, CameraPositions(camera, render).data());
  PLEINAIR_ASSIGN_OR_RETURN(picture.output_.framebuffer,
                            gl::GlFramebuffer::Create({{{&picture.output_.picture}}, {}}));
  picture.no_attributes_ = gl::GlVertexArray::Create();
  gl::ProgramStages blur{.vertex = "compositor/shaders/screen_triangle.vert",
                         .fragment = "compositor/shaders/blur.frag"};
  PLEINAIR_ASSIGN_OR_RETURN(picture.programs_.blur, gl::GlProgram::Create(blur));
  blur.defines = {"NO_OBJECTS"};
  PLEINAIR_ASSIGN_OR_RETURN(picture.programs_.blur_of_ratio, gl::GlProgram::Create(blur));
  PLEINAIR_RETURN_IF_ERROR(picture.CreateResponseTables());
  for (const bool coarse : {false, true}) {
    for (const bool grain : {false, true}) {
      PLEINAIR_ASSIGN_OR_RETURN(
          picture.programs_.composite[coarse ? 1 : 0][grain ? 1 : 0],
          picture.CreateComposite(
              coarse ? std::vector<std::string>{"COARSE_RATIO"} : std::vector<std::string>{},
              grain));
    }
  }
  return picture;
}

Result<gl::GlProgram> CameraPicture::CreateComposite(std::vector<std::string> defines,
                                                     bool grain) const {
  if (!response_.curve.IsSrgb()) defines.emplace_back("CAMERA_RESPONSE");
  if (!camera_.HasDistortion() && supersampling_ == 1.0) defines.emplace_back("SAME_PIXELS");
  if (grain) defines.emplace_back("GRAIN");
  return gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                                .fragment = "compositor/shaders/composite.frag",
                                .defines = defines});
}

Result<void> CameraPicture::CreateResponseTables() {
  std::array<std::vector<float>, 2> tables;
  for (int i = 0; i < kLightTableSize; ++i) {
    const int value = (i * 0xFFFF + (kLightTableSize - 1) / 2) / (kLightTableSize - 1);
    for (int c = 0; c < 3; ++c) {
      tables[0].push_back(response_.curve.LinearOf16(static_cast<std::uint16_t>(value), c));
    }
  }
  for (int i = 0; i < kPixelValueTableSize; ++i) {
    const double root = static_cast<double>(i) / (kPixelValueTableSize - 1);
    for (int c = 0; c < 3; ++c) {
      tables[1].push_back(static_cast<float>(response_.curve.Encoded(root * root, c)));
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(response_.light_of_pixel_value,
                            gl::GlTexture::Create2D(GL_RGB32F, kLightTableSize, 1));
  PLEINAIR_ASSIGN_OR_RETURN(response_.pixel_value_of_light,
                            gl::GlTexture::Create2D(GL_RGB32F, kPixelValueTableSize, 1));
  response_.light_of_pixel_value.Upload(GL_RGB, GL_FLOAT, tables[0].data());
  response_.pixel_value_of_light.Upload(GL_RGB, GL_FLOAT, tables[1].data());
  return {};
}

Result<void> CameraPicture::SetCameraLook(const std::optional<CameraLook>& look) {
  added_blur_px_ = 0.0;
  grain_.look.reset();
  if (!look) return {};
  const double own = camera_.HasDistortion() ? kWarpedBlurPx : kOwnBlurPx;
  if (look->blur_px > own) {
    added_blur_px_ = std::min(std::sqrt(look->blur_px * look->blur_px - own * own), kMaxBlur_px);
  }
  if (added_blur_px_ < kMinBlur_px) added_blur_px_ = 0.0;
  // Medium grey, where eyes are most sensitive.
  constexpr int kGreyCode = 118;
  const auto& table = response_.curve.Linear(1);
  const double step = table[kGreyCode + 1] - table[kGreyCode];
  if (look->NoiseSigma(1, table[kGreyCode]) < kMinNoiseSteps * step) return {};
  grain_.look = look;
  constexpr double kSameCorrelation = 0.05;
  if (std::fabs(look->neighbour_correlation - grain_.correlation) > kSameCorrelation) {
    grain_.correlation = look->neighbour_correlation;
    if (!grain_.texture) {
      PLEINAIR_ASSIGN_OR_RETURN(grain_.texture,
                                gl::GlTexture::Create2D(GL_RGBA16F, kGrainSide, kGrainSide));
    }
    grain_.texture.Upload(GL_RGBA, GL_FLOAT, MakeGrain(kGrainSide, grain_.correlation).data());
  }
  return {};
}

int CameraPicture::BlurReach_px() const {
  return static_cast<int>(std::ceil(2.5 * added_blur_px_ * supersampling_));
}

/// Blurs both virtual images, along the rows and then along the columns.
void CameraPicture::Blur(const RenderTargets& targets, const AffectedTiles& tiles) const {
  const std::vector<PixelRect> objects = tiles.objects.Rectangles();
  const std::vector<PixelRect> others = tiles.fine.Without(tiles.objects).Rectangles();
  no_attributes_.Bind();
  for (const bool back : {false, true}) {
    targets.BeginPass(back);
    (back ? targets.passed_ratio() : targets.ratio()).Bind(1);
    (back ? targets.passed_objects() : targets.objects()).Bind(2);
    for (const bool has_objects : {true, false}) {
      const gl::GlProgram& program = has_objects ? programs_.blur : programs_.blur_of_ratio;
      program.Use();
      program.Set("u_sigma_px", static_cast<float>(added_blur_px_ * supersampling_));
      program.Set("u_reach_px", BlurReach_px());
      program.Set("u_direction", back ? glm::ivec2(0, 1) : glm::ivec2(1, 0));
      DrawWithin(has_objects ? objects : others);
    }
  }
}

void CameraPicture::SetGrain(const gl::GlProgram& program) const {
  const CameraLook& look = *grain_.look;
  const auto to_glm = [](const std::array<double, 3>& a) { return glm::vec3(a[0], a[1], a[2]); };
  const std::uint32_t offset = Hash(grain_.pictures, 0x6A);
  program.Set("u_grain_offset", glm::ivec2(offset % kGrainSide, offset / kGrainSide % kGrainSide));
  program.Set("u_noise_constant", to_glm(look.noise_constant));
  program.Set("u_noise_slope", to_glm(look.noise_slope));
  program.Set("u_channel_correlation", static_cast<float>(look.channel_correlation));
  grain_.texture.Bind(6);
}

Result<void> CameraPicture::SetBackground(CameraImageView image) {
  const auto check = [&](const auto& view) {
    CHECK_EQ(view.width(), camera_.width);
    CHECK_EQ(view.height(), camera_.height);
    CHECK_EQ(view.channels(), 3);
    CHECK_EQ(view.stride(), static_cast<std::ptrdiff_t>(camera_.width) * 3);
  };
  check(image.rgb());
  if (!image.deep().empty()) check(image.deep());
  const bool deep = !image.deep().empty();
  const GLenum format = deep ? GL_RGBA16 : GL_RGBA8;
  if (background_.internal_format() != format) {
    PLEINAIR_ASSIGN_OR_RETURN(background_,
                              gl::GlTexture::Create2D(format, camera_.width, camera_.height));
  }
  if (deep) {
    background_.Upload(GL_RGB, GL_UNSIGNED_SHORT, image.deep().data());
  } else {
    background_.Upload(GL_RGB, GL_UNSIGNED_BYTE, image.rgb().data());
  }
  return {};
}

ImageTiles CameraPicture::SetTiles(const AffectedTiles& tiles, const InkImages* ink) {
  ImageTiles fine = tiles.fine;
  ImageTiles drawn_fine(camera_.width, camera_.height), drawn_coarse = drawn_fine;
  ImageTiles drawn_inked = drawn_fine;
  for (const Sampled& sampled : sampled_) {
    const auto& [x, y, width, height] = sampled.tile;
    const glm::vec2 low(x + 0.5F, y + 0.5F), high(x + width - 0.5F, y + height - 0.5F);
    const bool is_drawn = tiles.all.Touches(sampled.low, sampled.high);
    const bool has_ink = ink != nullptr && ink->tiles.Touches(sampled.low, sampled.high);
    if (tiles.fine.Touches(sampled.low, sampled.high) || (is_drawn && has_ink)) {
      drawn_fine.Include(low, high);
      fine.Include(sampled.low, sampled.high);
    } else if (is_drawn) {
      drawn_coarse.Include(low, high);
    } else if (has_ink) {
      drawn_inked.Include(low, high);
    }
  }
  output_.fine = drawn_fine.Rectangles();
  output_.coarse = drawn_coarse.Rectangles();
  output_.inked = drawn_inked.Rectangles();
  return fine;
}

Result<const gl::GlProgram*> CameraPicture::FineProgram(const Parts& parts) {
  const bool grain = grain_.look.has_value();
  if (!parts.occluded && !parts.inked) return &programs_.composite[0][grain ? 1 : 0];
  std::optional<gl::GlProgram>& made =
      programs_.others[(parts.occluded ? 1U : 0U) | (parts.inked ? 2U : 0U) |
                       (parts.ink_alone ? 4U : 0U) | (grain ? 8U : 0U)];
  if (!made) {
    std::vector<std::string> defines;
    if (parts.occluded) defines.emplace_back("OCCLUDED");
    if (parts.inked) defines.emplace_back("INK");
    if (parts.ink_alone) defines.emplace_back("INK_ALONE");
    PLEINAIR_ASSIGN_OR_RETURN(gl::GlProgram program, CreateComposite(defines, grain));
    made.emplace(std::move(program));
  }
  return &*made;
}

Result<void> CameraPicture::Draw(const RenderTargets& targets, const gl::GlTexture& coarse_ratio,
                                 const AffectedTiles& tiles, const RealOccluders* occluders,
                                 const InkImages* ink) {
  PLEINAIR_ASSIGN_OR_RETURN(const gl::GlProgram* fine,
                            FineProgram({occluders != nullptr, ink != nullptr, false}));
  const gl::GlProgram* inked = nullptr;
  if (ink != nullptr && !output_.inked.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(inked, FineProgram({false, true, true}));
  }
  if (added_blur_px_ > 0.0) Blur(targets, tiles);
  output_.framebuffer.Bind();
  if (!response_.curve.IsSrgb()) {
    response_.light_of_pixel_value.Bind(4);
    response_.pixel_value_of_light.Bind(5);
  }
  background_.Bind(0);
  targets.objects().Bind(2);
  positions_.Bind(3);
  no_attributes_.Bind();
  const auto draw = [&](const gl::GlProgram& program, const gl::GlTexture& ratio,
                        std::span<const PixelRect> within) {
    program.Use();
    if (grain_.look) SetGrain(program);
    ratio.Bind(1);
    DrawWithin(within);
  };
  if (occluders != nullptr) {
    occluders->background().Bind(7);
    occluders->occluders().Bind(8);
  }
  if (ink != nullptr) {
    ink->kept.Bind(9);
    ink->lit.Bind(10);
    ink->unlit.Bind(11);
  }
  draw(*fine, targets.ratio(), output_.fine);
  draw(programs_.composite[1][grain_.look ? 1 : 0], coarse_ratio, output_.coarse);
  if (inked != nullptr) draw(*inked, targets.ratio(), output_.inked);
  ++grain_.pictures;
  return {};
}

RgbImage CameraPicture::Read(ImageView<const std::uint8_t> rgb) const {
  RgbImage composed(camera_.width, camera_.height, 3);
  std::copy_n(rgb.data(), composed.size(), composed.data());
  for (const auto* rectangles : {&output_.fine, &output_.coarse, &output_.inked}) {
    for (const auto& [x, y, width, height] : *rectangles) {
      output_.framebuffer.ReadRectangle(x, y, width, height, GL_RGB, GL_UNSIGNED_BYTE,
                                        camera_.width, &composed(x, y));
    }
  }
  return composed;
}

}  // namespace pleinair::compositor
