#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "export/trajectories/colmap_binary.h"
#include "export/trajectories/colmap_model.h"
#include "export/trajectories/colmap_text.h"
#include "export/trajectories/euroc_trajectory.h"
#include "export/trajectories/place_pairs.h"
#include "export/trajectories/record3d_archive.h"
#include "export/trajectories/record3d_trajectory.h"
#include "export/trajectories/stray_trajectory.h"
#include "export/trajectories/tum_trajectory.h"

namespace {

using pleinair::Result;
using pleinair::exports::CameraTrajectory;

// A valid trajectory has ascending times and finite rotations. An error has a message.
void Check(const Result<CameraTrajectory>& path) {
  if (!path) {
    if (path.error().what.empty()) std::abort();
    return;
  }
  if (path->poses.empty()) std::abort();
  for (std::size_t i = 0; i < path->poses.size(); ++i) {
    const auto& pose = path->poses[i];
    if (i > 0 && pose.timestamp_ns <= path->poses[i - 1].timestamp_ns) std::abort();
    const auto& t = pose.reference_from_camera.translation_m;
    if (!std::isfinite(t.x + t.y + t.z)) std::abort();
    const pleinair::Mat3 square =
        pose.reference_from_camera.rotation * pose.reference_from_camera.rotation.Transposed();
    for (int k = 0; k < 9; ++k) {
      if (!(std::fabs(square.m[k] - pleinair::Mat3().m[k]) < 1e-9)) std::abort();
    }
  }
  // A trajectory that was read can be written and read again.
  if (!pleinair::exports::ParseTum(pleinair::exports::TumText(*path, "again"), "again"))
    std::abort();
}

void CheckModel(Result<pleinair::exports::ColmapModel> model) {
  if (!model) {
    if (model.error().what.empty()) std::abort();
    return;
  }
  Check(pleinair::exports::TrajectoryFromColmap(*std::move(model), 30.0));
}

}  // namespace

// Any bytes give a trajectory or an error in each format. Lines of '=' separate the three files of
// a COLMAP model.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Check(pleinair::exports::ParseTum(text, "file"));
  const auto mounting = pleinair::devices::ParseEurocExtrinsics(text, "file");
  Check(pleinair::exports::ParseEurocTrajectory(
      text, "file",
      mounting.value_or(pleinair::Transform<pleinair::devices::EurocBody, pleinair::Camera>{})));
  Check(pleinair::exports::ParseStrayOdometry(text, "file"));
  Check(pleinair::exports::ParseRecord3dMetadata(text, "file"));
  if (const auto json = pleinair::exports::ParseRecord3dArchive(text, "file")) {
    Check(pleinair::exports::ParseRecord3dMetadata(*json, "file"));
  } else if (json.error().what.empty()) {
    std::abort();
  }
  if (const auto lens = pleinair::exports::ParseStrayCamera(text, "file"); lens && *lens) {
    if (!((*lens)->fx > 0.0 && std::isfinite((*lens)->cx))) std::abort();
  }
  const auto places = pleinair::exports::ParsePlacePairs(text, "file");
  if (places ? places->size() < 3 : places.error().what.empty()) std::abort();
  pleinair::exports::ColmapFiles files;
  const std::size_t first = text.find("=\n");
  if (first == std::string_view::npos) return 0;
  const std::size_t second = text.find("=\n", first + 2);
  files.cameras = text.substr(0, first);
  files.images =
      text.substr(first + 2, second == std::string_view::npos ? second : second - first - 2);
  if (second != std::string_view::npos) files.points3d = text.substr(second + 2);
  CheckModel(pleinair::exports::ParseColmapText(files, "model"));
  CheckModel(pleinair::exports::ParseColmapBinary(files, "model"));
  return 0;
}
