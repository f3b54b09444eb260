#include "shadows/shadow_maps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/check.h"
#include "shadows/embedded_shaders.h"

namespace pleinair::shadows {
namespace {

// Unused texels along a border: kShadowBorder in shadow_visibility.glsl.
constexpr double kShadowBorder = 4.0;

// Margin of depth beyond the casters' bounds, so that none is clipped at the ends of the range.
constexpr double kDepthSlack_m = 0.01;

// Kernel radius, which depends on the maximum height of a caster above a receiver.
double KernelReach(const ShadowMapOptions& options, double depth_range_m) {
  return depth_range_m * std::tan(options.sun_angular_radius.value());
}

// 4×4 matrix from marker coordinates to the window's clip space.
glm::dmat4 ClipFromMarker(const LightAxes& axes, const LightWindow& window, double depth_min,
                          double depth_max) {
  const glm::dvec2 scale = 2.0 / (window.max - window.min);
  const double depth_scale = 2.0 / (depth_max - depth_min);
  glm::dmat4 rows(0.0);
  rows[0] = glm::dvec4(axes.u * scale.x, -window.min.x * scale.x - 1.0);
  rows[1] = glm::dvec4(axes.v * scale.y, -window.min.y * scale.y - 1.0);
  rows[2] = glm::dvec4(-axes.to_sun * depth_scale, -depth_min * depth_scale - 1.0);
  rows[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
  return glm::transpose(rows);
}

// Levels of a map's pyramid: from a quarter of its size down to 2 texels, or to blocks of 256
// texels, the maximum extent of a penumbra.
int PyramidLevels(int resolution) {
  return std::min(std::countr_zero(static_cast<unsigned>(resolution)) - 2, 7);
}

Result<gl::GlProgram> FullscreenProgram(const std::string& fragment,
                                        const std::vector<std::string>& defines) {
  return gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_fullscreen.vert",
                                .fragment = fragment,
                                .defines = defines});
}

}  // namespace

std::vector<std::string> ShadowMaps::ShaderDefines(const ShadowMapOptions& options, int sets) {
  std::vector<std::string> defines{"SHADOW_SETS " + std::to_string(sets),
                                   "SHADOW_PARTITIONS " + std::to_string(options.partitions),
                                   std::string(TraitsOf(options.method).shader_define)};
  if (options.sun_disc_filter == SunDiscFilter::kBox) defines.emplace_back("SUN_DISC_BOX");
  if (options.sun_disc_filter == SunDiscFilter::kSample) defines.emplace_back("SUN_DISC_SAMPLE");
  return defines;
}

Result<ShadowMaps> ShadowMaps::Create(const ShadowMapOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckShadowMapOptions(options));
  RegisterShaders();
  ShadowMaps maps;
  maps.options_ = options;
  const int size = *std::max_element(options.resolutions.begin(),
                                     options.resolutions.begin() + options.partitions);
  PLEINAIR_ASSIGN_OR_RETURN(maps.depth_, gl::GlTexture::Create2DArray(GL_DEPTH_COMPONENT32F, size,
                                                                      size, options.partitions));
  maps.depth_.SetFilter(GL_NEAREST, GL_NEAREST);
  PLEINAIR_ASSIGN_OR_RETURN(maps.uniform_buffer_, gl::GlBuffer::Create(sizeof(ShadowUniforms)));
  maps.no_vertices_ = gl::GlVertexArray::Create();
  if (options.method == ShadowMethod::kSunDisc) {
    PLEINAIR_ASSIGN_OR_RETURN(maps.edges_, EdgeMap::Create(options.resolutions[0]));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      maps.programs_.depth,
      gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_depth.vert",
                             .fragment = "shadows/shaders/shadow_depth.frag"}));
  for (int i = 0; i < options.partitions; ++i) {
    Slice slice;
    PLEINAIR_ASSIGN_OR_RETURN(
        slice.depth_target,
        gl::GlFramebuffer::Create({.depth = {.texture = &maps.depth_, .layer = i}}));
    maps.slices_.push_back(std::move(slice));
  }
  if (maps.UsesMoments()) {
    PLEINAIR_RETURN_IF_ERROR(maps.CreateMoments(size));
  } else if (maps.Content() == MapContent::kDepthBounds) {
    PLEINAIR_RETURN_IF_ERROR(maps.CreateBounds(size));
  }
  return maps;
}

