#pragma once

#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "compositor/models/model.h"
#include "compositor/models/obj_parser.h"

namespace pleinair::compositor {

/// Adds the materials of an MTL text to the model. Kd becomes linear albedo and map_Kd the texture.
/// Ks and Ns become specular coat and roughness if illum has highlights. Pr and Pm (the physically
/// based extension) with map_Pr and map_Pm become roughness and metallic. Pc, Pcr and Ps become
/// clear coat and sheen. A norm or bump becomes a normal map. Ke and map_Ke become emission in
/// cd/m². A texture replaces a Kd of zero or white by white; any other Kd multiplies it. A d (or
/// 1 − Tr) between 0 and 1 is the hidden fraction of the background.
///
/// Other statements are ignored; Material::unsupported_features reports those with a visible
/// effect. Errors name the file and line.
Result<void> ParseMtl(std::string_view text, const std::filesystem::path& file,
                      const ObjCompanions& companions, Model* model);

}  // namespace pleinair::compositor
