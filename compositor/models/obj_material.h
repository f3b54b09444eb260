#pragma once

#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "compositor/models/model.h"
#include "compositor/models/obj_parser.h"

namespace pleinair::compositor {

/// Adds the materials of an MTL text to the model: Kd as linear albedo, Ks and Ns as specular
/// coat and roughness where illum asks for highlights, Pr and Pm (the physically based extension)
/// as roughness and metallic, map_Kd as texture. A texture replaces a Kd of zero or white by
/// white and is multiplied by any other. A d (or 1 − Tr) between 0 and 1 is how much of what lies
/// behind is hidden. The rest is passed over; Material::unsupported_features says what of it would
/// show. Errors: name the file and line.
Result<void> ParseMtl(std::string_view text, const std::filesystem::path& file,
                      const ObjCompanions& companions, Model* model);

}  // namespace pleinair::compositor