Result<void> ShadowMaps::CreateMoments(int size) {
  const bool warped = Content() == MapContent::kWarpedMoments;
  std::vector<std::string> defines{"FROM_DEPTH"};
  if (warped) defines.emplace_back("WARPED");
  PLEINAIR_ASSIGN_OR_RETURN(programs_.first,
                            FullscreenProgram("shadows/shaders/shadow_moments.frag", defines));
  PLEINAIR_ASSIGN_OR_RETURN(programs_.second,
                            FullscreenProgram("shadows/shaders/shadow_moments.frag", {}));
  const GLenum format = warped ? GL_RGBA32F : GL_RG32F;
  PLEINAIR_ASSIGN_OR_RETURN(moments_,
                            gl::GlTexture::Create2DArray(format, size, size, options_.partitions));
  PLEINAIR_ASSIGN_OR_RETURN(blur_.texture, gl::GlTexture::Create2DArray(format, size, size, 1));
  PLEINAIR_ASSIGN_OR_RETURN(
      blur_.target,
      gl::GlFramebuffer::Create({.colors = {{.texture = &blur_.texture, .layer = 0}}}));
  for (int i = 0; i < options_.partitions; ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(
        slices_[i].moments_target,
        gl::GlFramebuffer::Create({.colors = {{.texture = &moments_, .layer = i}}}));
  }
  return {};
}

Result<void> ShadowMaps::CreateBounds(int size) {
  PLEINAIR_ASSIGN_OR_RETURN(
      programs_.first, FullscreenProgram("shadows/shaders/shadow_bounds.frag", {"FROM_DEPTH"}));
  PLEINAIR_ASSIGN_OR_RETURN(programs_.second,
                            FullscreenProgram("shadows/shaders/shadow_bounds.frag", {}));
  const int levels = PyramidLevels(size);
  PLEINAIR_ASSIGN_OR_RETURN(bounds_, gl::GlTexture::Create2DArray(GL_RG32F, size / 4, size / 4,
                                                                  options_.partitions, levels));
  bounds_.SetFilter(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST);
  for (int i = 0; i < options_.partitions; ++i) {
    for (int level = 0; level < PyramidLevels(options_.resolutions[i]); ++level) {
      PLEINAIR_ASSIGN_OR_RETURN(
          gl::GlFramebuffer target,
          gl::GlFramebuffer::Create(
              {.colors = {{.texture = &bounds_, .level = level, .layer = i}}}));
      slices_[i].bounds_targets.push_back(std::move(target));
    }
  }
  return {};
}

void ShadowMaps::SetShare(double share) {
  uniforms_.light_u.w = static_cast<float>(share);
  uniform_buffer_.Update(&uniforms_, sizeof uniforms_);
}

Result<int> ShadowMaps::UpdateForView(std::span<const ShadowCaster> casters,
                                      Direction<Marker> to_sun, const View& view) {
  if (!(Norm(to_sun.xyz) > 0.0)) return InputError("shadows", "the sun has no direction");
  if (!(view.near_m > 0.0 && view.far_m > view.near_m)) {
    return InputError("shadows", "the view's near depth is not below its far depth");
  }
  const LightAxes axes = LightAxes::FromSun({to_sun.xyz.x, to_sun.xyz.y, to_sun.xyz.z});
  Box scene;
  for (const ShadowCaster& caster : casters) scene.Include(caster.bounds);
  if (scene.Empty()) scene.Include(glm::dvec3(0.0));
  const LightExtent extent = Project(axes, scene);
  const double margin = KernelReach(options_, extent.depth_max - extent.depth_min);
  return Redraw(casters, axes,
                FitWindowsToView(axes, view, options_.partitions, options_.split_weight,
                                 options_.resolutions, extent, margin),
                options_.blend_band);
}

