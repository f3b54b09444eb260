#include "shadows/bench/example_models.h"

#include <array>
#include <cstdio>

#include "shadows/bench/mesh_shapes.h"

namespace pleinair::shadows {
namespace {

// The body is 1.3 m high in the bench's scene.
constexpr float kBodyScale = 0.3F;

class ObjText {
 public:
  void Begin(const std::string& name) { text_ += "o " + name + "\nusemtl " + name + "\n"; }

  void Add(const BenchMesh& mesh, float scale) {
    std::array<char, 80> line{};
    for (const glm::vec3& p : mesh.positions) {
      std::snprintf(line.data(), line.size(), "v %.4f %.4f %.4f\n", scale * p.x, scale * p.y,
                    scale * p.z);
      text_ += line.data();
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      text_ += "f";
      for (std::size_t corner = 0; corner < 3; ++corner) {
        text_ += " " + std::to_string(vertices_ + mesh.indices[i + corner] + 1);
      }
      text_ += "\n";
    }
    vertices_ += mesh.positions.size();
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_ =
      "# Written by tools/tree_and_body for docs/measurements/shadows.md.\nmtllib models.mtl\n";
  std::size_t vertices_ = 0;
};

}  // namespace

std::vector<ExampleModel> TreeAndBody() {
  const TreeShape shape{.height = 1.13, .crown = 0.29, .leaves = 260, .leaf_m = 0.062, .seed = 5};
  ObjText tree;
  tree.Begin("wood");
  tree.Add(Trunk(shape, {}), 1.0F);
  tree.Begin("leaf");
  tree.Add(Leaves(shape, {}), 1.0F);
  ObjText body;
  body.Begin("body");
  for (const BenchMesh& part : Body({}, {})) body.Add(part, kBodyScale);
  return {{"tree.obj", tree.text()}, {"body.obj", body.text()}};
}

}  // namespace pleinair::shadows
