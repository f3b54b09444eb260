#include "shadows/bench/bench_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <span>
#include <utility>

#include "shadows/embedded_shaders.h"

namespace pleinair::shadows {
namespace {

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Rounds a depth to the grid 2^(k/8), down (−1) or up (+1).
double Stepped(double depth_m, int direction) {
  const double steps = 8.0 * std::log2(depth_m);
  return std::exp2((direction < 0 ? std::floor(steps) : std::ceil(steps)) / 8.0);
}

}  // namespace

Result<BenchRenderer> BenchRenderer::Create(const BenchScene& scene, int width, int height,
                                            int samples) {
  RegisterShaders();
  BenchRenderer renderer;
  renderer.width_ = width;
  renderer.height_ = height;
  renderer.scene_.to_sun = scene.to_sun;
  for (const BenchMesh& mesh : scene.meshes) {
    Surface& surface = renderer.scene_.surfaces.emplace_back();
    PLEINAIR_ASSIGN_OR_RETURN(surface.positions, gl::GlBuffer::FromSpan(std::span(mesh.positions)));
    PLEINAIR_ASSIGN_OR_RETURN(surface.indices, gl::GlBuffer::FromSpan(std::span(mesh.indices)));
    surface.vertices = gl::GlVertexArray::Create();
    surface.vertices.SetFloatAttribute(0, 3, surface.positions, sizeof(glm::vec3));
    surface.vertices.SetElementBuffer(surface.indices);
    surface.index_count = static_cast<int>(mesh.indices.size());
    ShadowCaster caster;
    caster.vertices = &surface.vertices;
    caster.index_count = surface.index_count;
    for (const glm::vec3& p : mesh.positions) caster.bounds.Include(glm::dvec3(p));
    renderer.scene_.casters.push_back(caster);
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      renderer.programs_.depth,
      gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_view.vert",
                             .fragment = "shadows/shaders/shadow_depth.frag"}));
  Target& target = renderer.target_;
  PLEINAIR_ASSIGN_OR_RETURN(target.picture, gl::GlTexture::Create2D(GL_RG32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(target.depth,
                            gl::GlTexture::Create2D(GL_DEPTH_COMPONENT32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(target.framebuffer,
                            gl::GlFramebuffer::Create({.colors = {{.texture = &target.picture}},
                                                       .depth = {.texture = &target.depth}}));
  if (samples > 1) {
    Target& several = renderer.samples_target_.emplace();
    PLEINAIR_ASSIGN_OR_RETURN(several.picture,
                              gl::GlTexture::Create2DMultisample(GL_RG32F, width, height, samples));
    PLEINAIR_ASSIGN_OR_RETURN(several.depth, gl::GlTexture::Create2DMultisample(
                                                 GL_DEPTH_COMPONENT32F, width, height, samples));
    PLEINAIR_ASSIGN_OR_RETURN(several.framebuffer,
                              gl::GlFramebuffer::Create({.colors = {{.texture = &several.picture}},
                                                         .depth = {.texture = &several.depth}}));
  }
  renderer.no_vertices_ = gl::GlVertexArray::Create();
  return renderer;
}

Result<void> BenchRenderer::SetMethod(const ShadowMapOptions& options) {
  maps_.clear();
  PLEINAIR_ASSIGN_OR_RETURN(ShadowMaps maps, ShadowMaps::Create(options));
  std::vector<std::string> defines = ShadowMaps::ShaderDefines(options, 1);
  PLEINAIR_ASSIGN_OR_RETURN(programs_.view,
                            gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_view.vert",
                                                   .fragment = "shadows/shaders/shadow_view.frag",
                                                   .defines = defines}));
  PLEINAIR_ASSIGN_OR_RETURN(
      programs_.probe, gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_fullscreen.vert",
                                              .fragment = "shadows/shaders/shadow_probe.frag",
                                              .defines = defines}));
  defines.emplace_back("SHOW_PARTITIONS");
  PLEINAIR_ASSIGN_OR_RETURN(programs_.partitions,
                            gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_view.vert",
                                                   .fragment = "shadows/shaders/shadow_view.frag",
                                                   .defines = defines}));
  maps_.push_back(std::move(maps));
  return {};
}

Result<View> BenchRenderer::Tightened(const View& view) {
  DrawDepth(target_.framebuffer, view);
  std::vector<float> depths(static_cast<std::size_t>(width_) * height_);
  glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  float minimum = 1.0F, maximum = 0.0F;
  for (const float depth : depths) {
    if (depth >= 1.0F) continue;
    minimum = std::min(minimum, depth);
    maximum = std::max(maximum, depth);
  }
  if (minimum > maximum)
    return InputError("the view", "shows no surface", "turn the camera to the scene");
  const auto metres = [&](double depth) {
    return 2.0 * view.near_m * view.far_m /
           (view.far_m + view.near_m - (2.0 * depth - 1.0) * (view.far_m - view.near_m));
  };
  View tightened = view;
  tightened.near_m = Stepped(metres(minimum), -1);
  tightened.far_m = Stepped(metres(maximum) * 1.001, 1);
  return tightened;
}