Result<int> ShadowMaps::UpdateForRegion(std::span<const ShadowCaster> casters,
                                        Direction<Marker> to_sun, const Box& focus) {
  if (!(Norm(to_sun.xyz) > 0.0)) return InputError("shadows", "the sun has no direction");
  const LightAxes axes = LightAxes::FromSun({to_sun.xyz.x, to_sun.xyz.y, to_sun.xyz.z});
  Box scene = focus;
  for (const ShadowCaster& caster : casters) scene.Include(caster.bounds);
  if (scene.Empty()) scene.Include(glm::dvec3(0.0));
  const LightExtent extent = Project(axes, scene);
  // Wide enough that Redraw() finds the focus covered and omits it from the coarser maps.
  const glm::dvec2 scene_size = extent.window.max - extent.window.min;
  const double coarsest_texel =
      std::max(scene_size.x, scene_size.y) / options_.resolutions[options_.partitions - 1];
  const double margin = KernelReach(options_, extent.depth_max - extent.depth_min) +
                        2.0 * kDepthSlack_m + (kShadowBorder + 2.0) * coarsest_texel;
  // No blend band: everything that the objects shade lies far from the finest map's border.
  return Redraw(casters, axes, FitWindowsToRegion(axes, focus, scene, options_.partitions, margin),
                0.0);
}

std::pair<double, double> ShadowMaps::DepthRange(const LightWindow& window,
                                                 const LightExtent& scene) const {
  double low = scene.depth_min, high = scene.depth_max;
  if (UsesMoments()) {
    // Moments need a short range. Casters nearer to the sun are flattened onto its near end (depth
    // clamp), which is not possible for methods that measure the distance of blockers. Casters
    // deeper than any receiver cast no shadow on it.
    high = std::min(high, window.receivers_max);
    low = std::min(std::max(low, window.receivers_min), high);
  }
  return {low - kDepthSlack_m, high + kDepthSlack_m};
}

