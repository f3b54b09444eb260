#include "compositor/models/alpha_cutout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace pleinair::compositor {
namespace {

// Glass affects light and shadows if it hides at least this fraction of the background.
constexpr float kDenseGlass = 0.5F;
constexpr int kMaxHalvings = 6;
constexpr double kMinFilterWidth_texels = 2.0;
// Beyond this many repetitions of a texture, rounding loses the texels.
constexpr double kMaxRepetitions = 4096.0;
// Max. cells per axis that a query of a triangle's bounding box reads; it selects the level.
constexpr int kMaxCells = 4;

/// Min. and max. alpha in the cells of a texture. Each level's cells are twice as wide as the
/// last's.
class AlphaLevels {
 public:
  explicit AlphaLevels(const Image<std::uint8_t>& texture)
      : width_(texture.width()), height_(texture.height()) {
    Level level(width_, height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        level.Include(x, y, {texture(x, y, 3), texture(x, y, 3)});
      }
    }
    levels_.push_back(std::move(level));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
      const Level& fine = levels_.back();
      Level coarse((fine.width + 1) / 2, (fine.height + 1) / 2);
      for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) coarse.Include(x / 2, y / 2, fine.At(x, y));
      }
      levels_.push_back(std::move(coarse));
    }
  }

  struct Range {
    std::uint8_t minimum = 255, maximum = 0;
    void Include(Range other) {
      minimum = std::min(minimum, other.minimum);
      maximum = std::max(maximum, other.maximum);
    }
  };

  int width() const { return width_; }
  int height() const { return height_; }
  /// Range of the whole texture.
  Range Whole() const { return levels_.back().At(0, 0); }

  /// Range of a box of texels, both ends included, on the repeated texture.
  Range Of(std::array<std::int64_t, 2> low, std::array<std::int64_t, 2> high) const {
    Range range;
    for (const auto& [x0, x1] : Wrapped(low[0], high[0], width_)) {
      for (const auto& [y0, y1] : Wrapped(low[1], high[1], height_)) {
        std::size_t l = 0;
        while (std::max(x1 - x0, y1 - y0) >> l >= kMaxCells && l + 1 < levels_.size()) ++l;
        for (int y = y0 >> l; y <= y1 >> l; ++y) {
          for (int x = x0 >> l; x <= x1 >> l; ++x) range.Include(levels_[l].At(x, y));
        }
      }
    }
    return range;
  }

 private:
  struct Level {
    Level(int w, int h) : width(w), height(h), ranges(static_cast<std::size_t>(w) * h) {}
    Range At(int x, int y) const { return ranges[static_cast<std::size_t>(y) * width + x]; }
    void Include(int x, int y, Range range) {
      ranges[static_cast<std::size_t>(y) * width + x].Include(range);
    }
    int width, height;
    std::vector<Range> ranges;
  };

  /// Maps an interval on the repeated texture to intervals of the texture's own texels.
  static std::vector<std::pair<int, int>> Wrapped(std::int64_t low, std::int64_t high, int size) {
    if (high - low >= size) return {{0, size - 1}};
    const auto first = static_cast<int>((low % size + size) % size);
    const int last = first + static_cast<int>(high - low);
    if (last < size) return {{first, last}};
    return {{first, size - 1}, {0, last - size}};
  }

  int width_, height_;
  std::vector<Level> levels_;
};

/// Alpha below which a surface is absent for light and shadows.
float CutoffOf(const Material& material) {
  return material.alpha == Material::Alpha::kBlended ? kDenseGlass : material.alpha_cutoff;
}

struct Piece {
  std::array<std::uint32_t, 3> corners{};
  int halvings = 0;
  double size_texels = 0.0;
  bool operator<(const Piece& other) const { return size_texels < other.size_texels; }
};

/// Divides the triangles of one mesh.
class Cutter {
 public:
  Cutter(const Material& material, const AlphaLevels& alpha, Mesh* mesh)
      : cutoff_(255.0 * CutoffOf(material)),
        opacity_(material.opacity),
        alpha_(alpha),
        mesh_(*mesh) {}

  void Cut(std::size_t max_triangles) {
    for (std::size_t i = 0; i + 2 < mesh_.indices.size(); i += 3) {
      Sort({{mesh_.indices[i], mesh_.indices[i + 1], mesh_.indices[i + 2]}, 0, 0.0});
    }
    while (!pieces_.empty() && pieces_.size() + whole_.size() / 3 + 3 <= max_triangles) {
      const Piece piece = pieces_.top();
      pieces_.pop();
      const auto [a, b, c] = piece.corners;
      const std::uint32_t ab = Middle(a, b), bc = Middle(b, c), ca = Middle(c, a);
      const std::array<std::array<std::uint32_t, 3>, 4> parts{
          {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}};
      for (const auto& part : parts) Sort({part, piece.halvings + 1, 0.0});
    }
    for (; !pieces_.empty(); pieces_.pop()) Keep(pieces_.top());
    mesh_.indices = std::move(whole_);
  }

 private:
  void Keep(const Piece& piece) {
    whole_.insert(whole_.end(), piece.corners.begin(), piece.corners.end());
  }