Result<int> BenchRenderer::UpdateMaps(const View& view) {
  return maps_.front().UpdateForView(scene_.casters,
                                     {{scene_.to_sun.x, scene_.to_sun.y, scene_.to_sun.z}}, view);
}

void BenchRenderer::DrawSurfaces(const gl::GlProgram& program, const View& view) {
  program.Use();
  program.Set("clip_from_marker", glm::mat4(view.ClipFromMarker()));
  for (const Surface& surface : scene_.surfaces) {
    surface.vertices.Bind();
    glDrawElements(GL_TRIANGLES, surface.index_count, GL_UNSIGNED_INT, nullptr);
  }
}

void BenchRenderer::DrawDepth(const gl::GlFramebuffer& target, const View& view) {
  target.Bind();
  target.ClearColor(0, 1, 0, 0, 0);
  target.ClearDepth(1.0F);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  DrawSurfaces(programs_.depth, view);
}

void BenchRenderer::DrawVisible(const gl::GlProgram& program, const View& view) {
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  maps_.front().Bind(0);
  program.Set("eye", glm::vec3(glm::inverse(view.camera_from_marker)[3]));
  program.Set("depth_from_marker", glm::vec4(glm::transpose(view.camera_from_marker)[2]));
  DrawSurfaces(program, view);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  if (samples_target_) samples_target_->framebuffer.BlitTo(target_.framebuffer);
}

VisibilityPicture BenchRenderer::Read() const {
  Image<float> both(width_, height_, 2);
  target_.framebuffer.ReadPixels(0, GL_RG, GL_FLOAT, both.data());
  VisibilityPicture picture{Image<float>(width_, height_), Image<float>(width_, height_)};
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      picture.visibility(x, y) = both(x, y, 0);
      picture.depth_m(x, y) = both(x, y, 1);
    }
  }
  return picture;
}

Result<VisibilityPicture> BenchRenderer::Draw(const View& view, int* redrawn) {
  PLEINAIR_ASSIGN_OR_RETURN(const int count, UpdateMaps(view));
  if (redrawn != nullptr) *redrawn = count;
  DrawDepth(DrawTarget(), view);
  DrawVisible(programs_.view, view);
  return Read();
}

Result<VisibilityPicture> BenchRenderer::DrawPartitions(const View& view) {
  PLEINAIR_RETURN_IF_ERROR(UpdateMaps(view));
  DrawDepth(DrawTarget(), view);
  DrawVisible(programs_.partitions, view);
  return Read();
}

Result<FrameTime> BenchRenderer::Time(const View& view, int frames) {
  FrameTime minimum{1e30, 1e30, 1e30};
  for (int i = 0; i < frames; ++i) {
    maps_.front().Invalidate();
    glFinish();
    const std::clock_t cpu_start = std::clock();
    auto start = Clock::now();
    PLEINAIR_RETURN_IF_ERROR(UpdateMaps(view));
    glFinish();
    minimum.maps_ms = std::min(minimum.maps_ms, MillisecondsSince(start));
    start = Clock::now();
    DrawDepth(DrawTarget(), view);
    DrawVisible(programs_.view, view);
    glFinish();
    minimum.scene_ms = std::min(minimum.scene_ms, MillisecondsSince(start));
    minimum.cpu_ms = std::min(minimum.cpu_ms,
                              1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
  }
  return minimum;
}

Result<std::vector<float>> BenchRenderer::Probe(const ProbeGrid& grid) {
  PLEINAIR_ASSIGN_OR_RETURN(const gl::GlTexture picture,
                            gl::GlTexture::Create2D(GL_R32F, grid.width, grid.height));
  PLEINAIR_ASSIGN_OR_RETURN(const gl::GlFramebuffer target,
                            gl::GlFramebuffer::Create({.colors = {{.texture = &picture}}}));
  target.Bind();
  glDisable(GL_DEPTH_TEST);
  programs_.probe.Use();
  programs_.probe.Set("origin", glm::vec3(grid.origin));
  programs_.probe.Set("du", glm::vec3(grid.du));
  programs_.probe.Set("dv", glm::vec3(grid.dv));
  programs_.probe.Set("normal", glm::vec3(grid.normal));
  maps_.front().Bind(0);
  no_vertices_.Bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> values(static_cast<std::size_t>(grid.width) * grid.height);
  target.ReadPixels(0, GL_RED, GL_FLOAT, values.data());
  glEnable(GL_DEPTH_TEST);
  return values;
}

}  // namespace pleinair::shadows
