#include "tests/shadows/shadow_scene.h"

#include <cmath>
#include <numbers>
#include <span>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/shader_library.h"
#include "gl/texture.h"

namespace pleinair::shadows {
namespace {

constexpr gl::EmbeddedShader kProbe[] = {{"shadow_test/probe.frag", R"(#version 450 core
#include "shadows/shaders/shadow_visibility.glsl"
uniform vec3 origin;
uniform vec3 du;
uniform vec3 dv;
uniform vec3 normal;
layout(location = 0) out float visibility;
void main() {
  vec3 position = origin + du * gl_FragCoord.x + dv * gl_FragCoord.y;
  visibility = ShadowVisibility(0, position, normal);
}
)"}};

}  // namespace

ShadowMaps ShadowScene::Region(const glm::dvec3& to_sun, const Box& focus,
                               const ShadowMapOptions& options) const {
  auto maps = ShadowMaps::Create(options);
  EXPECT_TRUE(maps.has_value()) << maps.error().Message();
  const auto drawn = maps->UpdateForRegion(Casters(), AsDirection(to_sun), focus);
  EXPECT_TRUE(drawn.has_value()) << drawn.error().Message();
  return std::move(*maps);
}

void ShadowScene::AddMesh(const std::vector<glm::vec3>& positions,
                          const std::vector<unsigned>& indices) {
  Mesh& mesh = meshes_.emplace_back();
  mesh.positions = *gl::GlBuffer::FromSpan(std::span<const glm::vec3>(positions));
  mesh.indices = *gl::GlBuffer::FromSpan(std::span<const unsigned>(indices));
  mesh.vertices = gl::GlVertexArray::Create();
  mesh.vertices.SetFloatAttribute(0, 3, mesh.positions, sizeof(glm::vec3));
  mesh.vertices.SetElementBuffer(mesh.indices);
  mesh.caster.vertices = &mesh.vertices;
  mesh.caster.index_count = static_cast<int>(indices.size());
  for (const glm::vec3& p : positions) mesh.caster.bounds.Include(glm::dvec3(p));
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a(positions[indices[i]]);
    triangles_.push_back(
        {a, glm::dvec3(positions[indices[i + 1]]) - a, glm::dvec3(positions[indices[i + 2]]) - a});
  }
}

void ShadowScene::AddBox(const glm::dvec3& low, const glm::dvec3& high) {
  std::vector<glm::vec3> positions;
  for (int i = 0; i < 8; ++i) {
    positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                           (i & 4) != 0 ? high.z : low.z);
  }
  AddMesh(positions, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
}

void ShadowScene::AddQuad(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b) {
  AddMesh(
      {glm::vec3(corner), glm::vec3(corner + a), glm::vec3(corner + a + b), glm::vec3(corner + b)},
      {0, 1, 2, 0, 2, 3});
}

std::vector<ShadowCaster> ShadowScene::Casters() const {
  std::vector<ShadowCaster> casters;
  for (const Mesh& mesh : meshes_) casters.push_back(mesh.caster);
  return casters;
}

Box ShadowScene::Bounds() const {
  Box bounds;
  for (const Mesh& mesh : meshes_) bounds.Include(mesh.caster.bounds);
  return bounds;
}

std::vector<float> ShadowScene::Visibility(const ShadowMaps& maps, const ProbePlane& plane) {
  maps.Bind(0);
  return Probe(ShadowMaps::ShaderDefines(maps.options(), 1), plane);
}

std::vector<float> ShadowScene::Visibility(const FadingShadowMaps& maps, const ProbePlane& plane) {
  maps.Bind(0);
  return Probe(FadingShadowMaps::ShaderDefines(maps.options(), 1, maps.Fades()), plane);
}

std::vector<float> ShadowScene::Probe(const std::vector<std::string>& defines,
                                      const ProbePlane& plane) {
  gl::ShaderLibrary::Register(kProbe);
  const auto program = gl::GlProgram::Create({.vertex = "shadows/shaders/shadow_fullscreen.vert",
                                              .fragment = "shadow_test/probe.frag",
                                              .defines = defines});
  EXPECT_TRUE(program.has_value()) << program.error().Message();
  auto picture = gl::GlTexture::Create2D(GL_R32F, plane.width, plane.height);
  auto target = gl::GlFramebuffer::Create({.colors = {{.texture = &*picture}}});
  EXPECT_TRUE(target.has_value());
  target->Bind();
  glDisable(GL_DEPTH_TEST);
  program->Use();
  program->Set("origin", glm::vec3(plane.origin));
  program->Set("du", glm::vec3(plane.du));
  program->Set("dv", glm::vec3(plane.dv));
  program->Set("normal", glm::vec3(plane.normal));
  const gl::GlVertexArray none = gl::GlVertexArray::Create();
  none.Bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> values(static_cast<std::size_t>(plane.width) * plane.height);
  target->ReadPixels(0, GL_RED, GL_FLOAT, values.data());
  return values;
}

std::vector<float> ShadowScene::Truth(const ProbePlane& plane, const glm::dvec3& to_sun,
                                      int rays) const {
  const LightAxes axes = LightAxes::FromSun(to_sun);
  const double tangent = std::tan(kSunAngularRadius.value());
  std::vector<float> truth;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const glm::dvec3 origin = plane.At(x, y) + plane.normal * 1e-6;
      int free = 0;
      for (int i = 0; i < rays; ++i) {
        const double radius = tangent * std::sqrt((i + 0.5) / rays);
        const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const glm::dvec3 d =
            axes.to_sun + axes.u * (radius * std::cos(angle)) + axes.v * (radius * std::sin(angle));
        bool blocked = false;
        for (const Triangle& t : triangles_) {
          // Möller & Trumbore 1997.
          const glm::dvec3 p = glm::cross(d, t.ac);
          const double determinant = glm::dot(t.ab, p);
          if (std::abs(determinant) < 1e-14) continue;
          const glm::dvec3 s = origin - t.a;
          const double u = glm::dot(s, p) / determinant;
          if (u < 0.0 || u > 1.0) continue;
          const glm::dvec3 q = glm::cross(s, t.ab);
          const double v = glm::dot(d, q) / determinant;
          if (v < 0.0 || u + v > 1.0) continue;
          if (glm::dot(t.ac, q) / determinant > 1e-7) {
            blocked = true;
            break;
          }
        }
        free += blocked ? 0 : 1;
      }
      truth.push_back(static_cast<float>(free) / static_cast<float>(rays));
    }
  }
  return truth;
}

