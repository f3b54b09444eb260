// Compares lines and even placement with VTK's filters in one run, one thread each, as
// docs/measurements/flow.md has it. The error of a line is its distance from the exact curve on the
// same interpolant, at about half of its length.
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkEvenlySpacedStreamlines2D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamTracer.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "content/flow/even_placement.h"
#include "content/flow/line_integrator.h"
#include "content/flow/particles.h"
#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

constexpr double kLength_m = 12.0;
constexpr Seconds kCompared_s = 1.5;  // From the seed, about half of the length.

/// Time of a function, seconds.
template <typename Body>
double SecondsOf(const Body& body) {
  const auto begin = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Nine pairs of gyres on the square from −1 to 1.
Vec3 Gyres(const Vec3& p) {
  constexpr double k = 3.0 * std::numbers::pi;
  return {-std::sin(k * p.x) * std::cos(k * p.y), std::cos(k * p.x) * std::sin(k * p.y), 0.0};
}

/// An image of a function at `count`³ nodes, or `count`² in the plane.
vtkNew<vtkImageData> ImageOf(int count, int layers, const Vec3& origin, double cell,
                             const std::function<Vec3(const Vec3&)>& function) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(count, count, layers);
  image->SetSpacing(cell, cell, layers > 1 ? cell : 1.0);
  image->SetOrigin(origin.x, origin.y, origin.z);
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("U");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(static_cast<vtkIdType>(count) * count * layers);
  vtkIdType node = 0;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < count; ++i) {
        const Vec3 v = function(origin + Vec3{i * cell, j * cell, k * cell});
        vectors->SetTuple3(node++, v.x, v.y, v.z);
      }
    }
  }
  image->GetPointData()->SetVectors(vectors);
  return image;
}

/// Distance of a point from the curve through `from`, followed a little longer than `time_s`.
double DistanceFromCurve(const VectorField& field, const Vec3& from, Seconds time_s,
                         const Vec3& point) {
  constexpr int kSteps = 6000;
  const Seconds step_s = 1.15 * time_s / kSteps;
  double nearest = 1e9;
  Vec3 at = from;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 next = FineRk4(field, at, 0.0, step_s, 1);
    if (std::isnan(next.x)) break;
    const Vec3 way = next - at;
    const double share = std::clamp(Dot(point - at, way) / Dot(way, way), 0.0, 1.0);
    nearest = std::min(nearest, Norm(at + way * share - point));
    at = next;
  }
  return nearest;
}

struct TimedLine {
  std::vector<Vec3> points;
  std::vector<Seconds> times_s;
};

/// RMS over about 80 lines of those that are followed beyond the compared time, in cells.
double ErrorOf(const VectorField& field, const std::vector<TimedLine>& lines) {
  double squares = 0.0;
  int count = 0;
  const std::size_t step = std::max<std::size_t>(lines.size() / 100, 1);
  for (std::size_t i = 0; i < lines.size(); i += step) {
    const TimedLine& line = lines[i];
    std::size_t last = 0;
    for (std::size_t n = 0; n < line.points.size(); ++n) {
      if (line.times_s[n] <= kCompared_s) last = n;
    }
    if (last == 0 || last + 1 == line.points.size()) continue;
    const double away_m =
        DistanceFromCurve(field, line.points[0], line.times_s[last], line.points[last]);
    squares += std::pow(away_m / field.cell_m(), 2);
    ++count;
  }
  return std::sqrt(squares / std::max(count, 1));
}

std::vector<TimedLine> LinesOf(vtkPolyData* output) {
  auto* times = vtkDoubleArray::SafeDownCast(output->GetPointData()->GetArray("IntegrationTime"));
  std::vector<TimedLine> lines;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  output->GetLines()->InitTraversal();
  while (output->GetLines()->GetNextCell(count, ids) != 0) {
    TimedLine& line = lines.emplace_back();
    for (vtkIdType n = 0; n < count; ++n) {
      std::array<double, 3> at{};
      output->GetPoint(ids[n], at.data());
      line.points.push_back({at[0], at[1], at[2]});
      line.times_s.push_back(times != nullptr ? times->GetValue(ids[n]) : 0.0);
    }
  }
  return lines;
}

