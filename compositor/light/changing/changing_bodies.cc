#include "compositor/light/changing/changing_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "compositor/light/changing/body_probes.h"
#include "compositor/light/changing/changing_mesh.h"
#include "compositor/light/changing/contact_light.h"
#include "compositor/light/changing/sky_harmonics.h"
#include "compositor/light/changing/surroundings.h"

namespace pleinair::compositor {
namespace {

// Probes and still vertices that a frame refreshes: about 4 ms on two processors.
constexpr std::size_t kProbesPerFrame = 192, kVerticesPerFrame = 384;
// The same where no shape changes: nothing else is done in such a frame.
constexpr std::size_t kProbesPerFrameAtRest = 576;
// Rounds over all of them when the scene or its light is new. The first does not count, so that the
// first frame has 64 rays a probe.
constexpr int kFirstRounds = 5;
// Movement of the sun after which all light is traced again.
constexpr double kMaxSunMove = 0.03;
// The same of their light, relative.
constexpr double kMaxLightChange = 0.05;

bool HaveSameGeometry(std::span<const LitMesh> a, std::span<const LitMesh> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LitMesh& x, const LitMesh& y) {
    return x.geometry == y.geometry && x.geometry != 0 && x.is_phantom == y.is_phantom;
  });
}

class TracedBodies : public ChangingBodies {
 public:
  explicit TracedBodies(const std::vector<PlacedModel>& scene) {
    bodies_.reserve(scene.size());  // Probes refer to them.
    for (std::size_t i = 0; i < scene.size(); ++i) {
      if (!scene[i].playback.animation) continue;
      bodies_.emplace_back(scene[i], static_cast<int>(i));
    }
  }

  bool empty() const { return bodies_.empty(); }

  bool Has(int placed_model) const override { return Find(placed_model) != nullptr; }

  void SetShape(int placed_model, std::span<const MeshShape> shape) override {
    ChangingMesh* body = Find(placed_model);
    if (body == nullptr) return;
    state_.has_new_shape = true;
    if (!ChangingMesh::HasTriangles(shape)) {
      body->SetShape(shape);
      return;
    }
    *body = body->WithTriangles(shape);
    state_.has_new_triangles = true;
  }

  void Move(int placed_model, const Mat3& linear, Vec3 translation_m) override {
    if (ChangingMesh* body = Find(placed_model)) body->Move(linear, translation_m);
  }

  Result<void> SetLight(const std::vector<LitMesh>& still, const sky::SkyModel& daylight,
                        const Mat3& marker_from_world) override {
    if (state_.has_new_triangles && contacts_) {
      PLEINAIR_RETURN_IF_ERROR(MakeBodies());
      state_.has_new_triangles = false;
    }
    const bool is_new = !HaveSameGeometry(still_, still) || still_.empty();
    still_ = still;
    surroundings_.SetDaylight(daylight, marker_from_world);
    harmonics_ = SkyHarmonics(surroundings_.sky());
    if (is_new) {
      PLEINAIR_RETURN_IF_ERROR(MakeSurfaces());
    } else {
      std::copy(still_.begin(), still_.end(), meshes_.begin());
    }
    const Vec3 to_sun = marker_from_world * daylight.ToSun().xyz;
    const double lux =
        Luminance(daylight.SunNormalIrradiance()) + Luminance(daylight.SkyHorizontalIrradiance());
    if (is_new || Norm(to_sun - state_.to_sun) > kMaxSunMove ||
        std::fabs(lux - state_.lux) > kMaxLightChange * state_.lux) {
      state_.to_sun = to_sun;
      state_.lux = lux;
      state_.rounds = kFirstRounds;
      Forget();
    }
    contacts_->Light(Still());
    return {};
  }

  Result<Changed> Update() override {
    if (!contacts_) return Changed::kNothing;
    Changed changed = Changed::kNothing;
    if (state_.has_new_triangles) {
      PLEINAIR_RETURN_IF_ERROR(MakeBodies());
      changed = Changed::kTriangles;
    } else if (state_.has_new_shape && Follow()) {
      changed = Changed::kShape;
    }
    state_.has_new_shape = state_.has_new_triangles = false;
    for (; state_.rounds > 0; --state_.rounds) {
      Refresh(probes_->size(), contacts_->size());
      // The rays of the first round end at surfaces with their light of before.
      if (state_.rounds == kFirstRounds) Forget();
    }
    contacts_->FadeOut();
    Refresh(changed == Changed::kNothing ? kProbesPerFrameAtRest : kProbesPerFrame,
            kVerticesPerFrame);
    return changed;
  }

  const std::vector<LitMesh>& meshes() const override { return meshes_; }
  std::size_t first_body() const override { return still_.size(); }