glm::dvec3 SunAt(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kRadiansPerDegree;
  const double e = elevation_deg * kRadiansPerDegree;
  return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

Direction<Marker> AsDirection(const glm::dvec3& v) { return {{v.x, v.y, v.z}}; }

Errors Compare(const std::vector<float>& result, const std::vector<float>& truth) {
  Errors errors;
  int dark = 0, lit = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double difference = result[i] - truth[i];
    errors.rmse += difference * difference;
    errors.bias += difference;
    if (truth[i] < 0.001F) {
      errors.leak += result[i];
      ++dark;
    } else if (truth[i] > 0.999F) {
      errors.darkening += 1.0 - result[i];
      ++lit;
    }
    if (truth[i] > 0.01F && truth[i] < 0.99F) {
      errors.penumbra_rmse += difference * difference;
      ++errors.penumbra_points;
    }
  }
  const auto count = static_cast<double>(truth.size());
  errors.rmse = std::sqrt(errors.rmse / count);
  errors.bias /= count;
  if (dark > 0) errors.leak /= dark;
  if (lit > 0) errors.darkening /= lit;
  if (errors.penumbra_points > 0) {
    errors.penumbra_rmse = std::sqrt(errors.penumbra_rmse / errors.penumbra_points);
  }
  return errors;
}

}  // namespace pleinair::shadows