Result<int> ShadowMaps::Redraw(std::span<const ShadowCaster> casters, const LightAxes& axes,
                               const std::vector<LightWindow>& windows, double blend_band) {
  LightExtent all{{}, 0.0, 0.0};
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const LightExtent extent = Project(axes, casters[i].bounds);
    all.depth_min = i == 0 ? extent.depth_min : std::min(all.depth_min, extent.depth_min);
    all.depth_max = i == 0 ? extent.depth_max : std::max(all.depth_max, extent.depth_max);
  }
  const double reach = KernelReach(options_, all.depth_max - all.depth_min + 2.0 * kDepthSlack_m);

  int redrawn = 0;
  for (int i = 0; i < options_.partitions; ++i) {
    const LightWindow& window = windows[i];
    const glm::dvec2 texel =
        (window.max - window.min) / static_cast<double>(options_.resolutions[i]);
    const auto [depth_min, depth_max] = DepthRange(window, all);
    const double range = depth_max - depth_min;
    const glm::dvec2 scale = 1.0 / texel;
    glm::dmat4 texel_from_marker(glm::dvec4(axes.u * scale.x, -window.min.x * scale.x),
                                 glm::dvec4(axes.v * scale.y, -window.min.y * scale.y),
                                 glm::dvec4(-axes.to_sun, -depth_min) / range,
                                 glm::dvec4(0.0, 0.0, 0.0, 1.0));
    texel_from_marker = glm::transpose(texel_from_marker);
    SliceKey key{window, depth_min, depth_max, axes.to_sun, {}};
    std::vector<ChangingCaster> changing;
    std::vector<EdgeMap::Caster> outlines;
    for (const ShadowCaster& caster : casters) {
      const LightWindow footprint = Project(axes, caster.bounds).window;
      if (!footprint.Overlaps(window)) continue;
      // Eq. 14: a caster that a finer window contains completely, with the reach of its kernels and
      // all depths that this window uses, need not be drawn again. Points are looked up in the
      // finest window that contains them, so nothing is lost.
      bool covered = false;
      for (int finer = 0; finer < i && !covered; ++finer) {
        LightWindow inner = windows[finer];
        const auto [finer_min, finer_max] = DepthRange(inner, all);
        const glm::dvec2 border =
            reach + blend_band * (inner.max - inner.min) +
            (kShadowBorder + 1.0) *
                glm::max(texel, (inner.max - inner.min) /
                                    static_cast<double>(options_.resolutions[finer]));
        inner.min += border;
        inner.max -= border;
        covered = inner.Contains(footprint) && finer_min <= depth_min && finer_max >= depth_max;
      }
      if (covered) continue;
      if (!UsesMoments() && !caster.triangles.indices.empty()) {
        changing.push_back(
            {caster.triangles, texel_from_marker * caster.marker_from_model, caster.revision});
        continue;
      }
      key.casters.push_back({caster.vertices->id(), caster.index_count, caster.marker_from_model,
                             caster.revision, caster.sun_side_only, caster.edges.data()});
      if (caster.index_count == 0) continue;
      outlines.push_back({caster.edges, texel_from_marker * caster.marker_from_model,
                          glm::inverse(glm::dmat3(caster.marker_from_model)) * axes.to_sun});
    }

    uniforms_.slices[i] = {
        glm::vec4(axes.u * scale.x, -window.min.x * scale.x),
        glm::vec4(axes.v * scale.y, -window.min.y * scale.y),
        glm::vec4(-axes.to_sun, -depth_min),
        glm::vec4(texel, options_.resolutions[i], range),
    };
    Slice& slice = slices_[i];
    const bool is_new = !(key == slice.drawn);
    if (is_new) {
      slice.drawn = std::move(key);
      DrawDepth(i, axes);
      if (UsesMoments()) DrawMoments(i);
      if (i == 0 && options_.method == ShadowMethod::kSunDisc) edges_.Draw(outlines);
    }
    const int side = options_.resolutions[i];
    const TexelRect changed = slice.changing.Draw(changing, is_new, side, i, depth_);
    if (!is_new && changed.Empty()) continue;
    if (Content() == MapContent::kDepthBounds && is_new) {
      DrawBounds(i);
      slice.changing_bounds.Forget();
    } else if (Content() == MapContent::kDepthBounds) {
      slice.changing_bounds.Update(slice.changing.depths(), changed, PyramidLevels(side), i,
                                   bounds_);
    }
    ++redrawn;
  }
  uniforms_.light_u = glm::vec4(axes.u, uniforms_.light_u.w);
  uniforms_.light_v = glm::vec4(axes.v, 0.0);
  uniforms_.to_sun = glm::vec4(axes.to_sun, std::tan(options_.sun_angular_radius.value()));
  // Minimum standard deviation of the moment methods, relative to the range: the noise of 32-bit
  // moments.
  uniforms_.settings = glm::vec4(options_.partitions, options_.bias.value(), 2e-4, blend_band);
  uniform_buffer_.Update(&uniforms_, sizeof uniforms_);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return redrawn;
}

void ShadowMaps::DrawDepth(int slice, const LightAxes& axes) {
  const SliceKey& key = slices_[slice].drawn;
  slices_[slice].depth_target.Bind();
  slices_[slice].depth_target.ClearDepth(1.0F);
  glViewport(0, 0, options_.resolutions[slice], options_.resolutions[slice]);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glFrontFace(GL_CCW);
  glEnable(GL_DEPTH_CLAMP);
  programs_.depth.Use();
  const glm::dmat4 clip_from_marker =
      ClipFromMarker(axes, key.window, key.depth_min, key.depth_max);
  for (const CasterKey& caster : key.casters) {
    programs_.depth.Set("clip_from_model", glm::mat4(clip_from_marker * caster.marker_from_model));
    (caster.sun_side_only ? glEnable : glDisable)(GL_CULL_FACE);
    glBindVertexArray(caster.vertices);
    glDrawElements(GL_TRIANGLES, caster.index_count, GL_UNSIGNED_INT, nullptr);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_CLAMP);
}

