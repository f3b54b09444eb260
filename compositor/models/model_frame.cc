#include "compositor/models/model_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "compositor/models/model.h"

namespace pleinair::compositor {
namespace {

// Share of the model's largest side. An end or a centre that is this near to zero counts as zero.
constexpr double kNearZero = 0.01;
// Share of the side along an axis. Halves whose lengths differ by more are unequal.
constexpr double kUnequal = 0.05;

void Include(const std::array<float, 3>& p, ModelBounds* box) {
  box->min_m = {std::min<double>(box->min_m.x, p[0]), std::min<double>(box->min_m.y, p[1]),
                std::min<double>(box->min_m.z, p[2])};
  box->max_m = {std::max<double>(box->max_m.x, p[0]), std::max<double>(box->max_m.y, p[1]),
                std::max<double>(box->max_m.z, p[2])};
}

/// The rotation from the coordinates of the reader, which are z-up for glTF.
Mat3 PlacedFromRead(const ModelFrame& frame, Model::Format format) {
  if (format == Model::Format::kObj) {
    return RotationBetween(frame.file_up.value_or(frame.placed_up), frame.placed_up);
  }
  return RotationBetween(frame.file_up.value_or(UpAxis::kY), frame.placed_up) *
         RotationBetween(UpAxis::kZ, UpAxis::kY);
}

std::array<float, 3> Narrowed(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

ModelBounds BoundsOf(const Model& model) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  ModelBounds box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Mesh& mesh : model.meshes) {
    for (const std::uint32_t index : mesh.indices) Include(mesh.positions[index], &box);
  }
  if (box.min_m.x > box.max_m.x) box = {};
  return {box.min_m + model.origin_m, box.max_m + model.origin_m};
}

FrameMap ApplyFrame(const ModelFrame& frame, Model* model) {
  const Mat3 turn = PlacedFromRead(frame, model->format);
  const auto place = [&](Vec3 v) { return turn * (v * frame.unit_m); };
  if (turn != Mat3{} || frame.unit_m != 1.0) {
    model->origin_m = place(model->origin_m);
    for (Mesh& mesh : model->meshes) {
      for (auto& p : mesh.positions) p = Narrowed(place({p[0], p[1], p[2]}));
      for (auto& n : mesh.normals) n = Narrowed(turn * Vec3{n[0], n[1], n[2]});
    }
  }
  FrameMap map;
  for (std::size_t i = 0; i < 9; ++i) map.linear.m[i] = turn.m[i] * frame.unit_m;
  if (!frame.bottom_centre) return map;
  model->origin_m = {};
  const ModelBounds box = BoundsOf(*model);
  Vec3 origin = box.Centre();
  (frame.placed_up == UpAxis::kY ? origin.y : origin.z) =
      frame.placed_up == UpAxis::kY ? box.min_m.y : box.min_m.z;
  for (Mesh& mesh : model->meshes) {
    for (auto& p : mesh.positions) p = Narrowed(Vec3{p[0], p[1], p[2]} - origin);
  }
  map.translation_m = -origin;
  return map;
}

bool LooksYUp(const Model& model) {
  if (model.format != Model::Format::kObj) return false;
  const ModelBounds box = BoundsOf(model);
  const Vec3 size = box.Size();
  const double near = kNearZero * std::max({size.x, size.y, size.z});
  const bool stands_on_y = std::abs(box.min_m.y) <= near && box.max_m.y > near;
  const bool stands_on_z = std::abs(box.min_m.z) <= near;
  const bool centred_on_z = std::abs(box.min_m.z + box.max_m.z) <= near;
  const bool y_has_halves = std::abs(box.min_m.y + box.max_m.y) <= kUnequal * size.y;
  const bool from_blender = model.written_by.find("Blender") != std::string::npos;
  if (stands_on_z) return false;
  return (stands_on_y && centred_on_z) || (centred_on_z && !y_has_halves) || from_blender;
}

}  // namespace pleinair::compositor
