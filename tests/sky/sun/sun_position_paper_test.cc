// Measures the effect of each misprint of Kolivand & Sunar 2014, Eqs. 1–4. Each misprint is a
// switch. The reference is the precise sun at random places and times from 1950 to 2100.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>
#include <string>

#include "sky/sun/sun_position.h"

namespace pleinair::sky {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Misprints {
  bool zone_time = false;         // Not a misprint: date and time of the place's zone, not UTC.
  bool full_julian_date = false;  // "Julian date" for the day of the year.
  bool j180 = false;              // Eq. 1: J − 180 for J − 80.
  bool longitude_pi = false;      // Eq. 1: 12/π (SM − L)/π.
  bool longitude_sign = false;    // Eq. 1: SM − L with longitudes counted eastwards.
  bool j8 = false;                // Eq. 2: J − 8 for J − 81.
  bool denominator = false;       // Eq. 4: the minus in the denominator.
  bool numerator = false;         // Eq. 4: the minus in the numerator, which atan2 must not have.
  bool arctangent = false;        // Eq. 4: tan⁻¹ without the quadrant.
};
constexpr Misprints kAsPrinted{.j180 = true,
                               .longitude_pi = true,
                               .j8 = true,
                               .denominator = true,
                               .numerator = true,
                               .arctangent = true};

struct Angles {
  double azimuth, elevation;
};

Angles Paper(const Observer& observer, UtcTime time, const Misprints& m) {
  const double meridian =
      m.zone_time ? std::round(observer.longitude.value() * 12.0 / kPi) * kPi / 12.0 : 0.0;
  const UtcTime::Civil utc = time.PlusSeconds(meridian * 43'200.0 / kPi).ToCivil();
  const std::chrono::year year(utc.year);
  const auto days_since_1970 = [](const std::chrono::year_month_day& date) {
    return std::chrono::sys_days(date).time_since_epoch().count();
  };
  const std::int64_t days = days_since_1970(year / utc.month / utc.day);
  const double hours = utc.hour + utc.minute / 60.0 + utc.second / 3600.0;
  const double day_of_year = static_cast<double>(days - days_since_1970(year / 1 / 1)) + 1.0;
  const double j =
      m.full_julian_date ? 2440587.5 + static_cast<double>(days) + hours / 24.0 : day_of_year;
  const double east = observer.longitude.value() - meridian;
  const double longitude_h = m.longitude_pi     ? 12.0 / kPi * -east / kPi
                             : m.longitude_sign ? -12.0 / kPi * east
                                                : 12.0 / kPi * east;
  const double t = hours + 0.170 * std::sin(4 * kPi * (j - (m.j180 ? 180 : 80)) / 373) -
                   0.129 * std::sin(2 * kPi * (j - 8) / 355) + longitude_h;
  const double d = 0.4093 * std::sin(2 * kPi * (j - (m.j8 ? 8 : 81)) / 368);
  const double l = observer.latitude.value();
  const double h = kPi * t / 12.0;
  const double elevation =
      std::asin(std::sin(l) * std::sin(d) - std::cos(l) * std::cos(d) * std::cos(h));
  const double opposite = (m.numerator ? -1.0 : 1.0) * std::cos(d) * std::sin(h);
  const double adjacent = std::cos(l) * std::sin(d) +
                          (m.denominator ? -1.0 : 1.0) * std::sin(l) * std::cos(d) * std::cos(h);
  return {m.arctangent ? std::atan(opposite / adjacent) : std::atan2(opposite, adjacent),
          elevation};
}

struct Errors {
  double separation_max = 0.0, separation_rms = 0.0;
  double elevation_max = 0.0, elevation_rms = 0.0;  // Sun up.
};

template <typename Model>
Errors Measure(const Model& model) {
  std::mt19937_64 random(20140930);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::int64_t from = UtcTime::Parse("1950-01-01T00:00:00Z")->nanoseconds_since_1970();
  const std::int64_t until = UtcTime::Parse("2101-01-01T00:00:00Z")->nanoseconds_since_1970();
  Errors errors;
  double separation_sum = 0.0, elevation_sum = 0.0;
  constexpr int kPoints = 2500;
  int up = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Observer observer{.latitude = FromDegrees(90.0 * (2.0 * unit(random) - 1.0)),
                            .longitude = Radians((2.0 * unit(random) - 1.0) * kPi)};
    const UtcTime time(from +
                       static_cast<std::int64_t>(unit(random) * static_cast<double>(until - from)));
    const SunPosition truth = ComputeSunPosition(observer, time);
    const Angles angles = model(observer, time);
    const double e1 = truth.elevation.value(), e2 = angles.elevation;
    const double half_e = std::sin(0.5 * (e1 - e2));
    const double half_a = std::sin(0.5 * (truth.azimuth.value() - angles.azimuth));
    const double separation =
        2.0 *
        std::asin(std::min(
            1.0, std::sqrt(half_e * half_e + std::cos(e1) * std::cos(e2) * half_a * half_a))) /
        kRadiansPerDegree;
    errors.separation_max = std::max(errors.separation_max, separation);
    separation_sum += separation * separation;
    if (e1 > 0.0) {
      const double elevation = std::fabs(e1 - e2) / kRadiansPerDegree;
      errors.elevation_max = std::max(errors.elevation_max, elevation);
      elevation_sum += elevation * elevation;
      ++up;
    }
  }
  errors.separation_rms = std::sqrt(separation_sum / kPoints);
  errors.elevation_rms = std::sqrt(elevation_sum / up);
  return errors;
}

Errors MeasureWith(Misprints misprints) {
  misprints.zone_time = true;
  return Measure(
      [&](const Observer& observer, UtcTime time) { return Paper(observer, time, misprints); });
}

class PaperSun : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasPreciseSun()) GTEST_SKIP() << "needs the precise sun to compare with";
  }
};

