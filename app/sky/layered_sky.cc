#include "app/sky/layered_sky.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sky/clouds/cloud_sky.h"

namespace pleinair::app {

LayeredSky::LayeredSky(std::shared_ptr<const sky::SkySource> source,
                       const std::vector<clouds::CloudLayer>& layers, double ground_albedo,
                       double seconds, std::optional<UtcTime> start)
    : source_(std::move(source)),
      fields_(clouds::MakeFields(layers)),
      ground_albedo_(ground_albedo),
      seconds_(seconds),
      start_(start) {}

std::unique_ptr<sky::SkyModel> LayeredSky::ClearAt(const SkyMoment& moment) const {
  return source_->ForSun(moment.ToSun(), moment.sun_distance_au);
}

std::unique_ptr<sky::SkyModel> LayeredSky::At(const SkyMoment& moment) const {
  if (fields_.empty()) return ClearAt(moment);
  return std::make_unique<clouds::CloudSky>(ClearAt(moment), fields_, ground_albedo_,
                                            SecondsAt(moment));
}

double LayeredSky::SecondsAt(const SkyMoment& moment) const {
  if (!start_ || !moment.time) return seconds_;
  return seconds_ + 1e-9 * static_cast<double>(moment.time->nanoseconds_since_1970() -
                                               start_->nanoseconds_since_1970());
}

std::string LayeredSky::Json(const sky::SkyModel& sky, const SkyMoment& moment) const {
  const auto* cloudy = dynamic_cast<const clouds::CloudSky*>(&sky);
  if (cloudy == nullptr) return {};
  const double rise = std::max(0.0, sky.ToSun().xyz.z);
  const double clear_sun = Luminance(cloudy->clear().SunNormalIrradiance());
  const double clear_sky = Luminance(cloudy->clear().SkyHorizontalIrradiance());
  const clouds::AreaLight& area = cloudy->area();
  std::string json =
      fmt::format(R"(,"sun_transmittance":{:.7g},"clear_sun_normal_lux":{:.7g},)"
                  R"("clear_global_horizontal_lux":{:.7g},"mean_global_horizontal_lux":{:.7g},)"
                  R"("cloud_seconds":{:.10g},"cloud_layers":[)",
                  cloudy->sun_transmittance(), clear_sun, clear_sky + clear_sun * rise,
                  Luminance(area.sun_horizontal + area.sky_horizontal), SecondsAt(moment));
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const clouds::CloudLayer& layer = fields_[i]->layer();
    const clouds::CloudStatistics found = fields_[i]->Statistics(SecondsAt(moment));
    json += fmt::format(
        R"({}{{"kind":"{}","cover":{:.7g},"cover_found":{:.5f},"optical_depth":{:.7g},)"
        R"("optical_depth_found":{:.5g},"base_m":{:.7g},"thickness_m":{:.7g},"cell_m":{:.7g},)"
        R"("wind_m_s":{:.7g},"wind_from_deg":{:.7g},"seed":{},"east_m":{:.7g},"north_m":{:.7g}}})",
        i == 0 ? "" : ",", clouds::NameOf(layer.kind), layer.cover, found.cover,
        layer.optical_depth, found.mean_optical_depth, layer.base_m, layer.thickness_m,
        layer.cell_m, layer.wind_m_s, layer.wind_from_deg, layer.seed, layer.east_m, layer.north_m);
  }
  return json + "]";
}

}  // namespace pleinair::app
