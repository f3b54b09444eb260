// Draws docs/images/sky_illuminance.svg: the light of sun and sky over a day by the models and by
// IES.
//
//   illuminance_figure > docs/images/sky_illuminance.svg

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sky/sky_model.h"
#include "sky/standard_illuminance.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {
namespace {

/// Result of a model at one time.
struct Light {
  double sun_klx = 0.0, sky_klx = 0.0, share = 0.0;
};

Light Of(double sun_lux, double sky_lux, double up) {
  const double global = sky_lux + sun_lux * std::max(0.0, up);
  return {sun_lux * 1e-3, sky_lux * 1e-3, sky_lux / global};
}

struct Curve {
  const char* name;
  const char* style;
  std::vector<Light> lights;
};

constexpr double kWidth = 720.0, kHeight = 190.0, kLeft = 60.0;
// A clear day in June at 50.0875° N, 14.4213° E (Prague), UTC.
constexpr double kFirstHour = 2.5, kLastHour = 19.75, kStepHours = 1.0 / 12.0;

double X(double hour) { return kLeft + kWidth * (hour - kFirstHour) / (kLastHour - kFirstHour); }

void DrawPanel(double top, const char* title, double highest, double tick,
               const std::vector<Curve>& curves, const std::function<double(const Light&)>& value) {
  std::printf("<text x=\"%g\" y=\"%g\">%s</text>\n", kLeft, top - 8.0, title);
  for (int i = 0; i <= std::lround(highest / tick); ++i) {
    const double v = tick * i;
    const double y = top + kHeight * (1.0 - v / highest);
    std::printf(
        "<path d=\"M%g %.1fh%g\" stroke=\"#ddd\"/>"
        "<text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n",
        kLeft, y, kWidth, kLeft - 6.0, y + 4.0, v);
  }
  for (int hour = 3; hour <= 19; hour += 2) {
    std::printf("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%d</text>\n", X(hour),
                top + kHeight + 16.0, hour);
  }
  for (const Curve& curve : curves) {
    std::string path;
    for (std::size_t i = 0; i < curve.lights.size(); ++i) {
      const double v = std::min(value(curve.lights[i]), highest * 1.02);
      char point[48];
      std::snprintf(point, sizeof point, "%c%.1f %.1f", i == 0 ? 'M' : 'L',
                    X(kFirstHour + kStepHours * static_cast<double>(i)),
                    top + kHeight * (1.0 - v / highest));
      path += point;
    }
    std::printf("<path d=\"%s\" fill=\"none\" %s/>\n", path.c_str(), curve.style);
  }
}

int Draw() {
  const Observer prague{.latitude = FromDegrees(50.0875), .longitude = FromDegrees(14.4213)};
  const auto atmosphere = SkySource::Create({SkyModelKind::kAtmosphere, 0}, {});
  const auto perez = SkySource::Create({SkyModelKind::kPerez, 0}, {});
  if (!atmosphere || !perez) return 1;
  std::vector<Curve> curves = {{"IES RP-21, clear", "stroke=\"#000\" stroke-dasharray=\"6 4\"", {}},
                               {"perez", "stroke=\"#c60\" stroke-width=\"1.5\"", {}},
                               {"atmosphere", "stroke=\"#06c\" stroke-width=\"2\"", {}}};
  // 2025-06-21T00:00:00Z.
  constexpr std::int64_t kMidnight = 1'750'464'000;
  for (int step = 0; kFirstHour + step * kStepHours < kLastHour; ++step) {
    const double hour = kFirstHour + step * kStepHours;
    const UtcTime time((kMidnight + std::llround(hour * 3600.0)) * 1'000'000'000);
    const SunPosition sun = ComputeSunPosition(prague, time);
    const double up = sun.ToSun().xyz.z;
    const StandardIlluminance ies =
        ComputeStandardIlluminance(SkyCondition::kClear, sun.elevation_refracted, sun.distance_au);
    curves[0].lights.push_back(Of(ies.sun_normal.value(), ies.sky_horizontal.value(), up));
    for (int i = 0; i < 2; ++i) {
      const auto sky = (i == 0 ? *perez : *atmosphere)->ForSun(sun.ToSun(), sun.distance_au);
      curves[i + 1].lights.push_back(
          Of(Luminance(sky->SunNormalIrradiance()), Luminance(sky->SkyHorizontalIrradiance()), up));
    }
  }
  std::printf(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 800\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"800\" height=\"800\" fill=\"#fff\"/>\n");
  double x = kLeft;
  for (const Curve& curve : curves) {
    std::printf("<path d=\"M%g 18h30\" %s/><text x=\"%g\" y=\"22\">%s</text>\n", x, curve.style,
                x + 36.0, curve.name);
    x += 170.0;
  }
  DrawPanel(60.0, "Sun on a surface facing it, klx", 120.0, 20.0, curves,
            [](const Light& light) { return light.sun_klx; });
  DrawPanel(310.0, "Sky on level ground, klx", 30.0, 5.0, curves,
            [](const Light& light) { return light.sky_klx; });
  DrawPanel(560.0, "Share of the sky in the light on level ground", 1.0, 0.2, curves,
            [](const Light& light) { return light.share; });
  std::printf(
      "<text x=\"%g\" y=\"792\">Hour UTC, 2025-06-21, 50.0875° N 14.4213° E; default "
      "turbidities</text>\n</svg>\n",
      kLeft);
  return 0;
}

}  // namespace
}  // namespace pleinair::sky

int main() { return pleinair::sky::Draw(); }
