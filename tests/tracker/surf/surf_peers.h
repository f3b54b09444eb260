#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace pleinair::tracker {

/// A region that some detector found and described.
struct Feature {
  double x, y;    ///< px, integer = centre of a pixel.
  double radius;  ///< Half the edge of the window (or half the diameter) that is described, px.
  double angle;   ///< rad, x right, y down.
};

/// Features of one image; row i of the descriptors (CV_32F, or CV_8U bits) belongs to feature i.
struct FeatureSet {
  std::vector<Feature> features;
  cv::Mat descriptors;
};

/// A detector and descriptor under its name.
struct Peer {
  std::string name;
  std::function<FeatureSet(const cv::Mat& grey)> run;
};

/// Ours, OpenCV's SIFT, ORB and AKAZE, and dlib's SURF where the build found it; each with at most
/// `max_features` features and otherwise the settings that it comes with.
std::vector<Peer> MakePeers(int max_features);

}  // namespace pleinair::tracker
