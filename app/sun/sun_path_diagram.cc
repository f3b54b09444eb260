#include "app/sun/sun_path_diagram.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sky/sun/sun_events.h"

namespace pleinair::app {
namespace {

constexpr double kWidth = 1000.0;
constexpr double kHeight = 1090.0;
constexpr Vec2 kCentre{500.0, 550.0};
constexpr double kHorizonRadius = 400.0;

constexpr exports::DrawingColor kGrid{205, 210, 215};
constexpr exports::DrawingColor kHorizon{70, 75, 80};
constexpr exports::DrawingColor kQuiet{110, 115, 120};
constexpr exports::DrawingColor kInk{25, 28, 32};
constexpr exports::DrawingColor kHours{214, 150, 40};
constexpr exports::DrawingColor kHourText{150, 95, 10};
constexpr exports::DrawingColor kSun{250, 190, 0};

constexpr int kDayOfArcs = 21;  // Close to the solstices and equinoxes.
constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                 "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

/// From blue in December to red in June.
exports::DrawingColor ColorOfMonth(int month) {
  constexpr std::array<exports::DrawingColor, 7> kRamp = {{{38, 70, 160},
                                                           {40, 110, 175},
                                                           {35, 140, 150},
                                                           {60, 150, 80},
                                                           {170, 150, 30},
                                                           {210, 110, 30},
                                                           {200, 50, 40}}};
  return kRamp[static_cast<std::size_t>(month <= 6 ? month : 12 - month)];
}

struct Sighting {
  Radians azimuth, elevation;
};

/// The projected parts of a sequence of sun positions above the horizon, cut exactly at the
/// horizon.
std::vector<std::vector<Vec2>> VisibleParts(const std::vector<Sighting>& suns) {
  std::vector<std::vector<Vec2>> parts;
  std::vector<Vec2> part;
  for (std::size_t i = 0; i < suns.size(); ++i) {
    const bool up = suns[i].elevation.value() >= 0.0;
    if (i > 0 && up != (suns[i - 1].elevation.value() >= 0.0)) {
      const double a = suns[i - 1].elevation.value(), b = suns[i].elevation.value();
      const double turn =
          std::remainder((suns[i].azimuth - suns[i - 1].azimuth).value(), 2.0 * std::acos(-1.0));
      part.push_back(ProjectOnSunPath(Radians(suns[i - 1].azimuth.value() + turn * a / (a - b)),
                                      Radians(0.0)));
    }
    if (up) {
      part.push_back(ProjectOnSunPath(suns[i].azimuth, suns[i].elevation));
    } else if (!part.empty()) {
      parts.push_back(std::exchange(part, {}));
    }
  }
  if (!part.empty()) parts.push_back(std::move(part));
  return parts;
}

class Diagram {
 public:
  explicit Diagram(const SunPathFacts& facts) : facts_(facts) {
    drawing_.width = kWidth;
    drawing_.height = kHeight;
  }

  exports::VectorDrawing Draw() && {
    DrawGrid();
    DrawHours();
    DrawDays();
    DrawMoment();
    DrawWords();
    return std::move(drawing_);
  }

 private:
  UtcTime LocalMidnight(int month, int day) const {
    const std::chrono::sys_days date(std::chrono::year(facts_.year) / month / day);
    return UtcTime(std::chrono::nanoseconds(date.time_since_epoch()).count())
        .PlusSeconds(-facts_.offset.seconds());
  }

  Sighting Look(UtcTime time) const {
    const sky::SunPosition sun = ComputeSunPosition(facts_.observer, time, facts_.model);
    return {sun.azimuth, sun.elevation_refracted};
  }

  void AddText(Vec2 centre, double size, std::string text, exports::DrawingColor color) {
    drawing_.texts.push_back({centre, size, std::move(text), color});
  }

  void AddCircle(double radius, exports::DrawingColor color, double width) {
    exports::DrawingLine circle{{}, color, width, false};
    for (int degrees = 0; degrees <= 360; degrees += 2) {
      const double a = FromDegrees(degrees).value();
      circle.points.push_back(kCentre + Vec2{std::sin(a), -std::cos(a)} * radius);
    }
    drawing_.lines.push_back(std::move(circle));
  }

