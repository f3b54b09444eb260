#include "app/check/site_findings.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <string>

namespace pleinair::app {
namespace {

using ::testing::HasSubstr;

/// A site without a fault, in ten frames.
SiteFacts GoodSite() {
  SiteFacts facts;
  facts.looked_at = 10;
  facts.marker = "sg_17";
  facts.sun_elevation_deg = 43.0;
  facts.has_objects = true;
  facts.light.emplace();
  facts.light->heading_source = compositor::MeasuredLight::Source::kMeasured;
  facts.light->sun_source = compositor::MeasuredLight::Source::kMeasured;
  facts.light->sun_to_sky_stated = 6.0;
  facts.shadows.casters = 2;
  for (int i = 0; i < 10; ++i) {
    FrameFacts frame;
    frame.index = i;
    frame.edge_px = 100.0;
    frame.blur_px = 0.6;
    frame.white = 0.6;
    frame.focal = FocalRatio{0.001, 0.02};
    facts.frames.push_back(frame);
  }
  return facts;
}

SiteVerdict VerdictOn(const std::string& subject, const std::function<void(SiteFacts*)>& change) {
  SiteFacts facts = GoodSite();
  change(&facts);
  for (const SiteFinding& finding : JudgeSite(facts)) {
    if (finding.subject != subject) continue;
    if (finding.verdict == SiteVerdict::kBad) {
      EXPECT_NE(finding.remedy, "") << finding.text;
    }
    return finding.verdict;
  }
  ADD_FAILURE() << "nothing is said of " << subject;
  return SiteVerdict::kUnknown;
}

void ForAll(SiteFacts* facts, const std::function<void(FrameFacts*)>& change) {
  for (FrameFacts& frame : facts->frames) change(&frame);
}

TEST(JudgeSite, FindsNoFaultWhereThereIsNone) {
  for (const SiteFinding& finding : JudgeSite(GoodSite())) {
    EXPECT_EQ(finding.verdict, SiteVerdict::kGood) << finding.subject << ": " << finding.text;
    EXPECT_EQ(finding.remedy, "");
  }
}

TEST(JudgeSite, WithoutAMarkerNoPictureIsRight) {
  EXPECT_EQ(VerdictOn("marker", [](SiteFacts* site) { site->frames.clear(); }), SiteVerdict::kBad);
  EXPECT_EQ(VerdictOn("marker", [](SiteFacts* site) { site->frames.resize(8); }),
            SiteVerdict::kDoubtful);
}

TEST(JudgeSite, ATrajectoryMakesUpForFramesWithoutTheMarker) {
  const auto along = [](std::int64_t covered, const auto& change) {
    return [covered, change](SiteFacts* site) {
      site->frames.resize(2);
      site->with_pose = covered;
      site->trajectory.emplace();
      session::TrajectorySummary& summary = *site->trajectory->summary;
      summary.frames.by_trajectory = covered;
      summary.alignment.used = 2;
      summary.alignment.chi2_per_dof = 1.0;
      summary.offset.deviation_s = 0.002;
      change(&*site->trajectory);
    };
  };
  const auto as_it_is = [](TrajectoryFit*) {};
  EXPECT_EQ(VerdictOn("trajectory", along(10, as_it_is)), SiteVerdict::kGood);
  EXPECT_EQ(VerdictOn("marker", along(10, as_it_is)), SiteVerdict::kGood);
  EXPECT_EQ(VerdictOn("trajectory", along(8, as_it_is)), SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("marker", along(8, as_it_is)), SiteVerdict::kDoubtful);
  EXPECT_EQ(
      VerdictOn("trajectory",
                along(10, [](TrajectoryFit* fit) { fit->summary->alignment.chi2_per_dof = 20.0; })),
      SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("trajectory",
                      along(10, [](TrajectoryFit* fit) { fit->summary->tilt = Radians(1.5); })),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("trajectory", along(2,
                                          [](TrajectoryFit* fit) {
                                            fit->summary = InputError("f", "lacks poses", "look");
                                          })),
            SiteVerdict::kBad);
  const auto assumed = [](TrajectoryFit* fit) { fit->summary->offset.deviation_s.reset(); };
  EXPECT_EQ(VerdictOn("trajectory", along(10, assumed)), SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("trajectory", along(10,
                                          [&](TrajectoryFit* fit) {
                                            assumed(fit);
                                            fit->summary->offset.is_given = true;
                                          })),
            SiteVerdict::kGood);
  EXPECT_EQ(VerdictOn("trajectory", along(0, [](TrajectoryFit* fit) { fit->has_marker = false; })),
            SiteVerdict::kUnknown);
}

TEST(JudgeSite, SmallAmbiguousAndBlurredMarkersAreNamed) {
  const auto edge = [](double edge_px) {
    return [edge_px](SiteFacts* site) {
      ForAll(site, [edge_px](FrameFacts* frame) { frame->edge_px = edge_px; });
    };
  };
  EXPECT_EQ(VerdictOn("size", edge(12.0)), SiteVerdict::kBad);
  EXPECT_EQ(VerdictOn("size", edge(20.0)), SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("view",
                      [](SiteFacts* site) {
                        ForAll(site, [](FrameFacts* frame) { frame->ambiguity_ratio = 0.5; });
                      }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("blur",
                      [](SiteFacts* site) {
                        ForAll(site, [](FrameFacts* frame) { frame->blur_px = 5.0; });
                      }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("blur",
                      [](SiteFacts* site) {
                        ForAll(site, [](FrameFacts* frame) { frame->blur_px.reset(); });
                      }),
            SiteVerdict::kUnknown);
}

TEST(JudgeSite, ClippedDarkAndDriftingExposureIsNamed) {
  EXPECT_EQ(VerdictOn("exposure",
                      [](SiteFacts* site) {
                        ForAll(site, [](FrameFacts* frame) { frame->clipped_share = 0.9; });
                      }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("exposure",
                      [](SiteFacts* site) {
                        ForAll(site, [](FrameFacts* frame) { frame->white = 0.01; });
                      }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("exposure", [](SiteFacts* site) { site->frames[3].white = 0.4; }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("exposure", [](SiteFacts* site) { site->frames[3].white = 0.5; }),
            SiteVerdict::kGood);
}

TEST(JudgeSite, ZoomsAndOtherLensesAreNamed) {
  EXPECT_EQ(VerdictOn("lens",
                      [](SiteFacts* site) {
                        for (FrameFacts& frame : site->frames) {
                          frame.focal->log_ratio = frame.index % 2 == 0 ? 0.15 : -0.15;
                        }
                      }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("lens",
                      [](SiteFacts* site) {
                        ForAll(site, [](FrameFacts* frame) { frame->focal->log_ratio = 0.2; });
                      }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("lens", [](SiteFacts* site) { site->lens_guess = "assumed: 26 mm"; }),
            SiteVerdict::kDoubtful);
}

TEST(JudgeSite, NightWrongHeadingsAndHiddenObjectsAreNamed) {
  EXPECT_EQ(VerdictOn("sun", [](SiteFacts* site) { site->sun_elevation_deg = -20.0; }),
            SiteVerdict::kBad);
  EXPECT_EQ(VerdictOn("sun", [](SiteFacts* site) { site->sun_elevation_deg = -2.0; }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("heading", [](SiteFacts* site) { site->light->sun_doubtful = true; }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("heading",
                      [](SiteFacts* site) { site->light->heading_offset = FromDegrees(-12.0); }),
            SiteVerdict::kDoubtful);
  EXPECT_EQ(VerdictOn("heading", [](SiteFacts* site) { site->light.reset(); }),
            SiteVerdict::kUnknown);
  EXPECT_EQ(VerdictOn("object", [](SiteFacts* site) { site->placement = {"It is in no view."}; }),
            SiteVerdict::kDoubtful);
}

SiteFinding FindingOn(const std::string& subject, const std::function<void(SiteFacts*)>& change) {
  SiteFacts facts = GoodSite();
  change(&facts);
  for (const SiteFinding& finding : JudgeSite(facts)) {
    if (finding.subject == subject) return finding;
  }
  ADD_FAILURE() << "nothing is said of " << subject;
  return {};
}

TEST(JudgeSite, SaysWhyNoShadowGaveTheHeading) {
  using Source = compositor::MeasuredLight::Source;
  const auto unmeasured = [](int casters, int edges, double with_contrast) {
    return FindingOn("heading", [=](SiteFacts* site) {
      site->light->heading_source = Source::kDescription;
      site->light->sun_source = Source::kDescription;
      site->shadows.casters = casters;
      site->light->evidence.edges = edges;
      site->light->evidence.edges_with_contrast = with_contrast;
    });
  };
  const SiteFinding nothing = unmeasured(0, 0, 0.0), unseen = unmeasured(1, 0, 0.0);
  const SiteFinding few = unmeasured(1, 4, 1.0), missing = unmeasured(1, 20, 0.2);
  EXPECT_THAT(nothing.text, HasSubstr("nothing is described"));
  EXPECT_THAT(unseen.text, HasSubstr("no edge"));
  EXPECT_THAT(few.text, HasSubstr("4 places of their edges are in view, and 6 are needed"));
  EXPECT_THAT(missing.text, HasSubstr("20 places of shadow edges are expected"));
  for (const SiteFinding& finding : {nothing, unseen, few}) {
    EXPECT_EQ(finding.verdict, SiteVerdict::kUnknown) << finding.text;
    EXPECT_THAT(finding.remedy, HasSubstr("compare the object's shadow"));
  }
  EXPECT_EQ(missing.verdict, SiteVerdict::kDoubtful);
  EXPECT_THAT(missing.remedy, HasSubstr("check time, heading"));
}

TEST(JudgeSite, NamesTimeAndHeadingThatFitASunElsewhere) {
  const auto finding = [](compositor::SunElsewhere elsewhere) {
    return FindingOn("heading", [&](SiteFacts* site) {
      site->light->sun_doubtful = true;
      site->light->evidence.sun_elsewhere = elsewhere;
      if (elsewhere.later_s) {
        site->shadows.time_that_fits = *UtcTime::Parse("2025-09-14T11:05:00Z");
      }
    });
  };
  const SiteFinding time = finding({FromDegrees(20.0), -3600.0, true});
  EXPECT_EQ(time.verdict, SiteVerdict::kDoubtful);
  EXPECT_THAT(time.text, HasSubstr("fit a sun elsewhere"));
  EXPECT_THAT(time.remedy, HasSubstr("the time 2025-09-14T11:05Z at this heading fits best, a "
                                     "heading 20 degrees larger at this time fits"));
  const SiteFinding heading = finding({FromDegrees(-90.0), std::nullopt, false});
  EXPECT_THAT(heading.remedy, HasSubstr("; a heading 90 degrees smaller at this time fits"));
}

TEST(JudgeSite, ExpectsNoShadowUnderClouds) {
  const auto overcast = [](SiteFacts* site) {
    site->light->sun_source = compositor::MeasuredLight::Source::kMeasured;
    site->light->heading_source = compositor::MeasuredLight::Source::kDescription;
    site->light->sun_shines = false;
    site->light->sun_to_sky_stated = 0.0;
    site->light->evidence.edges = 13;
    site->light->evidence.edges_agreeing = 13;
    site->light->evidence.edges_with_contrast = 0.0;
  };
  EXPECT_EQ(FindingOn("heading", overcast).verdict, SiteVerdict::kUnknown);
  EXPECT_EQ(FindingOn("heading", overcast).text, "without sunlight no shadow shows it");
  EXPECT_EQ(FindingOn("sky", overcast).verdict, SiteVerdict::kGood);
}

TEST(JudgeSite, ContradictsAWrongSky) {
  using Source = compositor::MeasuredLight::Source;
  const SiteFinding sunny = FindingOn("sky", [](SiteFacts* site) {
    site->light->sun_to_sky_stated = 0.0;
    site->light->evidence.edges_agreeing = 9;
  });
  EXPECT_EQ(sunny.verdict, SiteVerdict::kDoubtful);
  EXPECT_THAT(sunny.text, HasSubstr("9 shadow edges"));
  const SiteFinding overcast = FindingOn("sky", [](SiteFacts* site) {
    site->light->sun_shines = false;
    site->light->evidence.edges = site->light->evidence.edges_agreeing = 12;
  });
  EXPECT_EQ(overcast.verdict, SiteVerdict::kDoubtful);
  EXPECT_THAT(overcast.text, HasSubstr("12 shadow edges checked"));
  EXPECT_THAT(overcast.remedy, HasSubstr("cloudiness = \"overcast\""));
  EXPECT_EQ(
      VerdictOn("sky", [](SiteFacts* site) { site->light->sun_source = Source::kDescription; }),
      SiteVerdict::kUnknown);
  EXPECT_EQ(VerdictOn("sky", [](SiteFacts* site) { site->light->sun_doubtful = true; }),
            SiteVerdict::kUnknown);
  EXPECT_EQ(VerdictOn("sky",
                      [](SiteFacts* site) {
                        site->light->sun_shines = false;
                        site->light->sun_to_sky_stated = 0.0;
                      }),
            SiteVerdict::kGood);
}

}  // namespace
}  // namespace pleinair::app
