// Draws docs/images/sky_day.jpg: the dome at each hour of a midsummer day, by the defaults of
// `pleinair sky`.
//
//   day_figure docs/images/sky_day.jpg

#include <cstdio>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "app/sky/sky_exposure.h"
#include "app/sky/sky_moments.h"
#include "app/sky/sky_picture.h"
#include "sky/sky_model.h"

namespace pleinair::sky {
namespace {

constexpr int kDome_px = 200, kCaption_px = 24, kColumns = 6;
// Local hours of 21 June 2025 in Prague, UTC+2; the sun rises at 4:52 and sets at 21:15.
constexpr int kFirstHour = 4, kLastHour = 21, kUtcOffsetHours = 2;
constexpr std::int64_t kMidnightUtc = 1'750'464'000;  // 2025-06-21T00:00:00Z.

int Draw(const std::string& file) {
  const Observer prague{.latitude = FromDegrees(50.0875), .longitude = FromDegrees(14.4213)};
  const auto source = SkySource::Create({SkyModelKind::kAtmosphere, 0}, {});
  if (!source) return 1;
  const int rows = (kLastHour - kFirstHour + kColumns) / kColumns;
  cv::Mat sheet((kDome_px + kCaption_px) * rows, kDome_px * kColumns, CV_8UC3, cv::Scalar::all(0));
  for (int hour = kFirstHour; hour <= kLastHour; ++hour) {
    const UtcTime time((kMidnightUtc + 3600 * (hour - kUtcOffsetHours)) * 1'000'000'000);
    const app::SkyMoment moment = app::MomentAt(prague, time, SunModel::kPrecise);
    const auto sky = (*source)->ForSun(moment.ToSun(), moment.sun_distance_au);
    app::SkyPictureOptions options;
    options.projection = app::SkyProjection::kFisheye;
    options.width_px = kDome_px;
    options.disc = true;
    const app::LightImage light = app::DrawSky(*sky, options);
    const Lux lux(Luminance(sky->SkyHorizontalIrradiance()));
    RgbImage picture = app::ToneMap(light, app::AutomaticExposure(lux));
    const cv::Mat rgb(kDome_px, kDome_px, CV_8UC3, picture.data());
    const int index = hour - kFirstHour;
    const cv::Point corner(index % kColumns * kDome_px,
                           index / kColumns * (kDome_px + kCaption_px));
    cv::cvtColor(rgb, sheet(cv::Rect(corner.x, corner.y, kDome_px, kDome_px)), cv::COLOR_RGB2BGR);
    char caption[48];
    std::snprintf(caption, sizeof caption, "%02d:00  sun %.1f deg", hour,
                  ToDegrees(moment.sun_elevation));
    cv::putText(sheet, caption, corner + cv::Point(36, kDome_px + 16), cv::FONT_HERSHEY_SIMPLEX,
                0.42, cv::Scalar::all(220), 1, cv::LINE_AA);
  }
  return cv::imwrite(file, sheet, {cv::IMWRITE_JPEG_QUALITY, 90}) ? 0 : 1;
}

}  // namespace
}  // namespace pleinair::sky

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: day_figure PICTURE\n");
    return 2;
  }
  return pleinair::app::Draw(argv[1]);
}
