#include "app/check/site_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "app/check/shadow_findings.h"
#include "app/check/trajectory_finding.h"
#include "base/units.h"
#include "tracker/observation.h"

namespace pleinair::app {
namespace {

using Verdict = SiteVerdict;

// Markers below 16 px are often missed; from 28 px on their tilt is certain (docs/guide/print.md).
constexpr double kMissed_px = 16.0, kCertain_px = 28.0;
// Motion blur over a tenth of the marker has a standard deviation of 0.1 / sqrt(12) of it. Twice as
// much prevents detection (docs/guide/film.md).
constexpr double kBlurred = 0.03;
// As in the warnings of replay.
constexpr double kExposureChange = 1.3;

double MedianBy(const std::vector<FrameFacts>& frames, double FrameFacts::*member) {
  std::vector<double> values(frames.size());
  std::transform(frames.begin(), frames.end(), values.begin(),
                 [member](const FrameFacts& frame) { return frame.*member; });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Is>
int CountOf(const std::vector<FrameFacts>& frames, const Is& is) {
  return static_cast<int>(std::count_if(frames.begin(), frames.end(), is));
}

SiteFinding MarkerFinding(const SiteFacts& facts) {
  const auto seen = static_cast<std::int64_t>(facts.frames.size());
  SiteFinding finding{"marker", Verdict::kGood,
                      fmt::format("{} in {} of {} frames", facts.marker, seen, facts.looked_at),
                      ""};
  if (facts.with_pose > seen) {
    finding.text += fmt::format("; the camera's pose is known in {}", facts.with_pose);
  }
  if (seen == 0 && facts.with_pose > 0) {
    finding.verdict = Verdict::kUnknown;
    finding.text = fmt::format("seen in none of {} frames", facts.looked_at);
    finding.remedy = "without it the exposure is a guess: set exposure_gain";
  } else if (seen == 0) {
    finding.verdict = Verdict::kBad;
    finding.text = fmt::format("seen in none of {} frames", facts.looked_at);
    finding.remedy =
        "film it sharp, flat, whole and in the open; check family and id in the scene "
        "(docs/guide/troubleshoot.md)";
  } else if (10 * std::max(seen, facts.with_pose) < 9 * facts.looked_at) {
    finding.verdict = Verdict::kDoubtful;
    finding.remedy = "keep it in view: the object is missing from frames without it";
  }
  return finding;
}

SiteFinding SizeFinding(const SiteFacts& facts) {
  const auto [least, most] = std::minmax_element(
      facts.frames.begin(), facts.frames.end(),
      [](const FrameFacts& a, const FrameFacts& b) { return a.edge_px < b.edge_px; });
  const double median_px = MedianBy(facts.frames, &FrameFacts::edge_px);
  SiteFinding finding{"size", Verdict::kGood,
                      fmt::format("the marker is {:.0f} to {:.0f} pixels large, usually {:.0f}",
                                  least->edge_px, most->edge_px, median_px),
                      ""};
  if (median_px >= kCertain_px) return finding;
  finding.verdict = median_px < kMissed_px ? Verdict::kBad : Verdict::kDoubtful;
  finding.remedy = "go nearer, or print a larger marker: 28 pixels and more";
  return finding;
}

SiteFinding ViewFinding(const SiteFacts& facts) {
  const int ambiguous = CountOf(facts.frames, [](const FrameFacts& frame) {
    return frame.ambiguity_ratio > tracker::kCertainRatio;
  });
  SiteFinding finding{"view", Verdict::kGood, "the tilt of the marker is certain", ""};
  if (ambiguous == 0) return finding;
  finding.text = fmt::format("the tilt of the marker is uncertain in {} frames", ambiguous);
  if (4 * ambiguous < static_cast<int>(facts.frames.size())) return finding;
  finding.verdict = Verdict::kDoubtful;
  finding.remedy = "film from the side rather than from straight above, and nearer";
  return finding;
}

SiteFinding BlurFinding(const SiteFacts& facts) {
  int measured = 0, blurred = 0;
  double worst_px = 0.0;
  for (const FrameFacts& frame : facts.frames) {
    if (!frame.blur_px) continue;
    ++measured;
    worst_px = std::max(worst_px, *frame.blur_px);
    blurred += *frame.blur_px > kBlurred * frame.edge_px ? 1 : 0;
  }
  if (measured == 0) {
    return {"blur", Verdict::kUnknown, "the edges of the marker show it in no frame", ""};
  }
  SiteFinding finding{"blur", Verdict::kGood,
                      fmt::format("{} of {} frames are blurred; at worst {:.1f} pixels", blurred,
                                  measured, worst_px),
                      ""};
  if (4 * blurred <= measured) return finding;
  finding.verdict = Verdict::kDoubtful;
  finding.remedy = "lock the focus, move more slowly, and use a shorter exposure";
  return finding;
}

SiteFinding ExposureFinding(const SiteFacts& facts) {
  constexpr double kHalf = 0.5, kDark = 0.05;
  std::vector<double> white;
  int clipped = 0, dark = 0, measured = 0;
  for (const FrameFacts& frame : facts.frames) {
    if (!frame.white) continue;
    ++measured;
    clipped += frame.clipped_share > kHalf ? 1 : 0;
    dark += *frame.white < kDark ? 1 : 0;
    if (frame.clipped_share <= kHalf) white.push_back(*frame.white);
  }
  if (measured == 0) {
    return {"exposure", Verdict::kUnknown, "the white margin of the marker is not in view", ""};
  }
  if (2 * clipped > measured) {
    return {"exposure", Verdict::kDoubtful,
            fmt::format("the white of the marker is clipped in {} of {} frames", clipped, measured),
            "expose less, until the white of the marker is no longer burnt out"};
  }
  if (2 * dark > measured) {
    return {"exposure", Verdict::kDoubtful,
            fmt::format("the white of the marker is dark in {} of {} frames", dark, measured),
            "expose longer, and put the marker where the object will stand, not in shade"};
  }
  const auto [least, most] = std::minmax_element(white.begin(), white.end());
  const double change = *least > 0.0 ? *most / *least : 1.0;
  SiteFinding finding{"exposure", Verdict::kGood,
                      fmt::format("the white of the marker changes by a factor of {:.2f}", change),
                      ""};
  if (change <= kExposureChange) return finding;
  finding.verdict = Verdict::kDoubtful;
  finding.remedy = "lock exposure and white balance; keep your shadow and clouds' off the marker";
  return finding;
}

SiteFinding LensFinding(const SiteFacts& facts) {
  // A wrong focal length of 5 % shifts the horizon of an object at the edge of the image visibly.
  constexpr double kNoticeable = 0.05, kNoticeableWander = 0.02, kSurely = 4.0, kDeviations = 3.0;
  std::vector<FocalRatio> ratios;
  for (const FrameFacts& frame : facts.frames) {
    if (frame.focal) ratios.push_back(*frame.focal);
  }
  const auto focal = CombineFocalRatios(ratios);
  if (focal && focal->wander_chi2 > kSurely && focal->wander > kNoticeableWander) {
    return {"lens", Verdict::kDoubtful,
            fmt::format("the focal length wanders by {:.0f} % from frame to frame",
                        100 * focal->wander),
            "do not zoom, lock the focus, and switch the stabilisation off; film again"};
  }
  const double off = focal ? std::log(focal->ratio) : 0.0;
  if (focal && std::abs(off) > std::max(kNoticeable, kDeviations * focal->error)) {
    return {"lens", Verdict::kDoubtful,
            fmt::format("the frames show a focal length {:.0f} % {} than the calibration's",
                        100 * std::abs(std::expm1(off)), off > 0 ? "longer" : "shorter"),
            "calibrate the lens at this size and zoom (docs/guide/calibrate.md)"};
  }
  if (!facts.lens_guess.empty()) {
    return {"lens", Verdict::kDoubtful, "a guess: " + facts.lens_guess,
            "calibrate the lens (docs/guide/calibrate.md), and give it with --calibration"};
  }
  if (!focal) {
    return {"lens", Verdict::kUnknown, "the views are too alike to show the focal length", ""};
  }
  return {"lens", Verdict::kGood,
          fmt::format("the frames agree with the focal length within {:.0f} %",
                      std::max(1.0, 100 * std::max(std::abs(off), 2 * focal->error))),
          ""};
}

SiteFinding SunFinding(const SiteFacts& facts) {
  constexpr double kNight_deg = -6.0, kLow_deg = 3.0;
  SiteFinding finding{"sun", Verdict::kGood,
                      fmt::format("{:.1f} degrees above the horizon", facts.sun_elevation_deg), ""};
  if (facts.sun_elevation_deg >= kLow_deg) return finding;
  finding.verdict = facts.sun_elevation_deg < kNight_deg ? Verdict::kBad : Verdict::kDoubtful;
  if (facts.sun_elevation_deg < 0.0) {
    finding.text = fmt::format("{:.1f} degrees below the horizon", -facts.sun_elevation_deg);
  }
  finding.remedy = "check the time with its offset from UTC, and the place in the scene";
  return finding;
}

void AddObjectFindings(const SiteFacts& facts, std::vector<SiteFinding>* findings) {
  if (!facts.has_objects) {
    findings->push_back({"object", Verdict::kUnknown, "the scene has no object",
                         "add [[object]] (docs/guide/describe.md)"});
    return;
  }
  if (facts.frames.empty() && facts.with_pose == 0) return;
  for (const std::string& sentence : facts.placement) {
    findings->push_back({"object", Verdict::kDoubtful, sentence, ""});
  }
  if (facts.placement.empty()) findings->push_back({"object", Verdict::kGood, "in view", ""});
}

}  // namespace

const char* VerdictText(SiteVerdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return "good";
    case Verdict::kDoubtful:
      return "doubtful";
    case Verdict::kBad:
      return "bad";
    case Verdict::kUnknown:
      return "not checked";
  }
  return "not checked";
}

std::vector<SiteFinding> JudgeSite(const SiteFacts& facts) {
  std::vector<SiteFinding> findings;
  for (const std::string& lost : facts.damage) {
    findings.push_back({"frames", Verdict::kDoubtful, lost, ""});
  }
  findings.push_back(MarkerFinding(facts));
  if (facts.trajectory) {
    findings.push_back(TrajectoryFinding(*facts.trajectory, facts.looked_at));
  }
  if (!facts.frames.empty()) {
    findings.push_back(SizeFinding(facts));
    findings.push_back(ViewFinding(facts));
    findings.push_back(BlurFinding(facts));
    findings.push_back(ExposureFinding(facts));
    findings.push_back(LensFinding(facts));
  }
  findings.push_back(SunFinding(facts));
  findings.push_back(HeadingFinding(facts));
  findings.push_back(SkyFinding(facts));
  AddObjectFindings(facts, &findings);
  return findings;
}

}  // namespace pleinair::app
