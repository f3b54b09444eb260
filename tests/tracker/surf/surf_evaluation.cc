// surf_evaluation PICTURE...: how well keypoints are found again and matched in synthetic warps of
// photographs, and how long that takes, for our SURF and its peers. Prints the tables of
// docs/measurements/surf.md.
//
// Repeatability and matching score after Mikolajczyk et al., "A Comparison of Affine Region
// Detectors", IJCV 65, 2005: regions correspond when the overlap error (1 - intersection / union of
// one region and the other one mapped) is below 40 %, one to one. Repeatability is the number of
// correspondences over the smaller number of regions in the part that both images show; the
// matching score counts those of them whose descriptors are nearest neighbours. A region is a
// circle of half the described window.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/tracker/surf/surf_peers.h"

namespace pleinair::tracker {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kMaxFeatures = 500;
constexpr double kMaxOverlapError = 0.4;

/// A change of the image: a homography and what happens to the pixels after it.
struct Warp {
  std::string group;
  cv::Matx33d homography = cv::Matx33d::eye();
  double blur_px = 0;     ///< sigma
  double noise_grey = 0;  ///< sigma
  double gain = 1;
};

cv::Matx33d AboutMiddle(const cv::Matx33d& h) {
  const double cx = (kWidth - 1) / 2.0;
  const double cy = (kHeight - 1) / 2.0;
  return cv::Matx33d(1, 0, cx, 0, 1, cy, 0, 0, 1) * h * cv::Matx33d(1, 0, -cx, 0, 1, -cy, 0, 0, 1);
}

cv::Matx33d Similarity(double degrees, double zoom) {
  const double c = zoom * std::cos(degrees * std::numbers::pi / 180);
  const double s = zoom * std::sin(degrees * std::numbers::pi / 180);
  return AboutMiddle({c, -s, 0, s, c, 0, 0, 0, 1});
}

/// The image plane tilted about an axis in the image, observed with a focal length of 600 px.
cv::Matx33d Tilt(double degrees, double axis_degrees) {
  const double t = degrees * std::numbers::pi / 180;
  const double f = 600;
  const cv::Matx33d about_y(std::cos(t), 0, 0, 0, 1, 0, -std::sin(t) / f, 0, 1);
  const double a = axis_degrees * std::numbers::pi / 180;
  const cv::Matx33d turn(std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1);
  return AboutMiddle(turn * about_y * turn.t());
}

std::vector<Warp> MakeWarps() {
  std::vector<Warp> warps;
  for (const double degrees : {15.0, 45.0, 100.0, 160.0}) {
    warps.push_back({.group = "rotation", .homography = Similarity(degrees, 1)});
  }
  for (const double zoom : {0.5, 0.7, 1.4, 2.0}) {
    char name[40];
    std::snprintf(name, sizeof name, "scale %.1f", zoom);
    warps.push_back({.group = name, .homography = Similarity(20, zoom)});
  }
  for (const double degrees : {20.0, 30.0, 40.0, 50.0, 60.0}) {
    char name[40];
    std::snprintf(name, sizeof name, "tilt %.0f°", degrees);
    for (const double axis : {0.0, 60.0}) {
      warps.push_back({.group = name, .homography = Tilt(degrees, axis)});
    }
  }
  for (const double sigma : {1.0, 2.0, 3.0}) {
    char name[40];
    std::snprintf(name, sizeof name, "blur %.0f px", sigma);
    warps.push_back({.group = name, .blur_px = sigma});
  }
  for (const double sigma : {5.0, 10.0, 20.0}) {
    char name[40];
    std::snprintf(name, sizeof name, "noise %.0f", sigma);
    warps.push_back({.group = name, .noise_grey = sigma});
  }
  for (const double gain : {0.5, 0.25}) {
    char name[40];
    std::snprintf(name, sizeof name, "brightness %.2f", gain);
    warps.push_back({.group = name, .noise_grey = 1, .gain = gain});
  }
  return warps;
}

cv::Mat Apply(const Warp& warp, const cv::Mat& grey) {
  // Four times as many pixels each way, then their means: no aliasing. Pixel (x, y) of the result
  // is the mean of the fine pixels 4x .. 4x + 3, whose middle is 4x + 1.5.
  constexpr int kFine = 4;
  const cv::Matx33d finer(kFine, 0, (kFine - 1) / 2.0, 0, kFine, (kFine - 1) / 2.0, 0, 0, 1);
  cv::Mat fine;
  cv::warpPerspective(grey, fine, finer * warp.homography, {kWidth * kFine, kHeight * kFine},
                      cv::INTER_CUBIC);
  cv::Mat result;
  cv::resize(fine, result, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  result.convertTo(result, CV_32F, warp.gain);
  if (warp.blur_px > 0) cv::GaussianBlur(result, result, {}, warp.blur_px);
  if (warp.noise_grey > 0) {
    cv::Mat noise(result.size(), CV_32F);
    cv::RNG random(1);
    random.fill(noise, cv::RNG::NORMAL, 0.0, warp.noise_grey);
    result += noise;
  }
  result.convertTo(result, CV_8U);
  return result;
}

cv::Point2d Map(const cv::Matx33d& h, double x, double y) {
  const cv::Vec3d p = h * cv::Vec3d(x, y, 1);
  return {p[0] / p[2], p[1] / p[2]};
}

cv::Matx22d Jacobian(const cv::Matx33d& h, double x, double y) {
  const double w = h(2, 0) * x + h(2, 1) * y + h(2, 2);
  const cv::Point2d p = Map(h, x, y);
  return {(h(0, 0) - p.x * h(2, 0)) / w, (h(0, 1) - p.x * h(2, 1)) / w,
          (h(1, 0) - p.y * h(2, 0)) / w, (h(1, 1) - p.y * h(2, 1)) / w};
}

/// Overlap error of a circle of the first image, mapped, and one of the second, by counting the
/// points of a grid.
double OverlapError(const cv::Point2d& middle, const cv::Matx22d& inverse_jacobian, double radius,
                    const Feature& other) {
  constexpr int kGrid = 40;
  const double reach = 2 * other.radius;  // An error below 40 % lies within.
  int both = 0;
  int either = 0;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const double dx = reach * (2 * (i + 0.5) / kGrid - 1);
      const double dy = reach * (2 * (j + 0.5) / kGrid - 1);
      const bool in_other = dx * dx + dy * dy < other.radius * other.radius;
      const cv::Vec2d back =
          inverse_jacobian * cv::Vec2d(other.x + dx - middle.x, other.y + dy - middle.y);
      const bool in_mapped = back.dot(back) < radius * radius;
      both += in_other && in_mapped;
      either += in_other || in_mapped;
    }
  }
  return 1 - static_cast<double>(both) / std::max(either, 1);
}

