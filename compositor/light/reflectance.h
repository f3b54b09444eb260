#pragma once

#include <array>

#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Diffuse reflectance of a material for indirect illumination: linear Rec.709, textures as their
/// mean. A metal reflects as much light as a matt surface of its color, though in other directions.
/// Without this light, a polished object would blacken the ground below it.
std::array<float, 3> ReflectanceOf(const Model& model, int material_index);

/// Mean color of a surface by its vertices, linear Rec.709, weighted by the area of their
/// triangles; white without colors.
std::array<float, 3> MeanVertexColor(const SurfaceMesh& surface);

/// Transmittance of a virtual object's open surface beside the reflectance `albedo`; black of
/// phantoms and of what passes no light.
std::array<float, 3> TransmittanceOf(const PlacedModel& placed, int material_index,
                                     const std::array<float, 3>& albedo);

}  // namespace pleinair::compositor