 private:
  struct State {
    bool has_new_shape = true, has_new_triangles = false;
    int rounds = 0;    // Over all probes, before the next frame.
    Vec3 to_sun;       // When all light was last traced; `lux`, too.
    double lux = 0.0;  // The unshaded sun and the sky together.
  };

  const ChangingMesh* Find(int placed_model) const {
    const auto found = std::ranges::find(bodies_, placed_model, &ChangingMesh::placed_model);
    return found == bodies_.end() ? nullptr : &*found;
  }
  ChangingMesh* Find(int placed_model) {
    return const_cast<ChangingMesh*>(std::as_const(*this).Find(placed_model));
  }

  void Forget() {
    probes_->Forget();
    contacts_->Forget();
  }

  std::span<LitMesh> Still() { return std::span(meshes_).first(still_.size()); }
  std::span<LitMesh> Drawn() { return std::span(meshes_).subspan(still_.size()); }

  /// Copies the still surfaces, and adds those of the bodies.
  Result<void> MakeSurfaces() {
    std::vector<LitMesh> drawn;
    if (!probes_) probes_.emplace(bodies_);
    if (meshes_.empty()) {
      for (const ChangingMesh& body : bodies_) {
        for (LitMesh& mesh : body.DrawnMeshes()) drawn.push_back(std::move(mesh));
      }
    } else {
      drawn.assign(std::make_move_iterator(meshes_.end() - static_cast<std::ptrdiff_t>(drawn_)),
                   std::make_move_iterator(meshes_.end()));
    }
    drawn_ = drawn.size();
    contacts_.emplace(still_);
    return Place(still_, std::move(drawn));
  }

  /// Makes the bodies' surfaces again, of other triangles. Still surfaces keep their light.
  Result<void> MakeBodies() {
    BodyProbes probes(bodies_);
    probes.StartFrom(*probes_);
    probes_.emplace(std::move(probes));
    std::vector<LitMesh> still(std::make_move_iterator(Still().begin()),
                               std::make_move_iterator(Still().end()));
    std::vector<LitMesh> drawn;
    for (const ChangingMesh& body : bodies_) {
      for (LitMesh& mesh : body.DrawnMeshes()) drawn.push_back(std::move(mesh));
    }
    drawn_ = drawn.size();
    return Place(std::move(still), std::move(drawn));
  }

  /// Takes surfaces, of which rays then see the still ones and the bodies.
  Result<void> Place(std::vector<LitMesh> still, std::vector<LitMesh> drawn) {
    meshes_ = std::move(still);
    meshes_.insert(meshes_.end(), std::make_move_iterator(drawn.begin()),
                   std::make_move_iterator(drawn.end()));
    PLEINAIR_RETURN_IF_ERROR(surroundings_.SetStill(PairedSides(Still())));
    std::vector<Surroundings::Surface> bodies = PairedSides(Drawn());
    for (Surroundings::Surface& body : bodies) {
      body.coarse = probes_->CoarseTriangles(static_cast<std::size_t>(body.front - Drawn().data()));
    }
    PLEINAIR_RETURN_IF_ERROR(surroundings_.SetBodies(std::move(bodies)));
    contacts_->FollowBodies(Drawn(), 0.0);
    return {};
  }

  /// Moves the drawn surfaces to the bodies' shapes. Returns whether they differ from the last
  /// ones.
  bool Follow() {
    std::size_t next = 0;
    ChangingMesh::Movement all;
    for (const ChangingMesh& body : bodies_) {
      std::size_t count = 0;
      for (const SurfaceMesh& surface : body.surfaces()) count += surface.closed ? 1 : 2;
      const ChangingMesh::Movement own = body.CopyShape(Drawn().subspan(next, count));
      all = {std::max(all.farthest_m, own.farthest_m), all.any || own.any};
      next += count;
    }
    if (!all.any) return false;
    surroundings_.MoveBodies();
    contacts_->FollowBodies(Drawn(), static_cast<double>(all.farthest_m));
    return true;
  }

  void Refresh(std::size_t probes, std::size_t vertices) {
    probes_->Refresh(surroundings_, probes);
    contacts_->Refresh(surroundings_, vertices);
    probes_->Light(harmonics_, Drawn());
    contacts_->Light(Still());
  }

  std::vector<ChangingMesh> bodies_;
  std::vector<LitMesh> still_;  // Without the bodies.
  std::vector<LitMesh> meshes_;
  std::size_t drawn_ = 0;  // Number of the bodies' meshes.
  Surroundings surroundings_;
  SkyHarmonics harmonics_;
  std::optional<BodyProbes> probes_;
  std::optional<ContactLight> contacts_;
  State state_;
};

}  // namespace

Result<std::unique_ptr<ChangingBodies>> ChangingBodies::Create(
    const std::vector<PlacedModel>& scene) {
  auto bodies = std::make_unique<TracedBodies>(scene);
  if (bodies->empty()) return nullptr;
  return bodies;
}

}  // namespace pleinair::compositor
