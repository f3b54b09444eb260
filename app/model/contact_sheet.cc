#include "app/model/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/replay/time_lapse/day_renderer.h"
#include "base/camera_model.h"
#include "base/frames.h"
#include "base/utc_time.h"
#include "compositor/light/light_solver.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/surfaces/polygon_model.h"
#include "scene/described_surface.h"
#include "scene/scene_description.h"

namespace pleinair::app {
namespace {

constexpr int kViewWidth_px = 640, kViewHeight_px = 480;
constexpr double kPerson_m = 1.75;
// The person is drawn between these multiples of the model's diagonal.
constexpr double kMinPerson = 0.05, kMaxPerson = 3.0;
// Half height of a view over the half size of what it shows.
constexpr double kMargin = 1.15;
// Distance of the camera in half sizes of what it shows.
constexpr double kDistance = 4.5;
constexpr double kGroundAlbedo = 0.35;
constexpr int kRaysPerVertex = 128;

struct View {
  const char* name;
  double azimuth_deg;  ///< Camera azimuth: 0 in front (−y), 90 at the right (+x).
  double elevation_deg;
};
constexpr std::array<View, 4> kViews{
    {{"front", 0, 12}, {"right", 90, 12}, {"back", 180, 12}, {"above", 35, 50}}};

/// Right half of a standing person: x and height in statures, from the top of the head.
constexpr std::array<std::array<double, 2>, 21> kPersonOutline{
    {{0.000, 1.000}, {0.035, 0.985}, {0.052, 0.950}, {0.050, 0.910}, {0.030, 0.870}, {0.030, 0.850},
     {0.110, 0.825}, {0.140, 0.790}, {0.155, 0.650}, {0.170, 0.470}, {0.145, 0.440}, {0.130, 0.600},
     {0.105, 0.720}, {0.095, 0.600}, {0.105, 0.500}, {0.085, 0.270}, {0.075, 0.040}, {0.095, 0.000},
     {0.020, 0.000}, {0.025, 0.250}, {0.010, 0.460}}};

/// The model's size when it is drawn with a diagonal of one.
struct Layout {
  double scale = 1.0;   ///< Scale factor of the model.
  Vec3 half;            ///< Half size of the model's box, scaled.
  double person = 0.0;  ///< Height of the person, scaled; 0: not drawn.
  double radius = 0.0;  ///< Half size of what a view shows.
  Vec3 target;
};

Layout LayoutOf(const compositor::ModelBounds& box) {
  Layout layout;
  layout.scale = 1.0 / std::max(Norm(box.Size()), 1e-12);
  layout.half = box.Size() * (0.5 * layout.scale);
  const double person = kPerson_m * layout.scale;
  if (person > kMinPerson && person < kMaxPerson) layout.person = person;
  const double height = std::max(2.0 * layout.half.z, layout.person);
  // The person stands beside the model.
  const double width = std::hypot(layout.half.x, layout.half.y) + 0.5 * layout.person;
  layout.radius = std::max({0.5 * height, width * kViewHeight_px / kViewWidth_px, 0.5});
  layout.target = {0.0, 0.0, 0.5 * height};
  return layout;
}

Transform<Camera, Marker> CameraOf(const View& view, const Layout& layout) {
  const double azimuth = view.azimuth_deg * kRadiansPerDegree;
  const double elevation = view.elevation_deg * kRadiansPerDegree;
  const Vec3 outwards{std::sin(azimuth) * std::cos(elevation),
                      -std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
  const Vec3 forward = -outwards;
  const Vec3 right = Normalized(Cross(forward, {0.0, 0.0, 1.0}));
  const Vec3 down = Cross(forward, right);
  const Mat3 rotation{
      {right.x, right.y, right.z, down.x, down.y, down.z, forward.x, forward.y, forward.z}};
  const Vec3 eye = layout.target + outwards * (kDistance * layout.radius);
  return {rotation, -(rotation * eye)};
}

CameraModel Lens() {
  CameraModel camera;
  camera.width = kViewWidth_px;
  camera.height = kViewHeight_px;
  camera.fx = camera.fy = 0.5 * kViewHeight_px * kDistance / kMargin;
  camera.cx = 0.5 * (kViewWidth_px - 1);
  camera.cy = 0.5 * (kViewHeight_px - 1);
  return camera;
}

compositor::PlacedModel Ground(double half) {
  const auto square = scene::GroundSurface(2 * half, 0.0, /*upright=*/false);
  compositor::PlacedModel placed;
  placed.model = std::make_shared<const compositor::Model>(
      compositor::PolygonModel("ground", square.polygons, LinearRgb{1, 1, 1} * kGroundAlbedo));
  placed.is_phantom = true;
  return placed;
}

/// The model with its bottom centre at the origin and a diagonal of one.
compositor::PlacedModel Standing(const std::shared_ptr<const compositor::Model>& model,
                                 const Layout& layout) {
  compositor::PlacedModel placed;
  placed.model = model;
  for (double& element : placed.linear.m) element *= layout.scale;
  const compositor::ModelBounds box = BoundsOf(*model);
  const Vec3 foot{box.Centre().x, box.Centre().y, box.min_m.z};
  // PlacedModel::model's positions are relative to its origin.
  placed.translation_m = (model->origin_m - foot) * layout.scale;
  return placed;
}

/// Spring afternoon at 50° north: the sun stands 40° high in the southwest, left of the front.
scene::SceneDescription StandardScene() {
  scene::SceneDescription scene;
  scene.place_time.latitude_deg = 50.0;
  scene.place_time.start = UtcTime::Parse("2025-04-21T14:00:00Z").value();
  scene.marker.heading = FromDegrees(-5.0);
  return scene;
}

Result<std::unique_ptr<DayRenderer>> Renderer(const std::shared_ptr<const compositor::Model>& model,
                                              const Layout& layout,
                                              const scene::SceneDescription& scene) {
  const std::vector<compositor::PlacedModel> placed{Ground(12.0 * layout.radius),
                                                    Standing(model, layout)};
  compositor::LightSolverOptions solving;
  solving.rays_per_vertex = kRaysPerVertex;
  PLEINAIR_ASSIGN_OR_RETURN(auto solver, compositor::LightSolver::Create(placed, solving));
  session::LightingRequest request{scene.place_time.start,
                                   scene.place_time,
                                   scene.marker,
                                   {compositor::DescribedSky(scene)},
                                   std::move(solver),
                                   {},
                                   {},
                                   {}};
  request.skies.unmodelled_shadows = false;
  return DayRenderer::Create(Lens(), placed, std::move(request), {}, /*phantoms_cast=*/false);
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `length`.
double RoundLength(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double lead = length / power;
  return power * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
}

std::string LengthLabel(double length_m) {
  if (length_m >= 1000.0) return fmt::format("{:g} km", length_m * 1e-3);
  if (length_m >= 1.0) return fmt::format("{:g} m", length_m);
  if (length_m >= 0.01) return fmt::format("{:g} cm", length_m * 100.0);
  return fmt::format("{:g} mm", length_m * 1000.0);
}

void Write(const std::string& text, cv::Point at, cv::Mat* image) {
  for (const auto& [color, width] :
       {std::pair{cv::Scalar(255, 255, 255), 3}, std::pair{cv::Scalar(30, 34, 40), 1}}) {
    cv::putText(*image, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.55, color, width, cv::LINE_AA);
  }
}

/// Draws the person beside the model, upright and facing the camera.
void DrawPerson(const Layout& layout, const Transform<Camera, Marker>& camera_from_marker,
                cv::Mat* image) {
  const CameraModel camera = Lens();
  const Mat3& rotation = camera_from_marker.rotation;
  const Vec3 right{rotation(0, 0), rotation(0, 1), rotation(0, 2)};
  const double beside = std::abs(right.x) * layout.half.x + std::abs(right.y) * layout.half.y;
  const Vec3 foot = right * (beside + 0.25 * layout.person);
  std::vector<cv::Point> outline;
  constexpr int kShift = 4;  // Sixteenths of a pixel.
  const auto add = [&](double x, double height) {
    const Vec3 point = foot + right * (x * layout.person) + Vec3{0, 0, height * layout.person};
    const Vec2 pixel = ProjectToPixel(camera, camera_from_marker * Point<Marker>{point});
    outline.emplace_back(static_cast<int>(std::lround(pixel.x * (1 << kShift))),
                         static_cast<int>(std::lround(pixel.y * (1 << kShift))));
  };
  for (const auto& [x, height] : kPersonOutline) add(x, height);
  for (auto point = kPersonOutline.rbegin(); point != kPersonOutline.rend() - 1; ++point) {
    add(-(*point)[0], (*point)[1]);
  }
  cv::polylines(*image, std::vector{outline}, true, {30, 34, 40}, 1, cv::LINE_AA, kShift);
}

/// Draws a scale bar for lengths at the model's distance.
void DrawScale(const Layout& layout, cv::Mat* image) {
  const double pixels_per_unit = Lens().fx / (kDistance * layout.radius);
  const double pixels_per_m = pixels_per_unit * layout.scale;
  const double length_m = RoundLength(0.3 * kViewWidth_px / pixels_per_m);
  const cv::Point left(16, kViewHeight_px - 18);
  const cv::Point right(16 + static_cast<int>(std::lround(length_m * pixels_per_m)), left.y);
  for (const auto& [color, width] :
       {std::pair{cv::Scalar(255, 255, 255), 5}, std::pair{cv::Scalar(30, 34, 40), 2}}) {
    cv::line(*image, left, right, color, width);
  }
  Write(LengthLabel(length_m), {left.x, left.y - 8}, image);
}

}  // namespace

Result<RgbImage> ContactSheet(const std::shared_ptr<const compositor::Model>& model) {
  const Layout layout = LayoutOf(BoundsOf(*model));
  const scene::SceneDescription scene = StandardScene();
  PLEINAIR_ASSIGN_OR_RETURN(const auto renderer, Renderer(model, layout, scene));
  const UtcTime time = scene.place_time.start;
  const LinearRgb level = renderer->LevelLight(time);
  RgbImage sheet(2 * kViewWidth_px, 2 * kViewHeight_px, 3);
  cv::Mat whole(sheet.height(), sheet.width(), CV_8UC3, sheet.data());
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    const auto camera_from_marker = CameraOf(kViews[i], layout);
    PLEINAIR_ASSIGN_OR_RETURN(RgbImage image, renderer->Render(camera_from_marker, time,
                                                               ExposureScaleOfDay(level, level)));
    cv::Mat view(image.height(), image.width(), CV_8UC3, image.data());
    if (layout.person > 0.0) DrawPerson(layout, camera_from_marker, &view);
    DrawScale(layout, &view);
    Write(kViews[i].name, {16, 28}, &view);
    view.copyTo(
        whole(cv::Rect(static_cast<int>(i % 2) * kViewWidth_px,
                       static_cast<int>(i / 2) * kViewHeight_px, kViewWidth_px, kViewHeight_px)));
  }
  return sheet;
}

}  // namespace pleinair::app