/// Makes the levels of the pyramid.
void ShadowMaps::DrawBounds(int slice) {
  glDisable(GL_DEPTH_TEST);
  no_vertices_.Bind();
  depth_.Bind(0);
  programs_.first.Use();
  programs_.first.Set("slice", slice);
  programs_.second.Set("slice", slice);
  const std::vector<gl::GlFramebuffer>& targets = slices_[slice].bounds_targets;
  for (int level = 0; level < static_cast<int>(targets.size()); ++level) {
    targets[level].Bind();
    const int side = options_.resolutions[slice] >> (level + 2);
    glViewport(0, 0, side, side);
    if (level == 1) {
      bounds_.Bind(0);
      programs_.second.Use();
    }
    if (level > 0) {
      // Reading and rendering to the same texture is defined only for levels excluded from
      // sampling.
      glTextureParameteri(bounds_.id(), GL_TEXTURE_BASE_LEVEL, level - 1);
      glTextureParameteri(bounds_.id(), GL_TEXTURE_MAX_LEVEL, level - 1);
    }
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glTextureParameteri(bounds_.id(), GL_TEXTURE_BASE_LEVEL, 0);
  glTextureParameteri(bounds_.id(), GL_TEXTURE_MAX_LEVEL, 1000);
  glEnable(GL_DEPTH_TEST);
}

void ShadowMaps::DrawMoments(int slice) {
  glDisable(GL_DEPTH_TEST);
  no_vertices_.Bind();
  const int resolution = options_.resolutions[slice];
  const glm::dvec2 texel = (slices_[slice].drawn.window.max - slices_[slice].drawn.window.min) /
                           static_cast<double>(resolution);
  // A uniform disc of radius ρ has the standard deviation ρ/2 along an axis.
  const double sigma_m =
      0.5 * options_.blur_blocker_distance.value() * std::tan(options_.sun_angular_radius.value());
  const auto pass = [&](const gl::GlProgram& program, const gl::GlFramebuffer& target,
                        const gl::GlTexture& source, int source_slice, bool along_u) {
    target.Bind();
    glViewport(0, 0, resolution, resolution);
    source.Bind(0);
    program.Use();
    program.Set("slice", source_slice);
    program.Set("resolution", resolution);
    program.Set("axis", glm::ivec2(along_u ? 1 : 0, along_u ? 0 : 1));
    program.Set("sigma_texels",
                static_cast<float>(std::clamp(sigma_m / (along_u ? texel.x : texel.y),
                                              options_.min_blur_texels, options_.max_blur_texels)));
    glDrawArrays(GL_TRIANGLES, 0, 3);
  };
  pass(programs_.first, blur_.target, depth_, slice, true);
  pass(programs_.second, slices_[slice].moments_target, blur_.texture, 0, false);
  glEnable(GL_DEPTH_TEST);
}

Image<float> ShadowMaps::ReadDepth(int partition) const {
  CHECK_LT(partition, options_.partitions);
  const int side = options_.resolutions[partition];
  Image<float> depths(side, side);
  glGetTextureSubImage(depth_.id(), 0, 0, 0, partition, side, side, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                       static_cast<GLsizei>(depths.size() * sizeof(float)), depths.data());
  return depths;
}

void ShadowMaps::Bind(int set) const {
  CHECK_GE(set, 0);
  uniform_buffer_.BindBase(GL_UNIFORM_BUFFER, kUniformBlockBinding + set);
  (UsesMoments() ? moments_ : depth_).Bind(kTextureUnit + 2 * set);
  const bool bounds = Content() == MapContent::kDepthBounds;
  (bounds ? bounds_ : UsesMoments() ? moments_ : depth_).Bind(kTextureUnit + 2 * set + 1);
  if (options_.method == ShadowMethod::kSunDisc) edges_.Bind(kEdgeTextureUnit + set);
}

}  // namespace pleinair::shadows
