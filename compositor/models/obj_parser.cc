#include "compositor/models/obj_parser.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/srgb.h"
#include "compositor/models/mesh_triangulation.h"
#include "compositor/models/model_limits.h"
#include "compositor/models/obj_lines.h"
#include "compositor/models/obj_material.h"

namespace pleinair::compositor {
namespace {

constexpr std::int64_t kNone = -1;
// Max. length of the name of the program that wrote the file.
constexpr std::size_t kMaxNameLength = 120;

struct Corner {
  std::int64_t position = kNone, uv = kNone, normal = kNone;
};

struct VertexKey {
  std::uint32_t mesh;
  std::int64_t position, uv, normal;
  bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t h = key.mesh;
    for (const std::int64_t part : {key.position, key.uv, key.normal}) {
      h = (h ^ static_cast<std::uint64_t>(part + 1)) * 0x9E3779B97F4A7C15U;
      h ^= h >> 29;
    }
    return h;
  }
};

/// The file's vertex lists, to which its faces refer.
struct ListedVertices {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 3>> colors;  ///< Linear; shorter where the last have none.
  std::vector<std::array<float, 2>> uvs;
};

/// The model's meshes so far, built from faces.
struct BuiltMeshes {
  std::map<std::pair<std::string, int>, std::uint32_t> by_name_and_material;
  std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> vertices;
  std::vector<bool> has_uvs;  ///< One flag per mesh.
  std::size_t index_count = 0;
};

/// Name and material of the next face.
struct CurrentGroup {
  std::string name;
  int material = -1;
  std::optional<std::uint32_t> mesh;  ///< None before the first face.
};

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::filesystem::path& file,
            const ObjCompanions& companions)
      : lines_(text), file_(file), companions_(companions) {
    model_.file = file;
  }

  Result<Model> Parse() {
    while (lines_.Next()) PLEINAIR_RETURN_IF_ERROR(Statement(lines_.Word()));
    if (model_.meshes.empty()) {
      return InputError(file_.string(),
                        "has no faces: it is no model that is read, or is cut short",
                        "name an OBJ or a glTF model");
    }
    for (Mesh& mesh : model_.meshes) {
      // Drops texture coordinates that no face of the mesh uses.
      if (!built_.has_uvs[static_cast<std::size_t>(&mesh - model_.meshes.data())]) mesh.uvs.clear();
      if (!mesh.details.empty()) mesh.details.resize(mesh.positions.size());
    }
    model_.written_by = lines_.first_comment().substr(0, kMaxNameLength);
    if (has_lines_) model_.unsupported_features.insert(kPointsAndLines);
    return std::move(model_);
  }

 private:
  tl::unexpected<Error> Fail(std::string what,
                             std::string remedy = "repair the model or export it again") const {
    return InputError(file_.string() + ":" + std::to_string(lines_.line_number()), std::move(what),
                      std::move(remedy));
  }

  Result<void> Statement(std::string_view keyword) {
    if (keyword == "v") {
      return Position();
    }
    if (keyword == "vn") return Vector<3>(&listed_.normals, 3);
    if (keyword == "vt") return Vector<2>(&listed_.uvs, 1);
    if (keyword == "f") return Face();
    has_lines_ |= keyword == "l" || keyword == "p";
    if (keyword == "o" || keyword == "g") {
      current_.name = std::string(lines_.Rest());
      current_.mesh.reset();
    } else if (keyword == "usemtl") {
      UseMaterial(std::string(lines_.Rest()));
    } else if (keyword == "mtllib") {
      return ReadLibraries();
    }
    return {};
  }

  /// Reads a vertex relative to the model's origin, which is the first vertex if that is far away.
  Result<void> Position() {
    std::array<double, 3> values{};
    for (double& value : values) {
      const std::string_view word = lines_.Word();
      if (word.empty()) return Fail("a vertex has too few numbers");
      const std::optional<double> number = ParseObjDouble(word, kMaxCoordinate);
      if (!number) return Fail(Quoted(word) + " is not a finite number below 1e10");
      value = *number;
    }
    if (listed_.positions.size() >= kMaxVertices) return Fail("has more than 20 million vertices");
    Vec3& origin = model_.origin_m;
    const auto is_far = [](double value) { return std::fabs(value) > kMinFarCoordinate; };
    if (listed_.positions.empty() && std::ranges::any_of(values, is_far)) {
      origin = {values[0], values[1], values[2]};
    }
    const std::array<double, 3> relative{values[0] - origin.x, values[1] - origin.y,
                                         values[2] - origin.z};
    if (std::ranges::any_of(relative, [](double value) { return std::fabs(value) > kMaxExtent; })) {
      return Fail("a vertex is more than 1e8 from the model's origin");
    }
    listed_.positions.push_back({static_cast<float>(relative[0]), static_cast<float>(relative[1]),
                                 static_cast<float>(relative[2])});
    return VertexColor();
  }

  /// Reads the color after a position, sRGB from 0 to 1. A single number there is a weight.
  Result<void> VertexColor() {
    if (lines_.Rest().empty()) return {};
    const std::array<std::string_view, 3> words{lines_.Word(), lines_.Word(), lines_.Word()};
    if (words[2].empty()) return {};
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::optional<float> value = ParseObjNumber(words[c]);
      if (!value) return Fail(Quoted(words[c]) + " is not the color of a vertex");
      color[c] = static_cast<float>(LinearFromSrgb(std::clamp(*value, 0.0F, 1.0F)));
    }
    listed_.colors.resize(listed_.positions.size(), {1.0F, 1.0F, 1.0F});
    listed_.colors.back() = color;
    return {};
  }

  /// Reads `N` numbers, of which the first `needed` are mandatory. The rest of the line is ignored.
  template <std::size_t N>
  Result<void> Vector(std::vector<std::array<float, N>>* list, std::size_t needed) {
    std::array<float, N> values{};
    for (std::size_t i = 0; i < N; ++i) {
      if (i >= needed && lines_.Rest().empty()) break;
      const std::string_view word = lines_.Word();
      if (word.empty()) return Fail("a vertex has too few numbers");
      const std::optional<float> value = ParseObjNumber(word);
      if (!value) {
        return Fail(Quoted(word) + " is not a finite number below 1e8");
      }
      values[i] = *value;
    }
    if (list->size() >= kMaxVertices) return Fail("has more than 20 million vertices");
    list->push_back(values);
    return {};
  }

  /// Converts an index as written (from 1, or negative from the end) to one from 0.
  Result<std::int64_t> Index(std::string_view word, std::size_t count, const char* what) const {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size()) {
      return Fail(Quoted(word) + " is not the number of a " + what);
    }
    const auto size = static_cast<std::int64_t>(count);
    const std::int64_t from_zero = index < 0 ? size + index : index - 1;
    if (index == 0 || from_zero < 0 || from_zero >= size) {
      return Fail("face refers to " + std::string(what) + " " + std::to_string(index) + " of " +
                  std::to_string(count));
    }
    return from_zero;
  }

  Result<Corner> ParseCorner(std::string_view word) const {
    std::array<std::string_view, 3> parts;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t slash = word.find('/');
      parts[i] = word.substr(0, slash);
      if (slash == std::string_view::npos) {
        word = {};
        break;
      }
      word.remove_prefix(slash + 1);
      if (i == 2) return Fail("a face's corner has more than three numbers");
    }
    Corner corner;
    PLEINAIR_ASSIGN_OR_RETURN(corner.position, Index(parts[0], listed_.positions.size(), "vertex"));
    if (!parts[1].empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(corner.uv,
                                Index(parts[1], listed_.uvs.size(), "texture coordinate"));
    }
    if (!parts[2].empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(corner.normal, Index(parts[2], listed_.normals.size(), "normal"));
    }
    return corner;
  }

  Result<void> Face() {
    std::vector<Corner> corners;
    std::vector<Vec3> points;
    while (!lines_.Rest().empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(const Corner corner, ParseCorner(lines_.Word()));
      corners.push_back(corner);
      const auto& p = listed_.positions[static_cast<std::size_t>(corner.position)];
      points.push_back({p[0], p[1], p[2]});
    }
    if (corners.size() < 3) return Fail("a face has fewer than three corners");
    const std::vector<std::uint32_t> triangles = TriangulatePolygon(points);
    if (triangles.empty()) return Fail("a concave face has more than 2000 corners");
    const std::uint32_t mesh_index = CurrentMesh();
    std::vector<std::uint32_t> vertices;
    for (const Corner& corner : corners) {
      if (built_.vertices.size() >= kMaxVertices) return Fail("has more than 20 million vertices");
      vertices.push_back(Vertex(mesh_index, corner));
    }
    Mesh& mesh = model_.meshes[mesh_index];
    if (built_.index_count + triangles.size() > 3 * kMaxTriangles) {
      return Fail("has more than 40 million triangles");
    }
    built_.index_count += triangles.size();
    for (const std::uint32_t corner : triangles) mesh.indices.push_back(vertices[corner]);
    return {};
  }

  std::uint32_t Vertex(std::uint32_t mesh_index, const Corner& corner) {
    Mesh& mesh = model_.meshes[mesh_index];
    const VertexKey key{mesh_index, corner.position, corner.uv, corner.normal};
    const auto [found, is_new] =
        built_.vertices.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
    if (!is_new) return found->second;
    mesh.positions.push_back(listed_.positions[static_cast<std::size_t>(corner.position)]);
    mesh.normals.push_back(corner.normal == kNone
                               ? std::array<float, 3>{}
                               : listed_.normals[static_cast<std::size_t>(corner.normal)]);
    std::array<float, 2> uv{};
    if (corner.uv != kNone) {
      uv = listed_.uvs[static_cast<std::size_t>(corner.uv)];
      uv[1] = 1.0F - uv[1];  // OBJ's v starts at the image's bottom.
      built_.has_uvs[mesh_index] = true;
    }
    mesh.uvs.push_back(uv);
    if (const auto position = static_cast<std::size_t>(corner.position);
        position < listed_.colors.size()) {
      const auto& [r, g, b] = listed_.colors[position];
      mesh.details.resize(mesh.positions.size());
      mesh.details.back().color = {r, g, b, 1.0F};
    }
    return found->second;
  }

  /// The mesh for the current name and material.
  std::uint32_t CurrentMesh() {
    if (current_.mesh) return *current_.mesh;
    if (current_.material < 0) UseMaterial("");
    const auto [found, is_new] = built_.by_name_and_material.try_emplace(
        {current_.name, current_.material}, static_cast<std::uint32_t>(model_.meshes.size()));
    if (is_new) {
      Mesh mesh;
      mesh.name = current_.name;
      mesh.material = current_.material;
      model_.meshes.push_back(std::move(mesh));
      built_.has_uvs.push_back(false);
    }
    current_.mesh = found->second;
    return found->second;
  }

  /// An undefined name gets the default material, as in viewers.
  void UseMaterial(const std::string& name) {
    const auto [found, is_new] =
        materials_.try_emplace(name, static_cast<int>(model_.materials.size()));
    if (is_new) {
      Material material;
      material.name = name;
      model_.materials.push_back(std::move(material));
    }
    current_.material = found->second;
    current_.mesh.reset();
  }

  Result<void> ReadLibraries() {
    // Several names may follow, but a single one may contain blanks: try the whole first.
    std::string name(lines_.Rest());
    if (name.empty()) return Fail("mtllib names no file");
    if (++libraries_ > 100) return Fail("names more than 100 material libraries");
    auto text = companions_.read_text(file_.parent_path() / name);
    if (!text && name.find(' ') != std::string::npos) {
      while (!lines_.Rest().empty()) PLEINAIR_RETURN_IF_ERROR(ReadLibrary(lines_.Word()));
      return {};
    }
    return ReadLibrary(name);
  }

  Result<void> ReadLibrary(std::string_view name) {
    const std::filesystem::path path = file_.parent_path() / name;
    auto text = companions_.read_text(path);
    if (!text) {
      // The reader's own remedy is for the model.
      Error unread = text.error();
      unread.remedy.clear();
      return Fail("material library " + unread.Message(),
                  "put it beside the model, remove the mtllib line, or trust the model with "
                  "--allow-outside");
    }
    const std::size_t first = model_.materials.size();
    PLEINAIR_RETURN_IF_ERROR(ParseMtl(*text, path, companions_, &model_));
    for (std::size_t i = first; i < model_.materials.size(); ++i) {
      materials_[model_.materials[i].name] = static_cast<int>(i);
    }
    return {};
  }

  ObjLines lines_;
  const std::filesystem::path& file_;
  const ObjCompanions& companions_;
  Model model_;
  bool has_lines_ = false;
  ListedVertices listed_;
  BuiltMeshes built_;
  std::map<std::string, int> materials_;
  CurrentGroup current_;
  int libraries_ = 0;
};

}  // namespace

Result<Model> ParseObj(std::string_view text, const std::filesystem::path& file,
                       const ObjCompanions& companions) {
  return ObjParser(text, file, companions).Parse();
}

}  // namespace pleinair::compositor