  /// Keeps a piece without holes, drops one that is a hole, and queues others for division.
  void Sort(Piece piece) {
    std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
    const std::array<int, 2> size{alpha_.width(), alpha_.height()};
    for (const std::uint32_t corner : piece.corners) {
      for (int k = 0; k < 2; ++k) {
        // Texel centres lie at halves.
        const double at = static_cast<double>(mesh_.uvs[corner][k]) * size[k] - 0.5;
        low[k] = std::min(low[k], at);
        high[k] = std::max(high[k], at);
      }
    }
    for (const std::uint32_t corner : piece.corners) {
      for (const float coordinate : mesh_.uvs[corner]) {
        if (!std::isfinite(coordinate)) return Keep(piece);
      }
    }
    for (int k = 0; k < 2; ++k) {
      if (!(low[k] > -kMaxRepetitions * size[k] && high[k] < kMaxRepetitions * size[k])) {
        return Keep(piece);
      }
    }
    // Alpha is interpolated between texels.
    const auto floor_of = [](double v) { return static_cast<std::int64_t>(std::floor(v)); };
    const AlphaLevels::Range range = alpha_.Of({floor_of(low[0]), floor_of(low[1])},
                                               {floor_of(high[0]) + 1, floor_of(high[1]) + 1});
    if (opacity_ * range.maximum < cutoff_) return;
    piece.size_texels = std::max(high[0] - low[0], high[1] - low[1]);
    if (opacity_ * range.minimum >= cutoff_ || piece.halvings == kMaxHalvings ||
        piece.size_texels < kMinFilterWidth_texels) {
      return Keep(piece);
    }
    pieces_.push(piece);
  }

  /// The midpoint vertex of an edge, shared by the triangles on either side.
  std::uint32_t Middle(std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!is_new) return found->second;
    std::array<float, 3> position{}, normal{};
    float norm = 0.0F;
    for (int k = 0; k < 3; ++k) {
      position[k] = 0.5F * (mesh_.positions[a][k] + mesh_.positions[b][k]);
      normal[k] = mesh_.normals[a][k] + mesh_.normals[b][k];
      norm += normal[k] * normal[k];
    }
    if (norm > 0.0F) {
      for (float& value : normal) value /= std::sqrt(norm);
    } else {
      normal = mesh_.normals[a];
    }
    const std::array<float, 2> uv{0.5F * (mesh_.uvs[a][0] + mesh_.uvs[b][0]),
                                  0.5F * (mesh_.uvs[a][1] + mesh_.uvs[b][1])};
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal);
    mesh_.uvs.push_back(uv);
    if (!mesh_.details.empty()) {
      mesh_.details.push_back(compositor::Middle(mesh_.details[a], mesh_.details[b]));
    }
    return found->second;
  }

  double cutoff_, opacity_;
  const AlphaLevels& alpha_;
  Mesh& mesh_;
  std::priority_queue<Piece> pieces_;
  std::vector<std::uint32_t> whole_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

/// Removes vertices that no triangle uses.
void DropUnused(Mesh* mesh) {
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> moved(mesh->positions.size(), kUnused);
  for (const std::uint32_t index : mesh->indices) moved[index] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < moved.size(); ++i) {
    if (moved[i] == kUnused) continue;
    mesh->positions[count] = mesh->positions[i];
    mesh->normals[count] = mesh->normals[i];
    mesh->uvs[count] = mesh->uvs[i];
    if (!mesh->details.empty()) mesh->details[count] = mesh->details[i];
    moved[i] = count++;
  }
  mesh->positions.resize(count);
  mesh->normals.resize(count);
  mesh->uvs.resize(count);
  if (!mesh->details.empty()) mesh->details.resize(count);
  for (std::uint32_t& index : mesh->indices) index = moved[index];
}

/// Returns whether the material's own alpha is below the cutoff. A texture's alpha cannot raise it.
bool IsWhollyCutout(const Material& material) {
  return material.alpha != Material::Alpha::kIgnored && material.opacity < CutoffOf(material);
}

/// The texture that may cut holes into a mesh, or -1.
int HolesOf(const Model& model, const Mesh& mesh) {
  const Material& material = model.materials[static_cast<std::size_t>(mesh.material)];
  const int texture = material.base_color_texture;
  if (material.alpha == Material::Alpha::kIgnored || texture < 0 || mesh.uvs.empty()) return -1;
  return model.textures[static_cast<std::size_t>(texture)].channels() == 4 ? texture : -1;
}

}  // namespace

void ApplyAlphaCutout(Model* model, std::size_t max_added) {
  std::map<int, AlphaLevels> levels;
  std::vector<Mesh> drawn;
  for (Mesh& mesh : model->meshes) {
    const Material& material = model->materials[static_cast<std::size_t>(mesh.material)];
    const bool is_glass = material.alpha == Material::Alpha::kBlended;
    if (IsWhollyCutout(material)) {
      if (is_glass) {
        mesh.role = MeshRole::kRenderOnly;
      } else {
        mesh.indices.clear();
      }
      continue;
    }
    const int texture = HolesOf(*model, mesh);
    if (texture < 0) continue;
    const auto& picture = model->textures[static_cast<std::size_t>(texture)];
    const AlphaLevels& alpha = levels.try_emplace(texture, picture).first->second;
    if (material.opacity * static_cast<float>(alpha.Whole().minimum) >=
        255.0F * CutoffOf(material)) {
      continue;
    }
    const std::size_t before = mesh.indices.size() / 3;
    Mesh whole = mesh;
    Cutter(material, alpha, &mesh).Cut(before + max_added);
    DropUnused(&mesh);
    const std::size_t after = mesh.indices.size() / 3;
    max_added -= std::min(max_added, after > before ? after - before : 0);
    if (mesh.indices.empty() && !is_glass) continue;
    mesh.role = MeshRole::kShadowOnly;
    whole.role = MeshRole::kRenderOnly;
    drawn.push_back(std::move(whole));
  }
  std::erase_if(model->meshes, [](const Mesh& mesh) { return mesh.indices.empty(); });
  std::move(drawn.begin(), drawn.end(), std::back_inserter(model->meshes));
}

}  // namespace pleinair::compositor