void CompareStreamTracer() {
  constexpr int kNodes = 128;
  const double cell = 2.0 * std::numbers::pi / (kNodes - 1);
  const GridAxis axis(0.0, cell, kNodes);
  const auto field = MakeSteady({{axis, axis, axis}, {}}, AbcFlow);
  const auto image = ImageOf(kNodes, kNodes, {}, cell, AbcFlow);
  std::vector<Seed> seeds;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < 10'000; ++i) {
    const Vec3 at = Birthplace(field->bounds(), i);
    seeds.push_back({at});
    points->InsertNextPoint(at.x, at.y, at.z);
  }
  vtkNew<vtkPolyData> source;
  source->SetPoints(points);

  std::vector<FlowLine> ours;
  const double seconds = SecondsOf(
      [&] { ours = TraceLines(*field, seeds, {.length_m = kLength_m, .threads = 1}).value(); });
  std::vector<TimedLine> timed;
  std::size_t vertices = 0;
  for (const FlowLine& line : ours) {
    timed.push_back({line.points, line.times_s});
    vertices += line.points.size();
  }
  std::printf("TraceLines: %.2f s, %zu vertices, %.1e cells\n", seconds, vertices,
              ErrorOf(*field, timed));

  struct Peer {
    const char* name;
    int integrator;
    double first_cells, largest_cells;
  };
  for (const Peer& peer :
       {Peer{"RK45, up to 0.5 cells", vtkStreamTracer::RUNGE_KUTTA45, 0.25, 0.5},
        Peer{"RK45, up to 0.25 cells", vtkStreamTracer::RUNGE_KUTTA45, 0.1, 0.25},
        Peer{"RK4, 0.1 cells", vtkStreamTracer::RUNGE_KUTTA4, 0.1, 0.1}}) {
    vtkNew<vtkStreamTracer> tracer;
    tracer->SetInputData(image);
    tracer->SetSourceData(source);
    tracer->SetIntegratorType(peer.integrator);
    tracer->SetIntegrationStepUnit(vtkStreamTracer::CELL_LENGTH_UNIT);
    tracer->SetInitialIntegrationStep(peer.first_cells);
    tracer->SetMinimumIntegrationStep(0.01);
    tracer->SetMaximumIntegrationStep(peer.largest_cells);
    tracer->SetMaximumError(1e-6);
    tracer->SetMaximumPropagation(kLength_m);
    tracer->SetMaximumNumberOfSteps(100'000);
    tracer->SetIntegrationDirectionToForward();
    tracer->SetComputeVorticity(false);
    const double peer_seconds = SecondsOf([&] { tracer->Update(); });
    std::printf("vtkStreamTracer, %s: %.2f s, %lld vertices, %.1e cells\n", peer.name, peer_seconds,
                static_cast<long long>(tracer->GetOutput()->GetNumberOfPoints()),
                ErrorOf(*field, LinesOf(tracer->GetOutput())));
  }
}

void PrintSpacing(const char* name, double seconds, const std::vector<FlowLine>& lines,
                  const VectorField& field, double spacing_m) {
  const LineSpacing spacing = MeasureSpacing(field, 0.0, lines, spacing_m);
  std::printf("%s, %.1f cells: %.2f s, %zu lines, covered %.4f, nearest %.3f d\n", name,
              spacing_m / field.cell_m(), seconds, lines.size(), spacing.covered,
              spacing.nearest_min_m / spacing_m);
}

void ComparePlacement() {
  constexpr int kNodes = 512;
  const double cell = 2.0 / (kNodes - 1);
  const auto field = MakeSteady(Square(kNodes, 1.0), Gyres);
  const auto image = ImageOf(kNodes, 1, {-1.0, -1.0, 0.0}, cell, Gyres);
  for (const double cells : {12.8, 6.4}) {
    std::vector<FlowLine> ours;
    const double seconds =
        SecondsOf([&] { ours = PlaceLines(*field, cells * cell, {.threads = 1}).value(); });
    PrintSpacing("PlaceLines", seconds, ours, *field, cells * cell);
    vtkNew<vtkEvenlySpacedStreamlines2D> peer;
    peer->SetInputData(image);
    peer->SetStartPosition(0.1, 0.1, 0.0);
    peer->SetSeparatingDistance(cells);
    peer->SetSeparatingDistanceRatio(0.5);
    peer->SetIntegrationStepUnit(vtkStreamTracer::CELL_LENGTH_UNIT);
    peer->SetInitialIntegrationStep(0.5);
    peer->SetMaximumNumberOfSteps(20'000);
    peer->SetClosedLoopMaximumDistance(0.2);
    peer->SetIntegratorTypeToRungeKutta4();
    const double peer_seconds = SecondsOf([&] { peer->Update(); });
    std::vector<FlowLine> lines;
    for (const TimedLine& line : LinesOf(peer->GetOutput())) {
      lines.emplace_back().points = line.points;
    }
    PrintSpacing("vtkEvenlySpacedStreamlines2D", peer_seconds, lines, *field, cells * cell);
  }
}

}  // namespace
}  // namespace pleinair::content

int main() {
  pleinair::content::CompareStreamTracer();
  pleinair::content::ComparePlacement();
}
