// Measures draping, as docs/measurements/draping.md has it:
//   drape_benchmark                        one million vertices of lines on 500,000 triangles
//   drape_benchmark write FOLDER           the same as a scene for `pleinair drape`
//   drape_benchmark screen                 the grids of Trapp and Döllner 2019, on the screen
//   drape_benchmark screen --depth-test printed    the same with the depth test as it is printed
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <optional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "content/draping/drape_lines.h"
#include "content/draping/screen_search.h"
#include "content/draping/surface_view.h"
#include "content/georeference/local_frame.h"
#include "tests/content/draping/made_surfaces.h"

namespace pleinair::content {
namespace {

double Hills(double x, double y) {
  return 8.0 * std::sin(0.021 * x) * std::cos(0.017 * y) + 0.03 * x;
}

/// Shortest time of a function in several runs, milliseconds.
template <typename Body>
double Fastest(int runs, const Body& body) {
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < runs; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    body();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    fastest = std::min(fastest, time.count());
  }
  return fastest;
}

/// Winding lines of 1,000 vertices 1 m apart.
std::vector<LineToDrape> Trails(std::size_t lines, double half_m) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-half_m, half_m), turn(-0.3, 0.3);
  std::vector<LineToDrape> trails(lines);
  for (LineToDrape& trail : trails) {
    Vec3 at{place(random), place(random), 0.0};
    double way = place(random);
    for (int i = 0; i < 1000; ++i) {
      trail.points.push_back({at});
      way += turn(random);
      const Vec3 next{at.x + std::cos(way), at.y + std::sin(way), 0.0};
      if (std::fabs(next.x) < half_m && std::fabs(next.y) < half_m) {
        at = next;
      } else {
        way += 2.0;
      }
    }
  }
  return trails;
}

void MeasureScale() {
  tests::MeshMaker maker;
  maker.Field(500, 500.0, Hills);
  const SurfaceMesh mesh = maker.Take();
  const std::vector<LineToDrape> trails = Trails(1000, 490.0);
  for (const int threads : {1, 2}) {
    DrapeOptions options;
    options.threads = threads;
    std::size_t vertices_out = 0;
    const double ms = Fastest(3, [&] {
      const auto index = SurfaceIndex::Create(mesh);
      vertices_out = DrapeExactly(trails, *index, options, "trails")->report.vertices_out;
    });
    std::printf("%d threads: %zu vertices out, %.0f ms\n", threads, vertices_out, ms);
  }
}

