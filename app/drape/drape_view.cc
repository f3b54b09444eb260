#include "app/drape/drape_view.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>

#include "base/parallel_for.h"
#include "base/quaternion.h"
#include "devices/calibration/calibration.h"
#include "files/csv.h"

namespace pleinair::app {

Result<Transform<Marker, Camera>> ParseView(const std::string& text) {
  std::istringstream words(text);
  std::array<double, 7> numbers{};
  std::size_t count = 0;
  bool all_numbers = true;
  for (std::string word; words >> word; ++count) {
    const std::optional<double> number = files::ParseNumber(word);
    all_numbers = all_numbers && number;
    if (number && count < numbers.size()) numbers[count] = *number;
  }
  const Quaternion q{numbers[3], numbers[4], numbers[5], numbers[6]};
  const double length = std::sqrt(Dot(q, q));
  const bool fits = all_numbers && count == numbers.size() && length > 0.9 && length < 1.1 &&
                    std::fabs(numbers[0]) < 1e6 && std::fabs(numbers[1]) < 1e6 &&
                    std::fabs(numbers[2]) < 1e6;
  if (!fits) {
    return InputError("--view", "\"" + text.substr(0, 80) + "\" is no place of a camera",
                      "give \"tx ty tz qx qy qz qw\", as a line of poses/*.tum without its time");
  }
  return Transform<Marker, Camera>{RotationOf(q), {numbers[0], numbers[1], numbers[2]}};
}

Result<std::unique_ptr<content::SurfaceView>> ViewOfPhantoms(const content::SurfaceIndex& surface,
                                                             const std::string& view,
                                                             const std::string& calibration,
                                                             const Mat3& marker_from_world,
                                                             std::string* warning) {
  constexpr int kMaxSide = 16384;
  PLEINAIR_ASSIGN_OR_RETURN(const auto marker_from_camera, ParseView(view));
  PLEINAIR_ASSIGN_OR_RETURN(CameraModel camera, devices::ReadCalibration(calibration));
  if (camera.width > kMaxSide || camera.height > kMaxSide) {
    return InputError(calibration, "has more than 16384 pixels a side",
                      "scale the calibration to the size of the images");
  }
  if (camera.HasDistortion()) {
    *warning = "the distortion of the lens is left out: hidden places are those of a pinhole";
    camera.distortion = {};
    camera.distortion_model = DistortionModel::kBrownConrady;
  }
  const Transform<World, Marker> world_from_marker{marker_from_world.Transposed(), {}};
  return std::make_unique<content::SurfaceView>(surface, camera,
                                                world_from_marker * marker_from_camera);
}

std::vector<std::vector<bool>> HiddenVertices(const content::DrapedPieces& draped,
                                              const content::SurfaceIndex& surface,
                                              const Vec3& camera) {
  std::vector<std::vector<bool>> hidden(draped.pieces.size());
  ParallelFor(draped.pieces.size(), 0, [&](std::size_t i) {
    for (const content::DrapedVertex& vertex : draped.pieces[i].vertices) {
      hidden[i].push_back(content::IsHiddenFrom(surface, camera, vertex.at.xyz));
    }
  });
  return hidden;
}

}  // namespace pleinair::app
