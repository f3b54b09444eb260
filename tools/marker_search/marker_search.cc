// Searches for the border of the S-G marker (docs/method/sg-marker.md#border).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>

#include "tools/marker_search/guess_rate.h"
#include "tools/marker_search/layout_image.h"
#include "tools/marker_search/layout_search.h"
#include "tools/marker_search/surroundings.h"
#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::marker_search {
namespace {

struct Options {
  double seconds = 600.0;
  long budget = 0;
  std::uint64_t seed = 1, scene_seed = 2003;
  int views = 32, scenes = 0;
  int number = 17;
  std::string start = "random", svg, layout;
  bool score_only = false;
  float window_scales = tracker::BorderSearchOptions().surf.descriptor_window_scales;
  std::vector<std::string> photographs;
};

constexpr int kTextures = 24;
/// Number of views that no search has used, for the comparison of the last layouts.
constexpr int kFinalViews = 240;
constexpr std::uint64_t kViewsSeed = 7, kFinalSeed = 1009;

void PrintScore(const char* name, const LayoutScore& s) {
  fmt::print(
      "{:<10} {:.4f}  halves {:.3f} mean {:.3f} worst | < 60 px {:.3f}, < 100 {:.3f}, more {:.3f} "
      "| "
      "< 40° {:.3f}, < 60° {:.3f}, more {:.3f}\n"
      "           {:.1f} keypoints, {:.1f} % come back, {:.1f} of them in the worst quadrant, "
      "response {:.4f}; distance to its own {:.3f}, to another place {:.3f}, to textures {:.3f}\n",
      name, s.total, s.average_half, s.worst_half, s.by_size[0], s.by_size[1], s.by_size[2],
      s.by_tilt[0], s.by_tilt[1], s.by_tilt[2], s.keypoints, 100.0 * s.repeatability,
      s.worst_quadrant, s.response, s.own_distance, s.other_distance, s.texture_distance);
}

void PrintRate(const char* name, const GuessRate& r) {
  fmt::print(
      "{:<10} found {:.1f} % of {} half covered (patches {:.1f}) | < 60 px {:.1f}, < 100 {:.1f}, "
      "more "
      "{:.1f} | < 40° {:.1f}, < 60° {:.1f}, more {:.1f}\n",
      name, 100.0 * r.rate, r.scenes, 100.0 * r.by_patches, 100.0 * r.by_size[0],
      100.0 * r.by_size[1], 100.0 * r.by_size[2], 100.0 * r.by_tilt[0], 100.0 * r.by_tilt[1],
      100.0 * r.by_tilt[2]);
}

/// Reads a border from a file of 40 rows of '#' and '.'. Other characters are ignored.
std::optional<BorderLayout> ReadLayout(const std::string& file) {
  std::ifstream in(file);
  std::array<std::string, kEdge> rows;
  std::size_t count = 0;
  for (char c; in.get(c) && count < static_cast<std::size_t>(kEdge) * kEdge;) {
    if (c == '#' || c == '.') rows[count++ / kEdge] += c;
  }
  if (count < static_cast<std::size_t>(kEdge) * kEdge) return std::nullopt;
  tracker::sg::Border border;
  for (int y = 0; y < kEdge; ++y) border[y] = rows[y];
  return BorderLayout::Of(border);
}

int Run(const Options& options) {
  RandomDraws draws(3);
  std::vector<GreyImage> textures = MakeTextures(kTextures, &draws);
  Result<std::vector<GreyImage>> photographs = ReadPhotographs(options.photographs);
  if (!photographs) {
    fmt::print(stderr, "marker_search: {}\n", photographs.error().Message());
    return 2;
  }
  for (GreyImage& photograph : *photographs) textures.push_back(std::move(photograph));

  std::vector<std::pair<std::string, BorderLayout>> compared;
  const auto current = BorderLayout::Of(tracker::sg::kBorder);
  if (!current) fmt::print("The current border breaks the rules for shapes; it is scored only.\n");
  std::optional<BorderLayout> start;
  if (!options.layout.empty()) {
    start = ReadLayout(options.layout);
    if (!start) {
      fmt::print(stderr,
                 "marker_search: {}: holds no layout that keeps the rules for shapes; give 40 "
                 "rows of 40 of # and .\n",
                 options.layout);
      return 2;
    }
    compared.emplace_back("given", *start);
  } else if (options.start == "current") {
    start = current;
  }
  if (!options.score_only) {
    LayoutScorer scorer(textures, options.views, kViewsSeed, options.window_scales);
    LayoutSearchOptions search{options.seed, options.budget, start};
    if (search.budget <= 0) {
      const auto begin = std::chrono::steady_clock::now();
      scorer.Score(tracker::sg::kBorder, options.views);
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
      search.budget = std::lround(options.seconds / spent.count() * options.views);
      fmt::print("{:.0f} s are about --budget {}, which repeats this run.\n", options.seconds,
                 search.budget);
    }
    const auto begin = std::chrono::steady_clock::now();
    auto last = begin;
    const auto found = SearchLayouts(&scorer, search, [&](const std::string& line) {
      const auto now = std::chrono::steady_clock::now();
      if (now - last < std::chrono::seconds(2)) return;
      last = now;
      fmt::print(stderr, "{:5.0f} s  {}\n", std::chrono::duration<double>(now - begin).count(),
                 line);
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      compared.emplace_back(fmt::format("found {}", i + 1), found[i].layout);
    }
  }

  LayoutScorer fresh(textures, kFinalViews, kFinalSeed, options.window_scales);
  fmt::print("Scores on {} other views:\n", kFinalViews);
  PrintScore("current", fresh.Score(tracker::sg::kBorder, kFinalViews));
  const BorderLayout* best = nullptr;
  double best_score = 0.0;
  for (const auto& [name, layout] : compared) {
    const LayoutScore score = fresh.Score(layout.border(), kFinalViews);
    PrintScore(name.c_str(), score);
    if (best == nullptr || score.total > best_score) {
      best = &layout;
      best_score = score.total;
    }
  }
  if (options.scenes > 0) {
    tracker::BorderSearchOptions search{.min_votes = 0.0};  // Every guess counts here.
    search.surf.descriptor_window_scales = options.window_scales;
    PrintRate("current", MeasureGuessRate(tracker::sg::kBorder, textures, options.scenes,
                                          options.scene_seed, search));
    for (const auto& [name, layout] : compared) {
      PrintRate(name.c_str(), MeasureGuessRate(layout.border(), textures, options.scenes,
                                               options.scene_seed, search));
    }
  }
  for (const auto& [name, layout] : compared) {
    fmt::print("{}, {} shapes:\n{}", name, layout.shapes().size(), WriteRows(layout.border()));
  }
  if (!options.svg.empty()) {
    const tracker::sg::Border border = best == nullptr ? tracker::sg::kBorder : best->border();
    std::ofstream out(options.svg);
    out << DrawSvg(
        tracker::SgMarkerPatternOfWord(tracker::CodewordOfNumber(options.number), border));
    if (!out.flush()) {
      fmt::print(stderr, "marker_search: {}: cannot be written\n", options.svg);
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace pleinair::marker_search

int main(int argc, char** argv) try {
  pleinair::marker_search::Options options;
  CLI::App app("Looks for the border of the S-G marker and compares it with the current one.");
  app.add_option("--seconds", options.seconds, "about how long to search; default 600")
      ->check(CLI::PositiveNumber);
  app.add_option("--budget", options.budget, "instead: how many views to score, all in all")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed, "of the search; default 1");
  app.add_option("--views", options.views, "that each layout is scored on; default 32")
      ->check(CLI::Range(8, 1000));
  app.add_option("--start", options.start, "where the search begins; default random")
      ->check(CLI::IsMember({"random", "current"}));
  app.add_option("--layout", options.layout, "file with 40 rows of # and . to begin with");
  app.add_option("--window", options.window_scales,
                 "of descriptors, in scales; default as the detector has it")
      ->check(CLI::PositiveNumber);
  app.add_option("--scenes", options.scenes,
                 "measure how often half covered markers are guessed in so many scenes");
  app.add_option("--scene-seed", options.scene_seed, "of those scenes; default 2003");
  app.add_flag("--score", options.score_only,
               "do not search, score --layout and the current border");
  app.add_option("--svg", options.svg, "picture of the best layout");
  app.add_option("--number", options.number, "that the picture shows; default 17")
      ->check(CLI::Range(0, 4095));
  app.add_option("photographs", options.photographs, "pictures to use as surroundings too");
  CLI11_PARSE(app, argc, argv);
  return pleinair::marker_search::Run(options);
} catch (const std::exception& error) {
  std::fputs("marker_search: ", stderr);
  std::fputs(error.what(), stderr);
  std::fputs("\n", stderr);
  return 1;
}