bool InImage(const cv::Point2d& p) {
  return p.x >= 0 && p.y >= 0 && p.x <= kWidth - 1 && p.y <= kHeight - 1;
}

std::vector<Feature> Select(const std::vector<Feature>& features, const std::vector<int>& indices) {
  std::vector<Feature> selected;
  selected.reserve(indices.size());
  for (const int i : indices) selected.push_back(features[i]);
  return selected;
}

cv::Mat Select(const cv::Mat& rows, const std::vector<int>& indices) {
  cv::Mat selected;
  for (const int i : indices) selected.push_back(rows.row(i));
  return selected;
}

struct Score {
  double repeatability = 0;
  double matching = 0;
  double correct = 0;  ///< Number of correct matches.
  double turned = 0;   ///< Share of the correct matches whose angle is right within 10 degrees.
};

Score Compare(const FeatureSet& first, const FeatureSet& second, const cv::Matx33d& h) {
  // Only the part that both images show counts.
  std::vector<int> shared_first;
  std::vector<int> shared_second;
  for (std::size_t i = 0; i < first.features.size(); ++i) {
    if (InImage(Map(h, first.features[i].x, first.features[i].y))) {
      shared_first.push_back(static_cast<int>(i));
    }
  }
  const cv::Matx33d back = h.inv();
  for (std::size_t j = 0; j < second.features.size(); ++j) {
    if (InImage(Map(back, second.features[j].x, second.features[j].y))) {
      shared_second.push_back(static_cast<int>(j));
    }
  }
  if (shared_first.empty() || shared_second.empty()) return {};
  const std::vector<Feature> a = Select(first.features, shared_first);
  const std::vector<Feature> b = Select(second.features, shared_second);
  const double smaller = static_cast<double>(std::min(a.size(), b.size()));

  // Correspondences, the best overlaps first, one to one.
  std::vector<std::tuple<double, int, int>> overlaps;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const cv::Point2d middle = Map(h, a[i].x, a[i].y);
    const cv::Matx22d jacobian = Jacobian(h, a[i].x, a[i].y);
    const double zoom = std::sqrt(std::abs(cv::determinant(jacobian)));
    const cv::Matx22d inverse = jacobian.inv();
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double distance = std::hypot(b[j].x - middle.x, b[j].y - middle.y);
      const double ratio = zoom * a[i].radius / b[j].radius;
      if (distance > b[j].radius || ratio < 0.6 || ratio > 1.7) continue;
      const double error = OverlapError(middle, inverse, a[i].radius, b[j]);
      if (error < kMaxOverlapError) {
        overlaps.emplace_back(error, static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
  std::sort(overlaps.begin(), overlaps.end());
  std::vector<bool> a_used(a.size());
  std::vector<bool> b_used(b.size());
  int correspondences = 0;
  cv::Mat_<std::uint8_t> overlapping =
      cv::Mat_<std::uint8_t>::zeros(static_cast<int>(a.size()), static_cast<int>(b.size()));
  for (const auto& [error, i, j] : overlaps) {
    overlapping(i, j) = 1;
    if (a_used[i] || b_used[j]) continue;
    a_used[i] = true;
    b_used[j] = true;
    ++correspondences;
  }

  const cv::Mat descriptors_a = Select(first.descriptors, shared_first);
  const cv::Mat descriptors_b = Select(second.descriptors, shared_second);
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(descriptors_a.type() == CV_8U ? cv::NORM_HAMMING : cv::NORM_L2, true)
      .match(descriptors_a, descriptors_b, matches);
  int correct = 0;
  int turned = 0;
  for (const cv::DMatch& match : matches) {
    if (overlapping(match.queryIdx, match.trainIdx) == 0) continue;
    ++correct;
    const Feature& from = a[match.queryIdx];
    const cv::Vec2d direction =
        Jacobian(h, from.x, from.y) * cv::Vec2d(std::cos(from.angle), std::sin(from.angle));
    const double error = std::remainder(
        std::atan2(direction[1], direction[0]) - b[match.trainIdx].angle, 2 * std::numbers::pi);
    turned += std::abs(error) < std::numbers::pi / 18;
  }
  return {correspondences / smaller, correct / smaller, static_cast<double>(correct),
          correct > 0 ? static_cast<double>(turned) / correct : 0};
}

double Milliseconds() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

int Main(const std::vector<std::string>& files) {
  cv::setNumThreads(1);
  std::vector<cv::Mat> images;
  for (const std::string& file : files) {
    cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
    if (image.empty()) {
      std::fprintf(stderr, "%s: is no picture that OpenCV reads\n", file.c_str());
      return 2;
    }
    cv::resize(image, image, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
    images.push_back(image);
  }
  const std::vector<Peer> peers = MakePeers(kMaxFeatures);

  std::printf("| | ms | features |\n| --- | --- | --- |\n");
  for (const Peer& peer : peers) {
    std::vector<double> times;
    double features = 0;
    for (const cv::Mat& image : images) {
      double fastest = 1e9;
      for (int run = 0; run < 8; ++run) {
        const double start = Milliseconds();
        const std::size_t count = peer.run(image).features.size();
        fastest = std::min(fastest, Milliseconds() - start);
        if (run == 0) features += static_cast<double>(count);
      }
      times.push_back(fastest);
    }
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    std::printf("| %s | %.2f | %.0f |\n", peer.name.c_str(), times[times.size() / 2],
                features / static_cast<double>(images.size()));
  }

  std::vector<std::string> groups;
  std::vector<std::vector<Score>> sums;
  std::vector<int> counts;
  std::vector<std::vector<FeatureSet>> originals(images.size());
  for (std::size_t p = 0; p < images.size(); ++p) {
    for (const Peer& peer : peers) originals[p].push_back(peer.run(images[p]));
  }
  for (const Warp& warp : MakeWarps()) {
    if (groups.empty() || groups.back() != warp.group) {
      groups.push_back(warp.group);
      sums.emplace_back(peers.size());
      counts.push_back(0);
    }
    for (std::size_t p = 0; p < images.size(); ++p) {
      const cv::Mat warped = Apply(warp, images[p]);
      ++counts.back();
      for (std::size_t k = 0; k < peers.size(); ++k) {
        const Score score = Compare(originals[p][k], peers[k].run(warped), warp.homography);
        sums.back()[k].repeatability += score.repeatability;
        sums.back()[k].matching += score.matching;
        sums.back()[k].correct += score.correct;
        sums.back()[k].turned += score.turned;
      }
    }
  }
  std::printf("\nRepeatability / matching score, %% (correct matches; angle right, %%)\n\n|");
  for (const Peer& peer : peers) std::printf(" | %s", peer.name.c_str());
  std::printf(" |\n| ---");
  for (std::size_t k = 0; k < peers.size(); ++k) std::printf(" | ---");
  std::printf(" |\n");
  std::vector<Score> means(peers.size());
  const auto print = [](const Score& score, double per_count) {
    std::printf(" | %.0f / %.0f (%.0f; %.0f)", 100 * score.repeatability * per_count,
                100 * score.matching * per_count, score.correct * per_count,
                100 * score.turned * per_count);
  };
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::printf("| %s", groups[g].c_str());
    for (std::size_t k = 0; k < peers.size(); ++k) {
      const Score& sum = sums[g][k];
      print(sum, 1.0 / counts[g]);
      means[k].repeatability += sum.repeatability / counts[g];
      means[k].matching += sum.matching / counts[g];
      means[k].correct += sum.correct / counts[g];
      means[k].turned += sum.turned / counts[g];
    }
    std::printf(" |\n");
  }
  std::printf("| mean");
  for (const Score& mean : means) print(mean, 1.0 / static_cast<double>(groups.size()));
  std::printf(" |\n");
  return 0;
}

}  // namespace
}  // namespace pleinair::tracker

int main(int argc, char** argv) {
  const std::vector<std::string> files(argv + 1, argv + argc);
  if (files.empty()) {
    std::fprintf(stderr, "usage: surf_evaluation PICTURE...\n");
    return 2;
  }
  return pleinair::tracker::Main(files);
}
