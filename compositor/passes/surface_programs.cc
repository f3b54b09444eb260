#include "compositor/passes/surface_programs.h"

#include <string>
#include <utility>
#include <vector>

#include "compositor/passes/scene_shadows.h"
#include "shadows/fading_shadow_maps.h"

namespace pleinair::compositor {

namespace {

using shadows::SunDiscFilter;

/// Filter where only the sky's light changes, by some hundredths. A real shadow's edge affects only
/// that change. One sample of the map is therefore as good as many (0.01 of CIEDE2000 over key
/// frames).
SunDiscFilter FilterForSky(SunDiscFilter filter) {
  return filter == SunDiscFilter::kFull ? SunDiscFilter::kSample : filter;
}

}  // namespace

Result<SurfacePrograms> SurfacePrograms::Create(const shadows::ShadowMapOptions& options,
                                                const Permutation& permutation) {
  const auto make = [&](const std::string& fragment, const std::vector<std::string>& of_pass,
                        SunDiscFilter filter) {
    shadows::ShadowMapOptions shading = options;
    shading.sun_disc_filter = filter;
    std::vector<std::string> defines =
        shadows::FadingShadowMaps::ShaderDefines(shading, SceneShadows::kSets, permutation.fades);
    defines.insert(defines.end(), of_pass.begin(), of_pass.end());
    if (permutation.needs_airlight) defines.emplace_back("AIRLIGHT");
    if (permutation.textured) defines.emplace_back("TEXTURED");
    if (permutation.blended) defines.emplace_back("BLENDED");
    if (permutation.detailed) defines.emplace_back("DETAILED");
    if (permutation.translucent) defines.emplace_back("TRANSLUCENT");
    if (permutation.glossy) defines.emplace_back("GLOSSY");
    return gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                                  .fragment = "compositor/shaders/" + fragment,
                                  .defines = std::move(defines)});
  };
  const SunDiscFilter filter = options.sun_disc_filter;
  SurfacePrograms programs;
  PLEINAIR_ASSIGN_OR_RETURN(programs.phantoms[AffectedTriangles::kSun],
                            make("shadow_ratio.frag", {"SUN_MAY_CHANGE"}, filter));
  PLEINAIR_ASSIGN_OR_RETURN(programs.phantoms[AffectedTriangles::kSunlitSky],
                            make("shadow_ratio.frag", {"SKY_CHANGES"}, FilterForSky(filter)));
  PLEINAIR_ASSIGN_OR_RETURN(programs.objects, make("virtual_object.frag", {}, filter));
  PLEINAIR_ASSIGN_OR_RETURN(programs.objects_in_own_shade,
                            make("virtual_object.frag", {"NO_SUN"}, filter));
  return programs;
}

}  // namespace pleinair::compositor