  void DrawGrid() {
    for (int degrees = 0; degrees < 360; degrees += 10) {
      const Vec2 rim = ProjectOnSunPath(FromDegrees(degrees), Radians(0.0));
      const Vec2 outwards = (rim - kCentre) * (1.0 / kHorizonRadius);
      const bool named = degrees % 30 == 0;
      const Vec2 inner =
          named ? kCentre : ProjectOnSunPath(FromDegrees(degrees), FromDegrees(10.0));
      drawing_.lines.push_back({{inner, rim}, kGrid, 0.8, false});
      drawing_.lines.push_back({{rim, rim + outwards * 7.0}, kHorizon, 1.2, false});
      if (degrees % 90 == 0) {
        constexpr std::array<const char*, 4> kCompass = {"N", "E", "S", "W"};
        AddText(rim + outwards * 24.0, 26.0, kCompass[static_cast<std::size_t>(degrees / 90)],
                kInk);
      } else {
        AddText(rim + outwards * 19.0, named ? 13.0 : 10.0, std::to_string(degrees), kQuiet);
      }
    }
    for (int degrees = 10; degrees < 90; degrees += 10) {
      const Vec2 ring = ProjectOnSunPath(Radians(0.0), FromDegrees(degrees));
      AddCircle(kCentre.y - ring.y, kGrid, 0.8);
      // On the side without sun paths, if there is one.
      const bool south = facts_.observer.latitude.value() < 0.0;
      const Vec2 label = ProjectOnSunPath(FromDegrees(south ? 180.0 : 0.0), FromDegrees(degrees));
      AddText(label, 11.0, std::to_string(degrees), kQuiet);
    }
    AddCircle(kHorizonRadius, kHorizon, 1.6);
  }

