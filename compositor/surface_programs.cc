#include "compositor/surface_programs.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "compositor/scene_shadows.h"
#include "shadows/fading_shadow_maps.h"

namespace pleinair::compositor {

Result<SurfacePrograms> SurfacePrograms::Create(const shadows::ShadowMapOptions& options,
                                                bool fades, bool hazy) {
  const auto make = [&](const std::string& fragment, const char* change) {
    std::vector<std::string> defines =
        shadows::FadingShadowMaps::ShaderDefines(options, SceneShadows::kSets, fades);
    if (change != nullptr) {
      defines.emplace_back(change);
      if (hazy) defines.emplace_back("HAZE");
    }
    return gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                                  .fragment = fragment,
                                  .defines = std::move(defines)});
  };
  SurfacePrograms programs;
  constexpr std::array<const char*, ChangingTriangles::kNothing> kChangeDefines{
      "SUN_MAY_CHANGE", "SKY_CHANGES", "NO_SUN"};
  for (std::size_t change = 0; change < kChangeDefines.size(); ++change) {
    PLEINAIR_ASSIGN_OR_RETURN(
        programs.phantoms[change],
        make("compositor/shaders/phantom_ratio.frag", kChangeDefines[change]));
  }
  PLEINAIR_ASSIGN_OR_RETURN(programs.objects,
                            make("compositor/shaders/virtual_object.frag", nullptr));
  return programs;
}

}  // namespace pleinair::compositor
