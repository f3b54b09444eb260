#include "app/window/measured_text.h"

#include <gtest/gtest.h>

namespace pleinair::app {
namespace {

using Source = compositor::MeasuredLight::Source;

TEST(MeasuredText, ReportsHowWellSunAndHeadingAreKnown) {
  compositor::MeasuredLight drawn, measured;
  drawn.sun_to_sky = 4.0;
  EXPECT_EQ(MeasuredSunText(drawn, measured), "") << "nothing was measured";
  EXPECT_EQ(MeasuredHeadingText(measured), "");
  measured.sun_source = Source::kMeasured;
  measured.sun_to_sky_error = 0.15;
  measured.evidence.edges_agreeing = 31;
  EXPECT_EQ(MeasuredSunText(drawn, measured),
            "measured: sun 4.0 ± 0.6 times the sky (from 31 edges)");
  measured.sun_source = Source::kShade;
  EXPECT_EQ(MeasuredSunText(drawn, measured),
            "measured: sun 4.0 ± 0.6 times the sky (from the shadows of trees)");
  measured.sun_source = Source::kMarker;
  EXPECT_EQ(MeasuredSunText(drawn, measured),
            "measured: sun 4.0 ± 0.6 times the sky (from a shadow edge on the marker)");
  drawn.sun_shines = false;
  EXPECT_EQ(MeasuredSunText(drawn, measured), "measured: no sun");
  measured.heading_source = Source::kMeasured;
  measured.heading_offset = FromDegrees(-2.96);
  measured.heading_error = FromDegrees(0.12);
  EXPECT_EQ(MeasuredHeadingText(measured), "measured: -2.96° ± 0.12° from the scene's");
}

}  // namespace
}  // namespace pleinair::app