TEST_F(PaperSun, IsWithin1Point42DegreesAnd0Point39Rms) {
  const Errors errors = Measure([](const Observer& observer, UtcTime time) {
    const SunPosition sun = ComputeSunPosition(observer, time, SunModel::kPaper);
    return Angles{sun.azimuth.value(), sun.elevation.value()};
  });
  EXPECT_NEAR(errors.separation_rms, 0.377, 0.012);  // The date in UTC; see the next test.
  EXPECT_GT(errors.separation_max, 1.1);
  EXPECT_LE(errors.separation_max, 1.43);
  EXPECT_NEAR(errors.elevation_rms, 0.290, 0.012);
  EXPECT_LE(errors.elevation_max, 1.19);
}

// Errors of the paper's text as it is corrected step by step, measured independently.
TEST_F(PaperSun, HasItsKnownErrorsAtEveryStepOfTheCorrection) {
  Misprints m = kAsPrinted;
  const auto expect = [&](double separation_rms, double elevation_rms, const char* step) {
    const Errors errors = MeasureWith(m);
    EXPECT_NEAR(errors.separation_rms / separation_rms, 1.0, 0.04) << step;
    EXPECT_NEAR(errors.elevation_rms / elevation_rms, 1.0, 0.07) << step;
  };
  expect(90.5, 15.4, "as printed");
  m.j8 = false;
  expect(88.5, 4.08, "J - 81");
  m.j180 = false;
  expect(88.6, 3.47, "J - 80");
  m.longitude_pi = false;
  expect(88.4, 0.295, "12 (L - SM) / pi");
  m.arctangent = false;
  expect(122.8, 0.295, "atan2, printed denominator");
  m.denominator = m.numerator = false;
  expect(0.388, 0.295, "all corrections");
}

TEST_F(PaperSun, IsThePapersEquationsWithoutMisprints) {
  const Observer observer{.latitude = FromDegrees(-33.9), .longitude = FromDegrees(18.4)};
  for (int hour = 0; hour < 24 * 365; hour += 7) {
    const UtcTime time = UtcTime::Parse("2025-01-01T00:00:00Z")->PlusSeconds(hour * 3600.0);
    const SunPosition sun = ComputeSunPosition(observer, time, SunModel::kPaper);
    const Angles expected = Paper(observer, time, {});
    EXPECT_NEAR(std::remainder(sun.azimuth.value() - expected.azimuth, 2.0 * kPi), 0.0, 1e-9);
    EXPECT_NEAR(sun.elevation.value(), expected.elevation, 1e-9);
  }
}

TEST_F(PaperSun, NeedsTheDayOfTheYearForItsJulianDate) {
  // The period of 368 days makes the phase of a date of 2.4 million days arbitrary.
  EXPECT_GT(MeasureWith({.full_julian_date = true}).elevation_rms, 15.0);
}

TEST_F(PaperSun, NeedsJMinus80InEquation1) {
  const Errors errors = MeasureWith({.j180 = true});
  EXPECT_GT(errors.elevation_rms, 1.5);
  EXPECT_GT(errors.separation_rms, 5.0 * 0.388);
}

TEST_F(PaperSun, NeedsOnePiLessInEquation1) {
  EXPECT_GT(MeasureWith({.longitude_pi = true}).separation_rms, 4.0);
}

TEST_F(PaperSun, NeedsTheOtherSignForEasternLongitudesInEquation1) {
  EXPECT_GT(MeasureWith({.longitude_sign = true}).separation_rms, 6.0);
}

TEST_F(PaperSun, NeedsJMinus81InEquation2) {
  const Errors errors = MeasureWith({.j8 = true});
  EXPECT_GT(errors.elevation_rms, 10.0);
}

TEST_F(PaperSun, NeedsAPlusInEquation4) {
  const Errors errors = MeasureWith({.denominator = true, .numerator = true});
  EXPECT_NEAR(errors.separation_rms, 122.8, 5.0);
  EXPECT_LE(errors.elevation_max, 1.19);  // Only the azimuth is wrong.
}

TEST_F(PaperSun, NeedsTheQuadrantInEquation4) {
  const Errors errors = MeasureWith({.arctangent = true});
  EXPECT_GT(errors.separation_rms, 60.0);
  EXPECT_LE(errors.elevation_max, 1.19);
}

}  // namespace
}  // namespace pleinair::sky
