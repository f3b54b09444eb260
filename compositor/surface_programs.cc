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
                                                bool fades, bool hazy, bool textured) {
  const auto make = [&](const std::string& fragment, const std::vector<std::string>& permutation,
                        shadows::ShadowMethod method) {
    shadows::ShadowMapOptions shading = options;
    shading.method = method;
    std::vector<std::string> defines =
        shadows::FadingShadowMaps::ShaderDefines(shading, SceneShadows::kSets, fades);
    defines.insert(defines.end(), permutation.begin(), permutation.end());
    if (hazy) defines.emplace_back("HAZE");
    if (textured) defines.emplace_back("TEXTURED");
    return gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                                  .fragment = "compositor/shaders/" + fragment,
                                  .defines = std::move(defines)});
  };
  SurfacePrograms programs;
  constexpr std::array<const char*, ChangingTriangles::kNothing> kChangeDefines{
      "SUN_MAY_CHANGE", "SKY_CHANGES", "OPEN_SKY_CHANGES", "NO_SUN"};
  for (std::size_t change = 0; change < kChangeDefines.size(); ++change) {
    PLEINAIR_ASSIGN_OR_RETURN(
        programs.phantoms[change],
        make("phantom_ratio.frag", {kChangeDefines[change]},
             change == ChangingTriangles::kSunlitSky ? MethodForSky(options.method)
                                                     : options.method));
  }
  PLEINAIR_ASSIGN_OR_RETURN(programs.objects, make("virtual_object.frag", {}, options.method));
  PLEINAIR_ASSIGN_OR_RETURN(programs.objects_in_own_shade,
                            make("virtual_object.frag", {"NO_SUN"}, options.method));
  return programs;
}

}  // namespace pleinair::compositor