  void DrawDays() {
    constexpr double kStepSeconds = 300.0;
    for (int month = 1; month <= 12; ++month) {
      // From one solar midnight to the next, so that the clock's midnight cuts no path.
      const sky::SunEvents events = sky::ComputeSunEventsNear(
          facts_.observer, LocalMidnight(month, kDayOfArcs).PlusSeconds(43'200.0), facts_.model);
      std::vector<Sighting> suns;
      for (double s = -43'200.0; s <= 43'200.0; s += kStepSeconds) {
        suns.push_back(Look(events.noon.PlusSeconds(s)));
      }
      const bool second_half = month > 6;
      const exports::DrawingColor color = ColorOfMonth(month);
      const bool turning_point = month % 3 == 0;
      const auto parts = VisibleParts(suns);
      for (const std::vector<Vec2>& part : parts) {
        drawing_.lines.push_back({part, color, turning_point ? 2.4 : 1.5, second_half});
      }
      if (!parts.empty()) NameDay(month, parts, color);
    }
  }

  /// At the rim: at sunrise in the first half of the year, at sunset in the second. On the path
  /// itself if the sun does neither.
  void NameDay(int month, const std::vector<std::vector<Vec2>>& parts,
               exports::DrawingColor color) {
    constexpr double kFromRim = 64.0;
    const std::string name = fmt::format("{} {}", kDayOfArcs, kMonths[month - 1]);
    const bool second_half = month > 6;
    const Vec2 end = second_half ? parts.back().back() : parts.front().front();
    const double radius = Norm(end - kCentre);
    if (radius > kHorizonRadius - 1.0) {
      AddText(kCentre + (end - kCentre) * ((kHorizonRadius + kFromRim) / radius), 13.0, name,
              color);
    } else {
      // Separates neighbouring months; outside the names of the hours.
      constexpr double kOutwards = 12.0;
      const std::vector<Vec2>& path = parts.front();
      const int from_winter = second_half ? 13 - month : month;
      const double share = 0.17 + 0.035 * from_winter;
      const Vec2 at = path[static_cast<std::size_t>(static_cast<double>(path.size()) *
                                                    (second_half ? 1.0 - share : share))];
      const Vec2 from_centre = at - kCentre;
      AddText(at + from_centre * (kOutwards / std::max(1.0, Norm(from_centre))), 12.0, name, color);
    }
  }

  void DrawHours() {
    constexpr int kStepDays = 3;
    constexpr double kDaySeconds = 86'400.0;
    for (int hour = 0; hour < 24; ++hour) {
      const auto at_hour = [&](int month, int day) {
        return LocalMidnight(month, day).PlusSeconds(3600.0 * hour);
      };
      // December to June, June to December.
      const UtcTime begin = at_hour(1, 1).PlusSeconds(-10 * kDaySeconds);
      for (const bool second_half : {false, true}) {
        const UtcTime from = second_half ? at_hour(6, kDayOfArcs) : begin;
        const UtcTime until = second_half ? at_hour(12, kDayOfArcs) : at_hour(6, kDayOfArcs);
        std::vector<Sighting> suns;
        for (UtcTime t = from; t < until; t = t.PlusSeconds(kStepDays * kDaySeconds)) {
          suns.push_back(Look(t));
        }
        suns.push_back(Look(until));
        for (std::vector<Vec2>& part : VisibleParts(suns)) {
          drawing_.lines.push_back({std::move(part), kHours, 1.0, second_half});
        }
      }
      NameHour(hour, Look(at_hour(6, kDayOfArcs)), Look(at_hour(12, kDayOfArcs)));
    }
  }

  /// Beyond the end of the figure of eight that is farther from the equator's side, where more
  /// hours are visible.
  void NameHour(int hour, Sighting june, Sighting december) {
    const bool south = facts_.observer.latitude.value() < 0.0;
    const Sighting end = south ? december : june, other = south ? june : december;
    if (end.elevation.value() < FromDegrees(1.0).value()) return;
    const Vec2 at = ProjectOnSunPath(end.azimuth, end.elevation);
    const Vec2 along = at - ProjectOnSunPath(other.azimuth, other.elevation);
    AddText(at + along * (14.0 / std::max(1.0, Norm(along))), 13.0, std::to_string(hour),
            kHourText);
  }

  void DrawMoment() {
    if (!facts_.moment) return;
    const Sighting sun = Look(*facts_.moment);
    if (sun.elevation.value() < 0.0) return;
    const Vec2 at = ProjectOnSunPath(sun.azimuth, sun.elevation);
    drawing_.discs.push_back({at, 10.0, kInk});
    drawing_.discs.push_back({at, 8.5, kSun});
  }

  void DrawWords() {
    const double latitude = ToDegrees(facts_.observer.latitude);
    const double longitude = std::remainder(ToDegrees(facts_.observer.longitude), 360.0);
    const std::string clock = facts_.offset.minutes == 0 ? "UTC" : "UTC" + ToString(facts_.offset);
    drawing_.title = fmt::format("Sun path {:.4f} {}, {:.4f} {}, {}", std::fabs(latitude),
                                 latitude < 0.0 ? "S" : "N", std::fabs(longitude),
                                 longitude < 0.0 ? "W" : "E", facts_.year);
    AddText({kCentre.x, 30.0}, 24.0, drawing_.title, kInk);
    AddText({kCentre.x, 60.0}, 14.0,
            fmt::format("hours of a clock at {}; stereographic, true north up, east right; zenith "
                        "in the centre",
                        clock),
            kQuiet);
    std::string last =
        "solid: December to June; dashed: June to December; rings: elevation in degrees";
    AddText({kCentre.x, kHeight - 40.0}, 14.0, last, kQuiet);
    if (facts_.moment) {
      const Sighting sun = Look(*facts_.moment);
      AddText({kCentre.x, kHeight - 18.0}, 14.0,
              fmt::format("{}: azimuth {:.2f}, elevation {:.2f}{}",
                          FormatLocal(*facts_.moment, facts_.offset), ToDegrees(sun.azimuth),
                          ToDegrees(sun.elevation),
                          sun.elevation.value() < 0.0 ? " (below the horizon)" : " (disc)"),
              kInk);
    }
  }

  const SunPathFacts& facts_;
  exports::VectorDrawing drawing_;
};

}  // namespace

Vec2 ProjectOnSunPath(Radians azimuth, Radians elevation) {
  const double quarter_turn = 0.5 * std::acos(-1.0);
  const double radius = kHorizonRadius * std::tan(0.5 * (quarter_turn - elevation.value()));
  return kCentre + Vec2{std::sin(azimuth.value()), -std::cos(azimuth.value())} * radius;
}

exports::VectorDrawing DrawSunPath(const SunPathFacts& facts) { return Diagram(facts).Draw(); }

}  // namespace pleinair::app
