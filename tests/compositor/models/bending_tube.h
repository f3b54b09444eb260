#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace pleinair::compositor::testing {

/// Files of a glTF model that bends: a closed tube on y = 0, 60 cm tall and 12 cm in radius,
/// skinned by two joints. Its animation "Bend" turns the upper joint by 60° to +x within 2 s.
struct BendingTube {
  std::string gltf;    ///< Refers to tube.bin.
  std::string buffer;  ///< tube.bin.
};

/// About rings × around vertices.
inline BendingTube MakeBendingTube(std::uint32_t rings, std::uint32_t around) {
  std::vector<float> positions, normals, weights;
  std::vector<std::uint8_t> joints;
  std::vector<std::uint32_t> indices;
  const auto add = [&](float radius, float height, float turn, float nx, float ny, float nz) {
    const float share = std::fmin(1.0F, std::fmax(0.0F, (height - 0.2F) / 0.2F));
    const float upper = share * share * (3.0F - 2.0F * share);
    positions.insert(positions.end(), {radius * std::cos(turn), height, radius * std::sin(turn)});
    normals.insert(normals.end(), {nx, ny, nz});
    weights.insert(weights.end(), {1.0F - upper, upper, 0.0F, 0.0F});
    joints.insert(joints.end(), {0, 1, 0, 0});
    return static_cast<std::uint32_t>(positions.size() / 3 - 1);
  };
  const auto turn_of = [&](std::uint32_t k) {
    return 2.0F * std::numbers::pi_v<float> * static_cast<float>(k % around) /
           static_cast<float>(around);
  };
  for (std::uint32_t r = 0; r < rings; ++r) {
    const float height = 0.6F * static_cast<float>(r) / static_cast<float>(rings - 1);
    for (std::uint32_t k = 0; k < around; ++k) {
      add(0.12F, height, turn_of(k), std::cos(turn_of(k)), 0.0F, std::sin(turn_of(k)));
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = r * around + k, b = r * around + (k + 1) % around;
      indices.insert(indices.end(), {a, a + around, b, b, a + around, b + around});
    }
  }
  for (const bool top : {false, true}) {
    const float height = top ? 0.6F : 0.0F, up = top ? 1.0F : -1.0F;
    const std::uint32_t centre = add(0.0F, height, 0.0F, 0.0F, up, 0.0F);
    for (std::uint32_t k = 0; k < around; ++k) add(0.12F, height, turn_of(k), 0.0F, up, 0.0F);
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = centre + 1 + k, b = centre + 1 + (k + 1) % around;
      indices.insert(indices.end(), {centre, top ? b : a, top ? a : b});
    }
  }
  BendingTube tube;
  std::string views, accessors;
  const auto view = [&](const auto& values, int component, const char* type, std::size_t count,
                        const char* extra = "") {
    const std::size_t bytes = values.size() * sizeof(values[0]);
    views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
             std::to_string(tube.buffer.size()) + R"(,"byteLength":)" + std::to_string(bytes) + "}";
    accessors += (accessors.empty() ? "" : ",") + std::string(R"({"bufferView":)");
    accessors += std::to_string(std::ranges::count(views, '{') - 1);
    accessors += R"(,"componentType":)" + std::to_string(component) + R"(,"count":)" +
                 std::to_string(count) + R"(,"type":")" + type + "\"" + extra + "}";
    tube.buffer.append(reinterpret_cast<const char*>(values.data()), bytes);
    tube.buffer.resize((tube.buffer.size() + 3) / 4 * 4);
  };
  const std::size_t vertices = positions.size() / 3;
  view(positions, 5126, "VEC3", vertices);
  view(normals, 5126, "VEC3", vertices);
  view(weights, 5126, "VEC4", vertices);
  view(joints, 5121, "VEC4", vertices);
  view(indices, 5125, "SCALAR", indices.size());
  view(std::vector<float>{0.0F, 2.0F}, 5126, "SCALAR", 2, R"(,"min":[0],"max":[2])");
  view(std::vector<float>{0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, -0.5F, 0.8660254F}, 5126, "VEC4", 2);
  // The inverse bind matrix of the upper joint lowers by 30 cm.
  view(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,     0, 1,
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.3F, 0, 1},
       5126, "MAT4", 2);
  tube.gltf =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,)"
      R"("skin":0},{"children":[2]},{"translation":[0,0.3,0]}],"skins":[{"joints":[1,2],)"
      R"("inverseBindMatrices":7}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)"
      R"("NORMAL":1,"WEIGHTS_0":2,"JOINTS_0":3},"indices":4,"material":0}]}],"materials":[{)"
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.6,0.3,0.2,1],"metallicFactor":0}}],)"
      R"("animations":[{"name":"Bend","channels":[{"sampler":0,"target":{"node":2,"path":)"
      R"("rotation"}}],"samplers":[{"input":5,"output":6}]}],"accessors":[)" +
      accessors + R"(],"bufferViews":[)" + views +
      R"(],"buffers":[{"uri":"tube.bin","byteLength":)" + std::to_string(tube.buffer.size()) +
      "}]}";
  return tube;
}

}  // namespace pleinair::compositor::testing