/// Hills and trails of MeasureScale(): x is east and y north of a level marker.
void WriteScene(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  tests::MeshMaker maker;
  maker.Field(500, 500.0, Hills);
  const SurfaceMesh mesh = maker.Take();
  std::ofstream hills(folder / "hills.obj");
  for (const Point<World>& at : mesh.vertices) {
    hills << "v " << at.xyz.x << ' ' << at.xyz.y << ' ' << at.xyz.z << '\n';
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    hills << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  constexpr double kLatitude_deg = 50.0, kLongitude_deg = 14.0;
  const LocalFrame frame({kLongitude_deg, kLatitude_deg, 0.0});
  std::ofstream map(folder / "trails.geojson");
  map << std::setprecision(12) << R"({"type":"FeatureCollection","features":[)";
  const char* before_line = "\n";
  for (const LineToDrape& trail : Trails(1000, 490.0)) {
    map << before_line << R"({"type":"Feature","properties":{},)"
        << R"("geometry":{"type":"LineString","coordinates":[)";
    const char* before_point = "";
    for (const Point<World>& at : trail.points) {
      const GeodeticPoint on_earth = frame.Geodetic(at);
      map << before_point << '[' << on_earth.longitude_deg << ',' << on_earth.latitude_deg << ']';
      before_point = ",";
    }
    map << "]}}";
    before_line = ",\n";
  }
  map << "]}\n";
  std::ofstream(folder / "scene.toml")
      << "time = 2025-09-14T11:05:00Z\n[place]\nlatitude_deg = " << kLatitude_deg
      << "\nlongitude_deg = " << kLongitude_deg
      << "\n[marker]\nsize_mm = 480\nheading_deg = 0\n[[phantom]]\nfile = \"hills.obj\"\n"
         "[[drape]]\nfile = \"trails.geojson\"\n";
}

/// A field of 257 by 257 vertices, 160 m wide, and a camera that looks north over it.
struct PaperScene {
  SurfaceIndex index;
  CameraModel camera;

  static PaperScene Make() {
    tests::MeshMaker maker;
    maker.Field(256, 80.0, [](double x, double y) {
      return 2.5 * std::sin(0.16 * x) * std::cos(0.11 * y) + 1.5 * std::sin(0.07 * y + 1.0);
    });
    CameraModel camera;
    camera.width = 1280;
    camera.height = 720;
    camera.fx = camera.fy = 1000.0;
    camera.cx = 639.5;
    camera.cy = 359.5;
    return {*SurfaceIndex::Create(maker.Take()), camera};
  }
  SurfaceView ViewAt(double pitch_deg) const {
    const double c = std::cos(pitch_deg * M_PI / 180), s = std::sin(pitch_deg * M_PI / 180);
    const Vec3 centre = pitch_deg < -30.0 ? Vec3{0, -40, 60} : Vec3{0, -85, 6};
    return {index, camera, {{{1, 0, 0, 0, s, c, 0, -c, s}}, centre}};
  }
};

/// The search as it is printed: compares the depths of (x, y, z) and of (x, y, P.z), two points of
/// one vertical line.
std::optional<double> SearchAsPrinted(const SurfaceView& view, Vec2 at, const HeightRange& range) {
  double low = range.low_m - 1.0, high = range.high_m + 1.0;
  constexpr int kSteps = 11;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = 0.5 * (low + high);
    const Vec3 point{at.x, at.y, middle};
    const auto pixel = view.PixelOf(point);
    if (!pixel || !view.InPicture(*pixel)) return std::nullopt;
    const auto sight = view.At(*pixel);
    const double seen = sight ? view.InCamera({at.x, at.y, sight->at.z}).z
                              : std::numeric_limits<double>::infinity();
    (view.InCamera(point).z < seen ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Vertices of an n by n grid over the field.
std::vector<Vec2> GridOf(int n) {
  std::vector<Vec2> grid;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      grid.push_back({-60.0 + 120.0 * column / (n - 1), -60.0 + 120.0 * row / (n - 1)});
    }
  }
  return grid;
}

void MeasureScreen(bool as_printed) {
  const PaperScene scene = PaperScene::Make();
  const HeightRange range = HeightsOf(scene.index);
  const auto search = [&](const SurfaceView& view, Vec2 at) -> std::optional<double> {
    if (as_printed) return SearchAsPrinted(view, at, range);
    const auto found = SearchScreen(view, at, range);
    // What is flagged as hidden takes the exact path.
    if (!found || found->hidden) return std::nullopt;
    return found->height_m;
  };
  std::printf("depth test: %s\n", as_printed ? "printed" : "corrected");
  for (const double pitch_deg : {-60.0, -20.0, 0.0, 5.0}) {
    const SurfaceView view = scene.ViewAt(pitch_deg);
    double squares = 0.0;
    int count = 0;
    for (const Vec2 at : GridOf(100)) {
      const double exact_m = *scene.index.HeightAt(at, {});
      const auto found = search(view, at);
      const auto pixel = view.PixelOf({at.x, at.y, exact_m});
      if (!found || !pixel || !view.InPicture(*pixel) ||
          IsHiddenFrom(scene.index, view.centre(), {at.x, at.y, exact_m})) {
        continue;
      }
      squares += (*found - exact_m) * (*found - exact_m);
      ++count;
    }
    std::printf("pitch %+.0f: RMS %.4f m of %d visible vertices\n", pitch_deg,
                std::sqrt(squares / count), count);
  }
  const SurfaceView view = scene.ViewAt(-20.0);
  double first_ms = 0.0;
  for (const int n : {50, 70, 100}) {
    const std::vector<Vec2> grid = GridOf(n);
    double sum = 0.0;
    const double ms = Fastest(20, [&] {
      for (const Vec2 at : grid) sum += search(view, at).value_or(0.0);
    });
    if (n == 50) first_ms = ms;
    std::printf("%d vertices: %.2f ms, %.2f us a vertex, rate %.3f (sum %.3g)\n", n * n, ms,
                1e3 * ms / (n * n), first_ms / ms, sum);
  }
}

}  // namespace
}  // namespace pleinair::content

int main(int argc, char** argv) {
  if (argc < 2) {
    pleinair::content::MeasureScale();
  } else if (argc == 3 && std::string_view(argv[1]) == "write") {
    pleinair::content::WriteScene(argv[2]);
  } else {
    pleinair::content::MeasureScreen(std::string_view(argv[argc - 1]) == "printed");
  }
}
