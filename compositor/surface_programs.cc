#include "compositor/surface_programs.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "compositor/scene_shadows.h"
#include "shadows/fading_shadow_maps.h"

namespace pleinair::compositor {

namespace {

/// Where only the sky's light changes, by some hundredths, a real shadow's edge matters to so much
/// of it: one look into the map is as good there as many (0.01 of CIEDE2000 over key frames).
shadows::ShadowMethod MethodForSky(shadows::ShadowMethod method) {
  return method == shadows::ShadowMethod::kSunDisc ? shadows::ShadowMethod::kSunDiscLean : method;
}

}  // namespace

Result<SurfacePrograms> SurfacePrograms::Create(const shadows::ShadowMapOptions& options,
                                                bool fades, bool hazy) {
  const auto make = [&](const std::string& vertex, const std::string& fragment, const char* change,
                        shadows::ShadowMethod method) {
    shadows::ShadowMapOptions shading = options;
    shading.method = method;
    std::vector<std::string> defines =
        shadows::FadingShadowMaps::ShaderDefines(shading, SceneShadows::kSets, fades);
    if (change != nullptr) defines.emplace_back(change);
    if (hazy) defines.emplace_back("HAZE");
    return gl::GlProgram::Create({.vertex = "compositor/shaders/" + vertex,
                                  .fragment = "compositor/shaders/" + fragment,
                                  .defines = std::move(defines)});
  };
  SurfacePrograms programs;
  constexpr std::array<const char*, ChangingTriangles::kNothing> kChangeDefines{
      "SUN_MAY_CHANGE", "SKY_CHANGES", "NO_SUN"};
  for (std::size_t change = 0; change < kChangeDefines.size(); ++change) {
    PLEINAIR_ASSIGN_OR_RETURN(
        programs.phantoms[change],
        make("screen_triangle.vert", "phantom_ratio.frag", kChangeDefines[change],
             change == ChangingTriangles::kSunlitSky ? MethodForSky(options.method)
                                                     : options.method));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      programs.objects, make("scene_surface.vert", "virtual_object.frag", nullptr, options.method));
  PLEINAIR_ASSIGN_OR_RETURN(
      programs.objects_in_own_shade,
      make("scene_surface.vert", "virtual_object.frag", "NO_SUN", options.method));
  return programs;
}

}  // namespace pleinair::compositor
