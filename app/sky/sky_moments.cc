#include "app/sky/sky_moments.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "files/csv.h"

namespace pleinair::app {

Direction<World> SkyMoment::ToSun() const {
  const double horizontal = std::cos(sun_elevation.value());
  return {{horizontal * std::sin(sun_azimuth.value()), horizontal * std::cos(sun_azimuth.value()),
           std::sin(sun_elevation.value())}};
}

SkyMoment MomentAt(const sky::Observer& observer, UtcTime time, sky::SunModel model) {
  const sky::SunPosition sun = ComputeSunPosition(observer, time, model);
  return {time, sun.azimuth, sun.elevation_refracted, sun.distance_au};
}

Result<SkyMoment> ParseSunOption(const std::string& text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const std::string_view view = text;
  // A missing number is as invalid as a text that is no number.
  constexpr double kNone = 1e9;
  const double azimuth = files::ParseNumber(view.substr(0, comma)).value_or(kNone);
  const double elevation =
      files::ParseNumber(view.substr(std::min(comma + 1, view.size()))).value_or(kNone);
  if (std::fabs(azimuth) > 360.0 || std::fabs(elevation) > 90.0) {
    return InputError("--sun", "\"" + text.substr(0, 60) + "\" is not a position of the sun",
                      "write its azimuth (-360 to 360) and elevation (-90 to 90) in degrees, for "
                      "example 180,35");
  }
  SkyMoment moment;
  moment.sun_azimuth = FromDegrees(azimuth < 0.0 ? azimuth + 360.0 : azimuth);
  moment.sun_elevation = FromDegrees(elevation);
  return moment;
}

Result<std::vector<UtcTime>> Moments(UtcTime from, UtcTime until, double step_s) {
  constexpr double kMax = 1e5;
  const double seconds =
      static_cast<double>(until.nanoseconds_since_1970() - from.nanoseconds_since_1970()) * 1e-9;
  if (seconds < 0.0) return InputError("--until", "lies before --time", "exchange the two");
  if (!(step_s > 0.0) || !std::isfinite(step_s)) {
    return InputError("--step", "is not a positive number of seconds", "give for example 300");
  }
  if (seconds / step_s >= kMax) {
    return InputError("--step", "gives more than 100,000 moments", "take a longer step");
  }
  std::vector<UtcTime> moments;
  const auto count = static_cast<std::size_t>(seconds / step_s + 1e-9) + 1;
  moments.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    moments.push_back(from.PlusSeconds(step_s * static_cast<double>(i)));
  }
  return moments;
}

double SkyLight::DiffuseShare() const {
  return GlobalHorizontal() > 0.0 ? sky_horizontal_lx / GlobalHorizontal() : 1.0;
}

SkyLight MeasureSky(const sky::SkyModel& sky, const SkyMoment& moment) {
  SkyLight light;
  light.moment = moment;
  light.sky_horizontal = sky.SkyHorizontalIrradiance();
  light.sun_normal = sky.SunNormalIrradiance();
  light.sky_horizontal_lx = Luminance(light.sky_horizontal);
  light.sun_normal_lx = Luminance(light.sun_normal);
  light.sun_horizontal_lx = light.sun_normal_lx * std::max(0.0, sky.ToSun().xyz.z);
  light.zenith_cd_m2 = sky.At({{0.0, 0.0, 1.0}}).luminance;
  return light;
}

std::string SkyLightJson(const SkyLight& light) {
  const std::string utc =
      light.moment.time ? fmt::format(R"("utc":"{}",)", light.moment.time->ToString()) : "";
  const auto rgb = [](LinearRgb c) { return fmt::format("[{:.7g},{:.7g},{:.7g}]", c.r, c.g, c.b); };
  return utc + fmt::format(R"("sun_azimuth_deg":{:.6f},"sun_elevation_deg":{:.6f},)"
                           R"("sky_horizontal_lux":{:.7g},"sun_normal_lux":{:.7g},)"
                           R"("sun_horizontal_lux":{:.7g},"global_horizontal_lux":{:.7g},)"
                           R"("diffuse_share":{:.5f},"zenith_luminance_cd_m2":{:.7g},)"
                           R"("sky_horizontal_rgb":{},"sun_normal_rgb":{})",
                           ToDegrees(light.moment.sun_azimuth),
                           ToDegrees(light.moment.sun_elevation), light.sky_horizontal_lx,
                           light.sun_normal_lx, light.sun_horizontal_lx, light.GlobalHorizontal(),
                           light.DiffuseShare(), light.zenith_cd_m2, rgb(light.sky_horizontal),
                           rgb(light.sun_normal));
}

std::string SkyLightCsv(const SkyLight& light) {
  return fmt::format("{},{:.6f},{:.6f},{:.7g},{:.7g},{:.7g},{:.7g},{:.5f},{:.7g}\n",
                     light.moment.time ? light.moment.time->ToString() : "",
                     ToDegrees(light.moment.sun_azimuth), ToDegrees(light.moment.sun_elevation),
                     light.sky_horizontal_lx, light.sun_normal_lx, light.sun_horizontal_lx,
                     light.GlobalHorizontal(), light.DiffuseShare(), light.zenith_cd_m2);
}

std::string SkyLightText(const SkyLight& light) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<25}{}\n", name, value);
  };
  if (light.moment.time) line("utc", light.moment.time->ToString());
  line("sun_azimuth_deg", fmt::format("{:.4f}", ToDegrees(light.moment.sun_azimuth)));
  line("sun_elevation_deg", fmt::format("{:.4f}", ToDegrees(light.moment.sun_elevation)));
  line("sky_horizontal_lux", fmt::format("{:.6g}", light.sky_horizontal_lx));
  line("sun_normal_lux", fmt::format("{:.6g}", light.sun_normal_lx));
  line("sun_horizontal_lux", fmt::format("{:.6g}", light.sun_horizontal_lx));
  line("global_horizontal_lux", fmt::format("{:.6g}", light.GlobalHorizontal()));
  line("diffuse_share", fmt::format("{:.3f}", light.DiffuseShare()));
  line("zenith_luminance_cd_m2", fmt::format("{:.6g}", light.zenith_cd_m2));
  return text;
}

}  // namespace pleinair::app
