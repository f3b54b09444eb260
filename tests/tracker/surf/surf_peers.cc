#include "tests/tracker/surf/surf_peers.h"

#include <algorithm>
#include <numbers>

#include <opencv2/features2d.hpp>

#include "tracker/surf/surf.h"

#ifdef PLEINAIR_HAVE_DLIB
#include <dlib/image_keypoint.h>
#include <dlib/opencv.h>
#endif

namespace pleinair::tracker {

namespace {

Peer Ours(const std::string& name, const SurfOptions& options) {
  const auto surf = std::make_shared<Surf>(options);
  return {name, [surf, options](const cv::Mat& grey) {
            std::vector<SurfKeypoint> keypoints;
            std::vector<SurfDescriptor> descriptors;
            surf->Detect(
                {grey.data, grey.cols, grey.rows, 1, static_cast<std::ptrdiff_t>(grey.step[0])},
                &keypoints);
            surf->Describe(&keypoints, &descriptors);
            FeatureSet set;
            set.descriptors.create(static_cast<int>(keypoints.size()), 64, CV_32F);
            for (std::size_t i = 0; i < keypoints.size(); ++i) {
              const SurfKeypoint& k = keypoints[i];
              set.features.push_back(
                  {k.x, k.y, k.scale * options.descriptor_window_scales / 2, k.angle_rad});
              std::copy(descriptors[i].begin(), descriptors[i].end(),
                        set.descriptors.ptr<float>(static_cast<int>(i)));
            }
            return set;
          }};
}

/// `radius_per_size`: half the described window, in units of what OpenCV calls the size.
Peer OpenCvs(const std::string& name, const cv::Ptr<cv::Feature2D>& detector,
             double radius_per_size, int max_features) {
  return {name, [=](const cv::Mat& grey) {
            std::vector<cv::KeyPoint> keypoints;
            detector->detect(grey, keypoints);
            cv::KeyPointsFilter::retainBest(keypoints, max_features);
            FeatureSet set;
            detector->compute(grey, keypoints, set.descriptors);
            for (const cv::KeyPoint& k : keypoints) {
              set.features.push_back(
                  {k.pt.x, k.pt.y, k.size * radius_per_size, k.angle * std::numbers::pi / 180});
            }
            return set;
          }};
}

#ifdef PLEINAIR_HAVE_DLIB
Peer DlibsSurf(int max_features) {
  return {"dlib SURF", [=](const cv::Mat& grey) {
            const auto points = dlib::get_surf_points(
                dlib::cv_image<unsigned char>(cvIplImage(grey)), max_features);
            FeatureSet set;
            set.descriptors.create(static_cast<int>(points.size()), 64, CV_32F);
            for (std::size_t i = 0; i < points.size(); ++i) {
              const dlib::surf_point& point = points[i];
              // A window of 20 scales.
              set.features.push_back(
                  {point.p.center.x(), point.p.center.y(), 10 * point.p.scale, point.angle});
              for (int n = 0; n < 64; ++n) {
                set.descriptors.at<float>(static_cast<int>(i), n) =
                    static_cast<float>(point.des(n));
              }
            }
            return set;
          }};
}
#endif

}  // namespace

std::vector<Peer> MakePeers(int max_features) {
  std::vector<Peer> peers;
  // Without buckets: the peers, too, keep the strongest of all.
  peers.push_back(Ours("pleinair", {.max_keypoints = max_features, .bucket_px = 0}));
  peers.push_back(Ours("pleinair, double size",
                       {.max_keypoints = max_features, .double_size = true, .bucket_px = 0}));
  // A cell of SIFT is 3 sigma, the window 4 cells; the size is 2 sigma.
  peers.push_back(OpenCvs("OpenCV SIFT", cv::SIFT::create(max_features), 3, max_features));
  // The size is that of the patch.
  peers.push_back(OpenCvs("OpenCV ORB", cv::ORB::create(max_features), 0.5, max_features));
  // The pattern is 20 sigma wide; the size is 3 sigma.
  peers.push_back(OpenCvs("OpenCV AKAZE", cv::AKAZE::create(), 10.0 / 3, max_features));
#ifdef PLEINAIR_HAVE_DLIB
  peers.push_back(DlibsSurf(max_features));
#endif
  return peers;
}

}  // namespace pleinair::tracker
