#include "app/bench/shadow_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "app/bench/shadow_metrics.h"
#include "base/atomic_file.h"
#include "export/images/image_writer.h"

namespace pleinair::app {
namespace {

constexpr int kZoom = 3, kColumns = 4, kErrorColumns = 2, kLabelHeight_px = 18, kJpegQuality = 88;
constexpr float kSky = 0.22F;  // Share of the sunlight on a surface that faces the sun.
constexpr std::array<std::array<float, 3>, 4> kTints{
    {{1.0F, 0.45F, 0.4F}, {0.5F, 1.0F, 0.45F}, {0.45F, 0.6F, 1.0F}, {1.0F, 0.95F, 0.4F}}};

std::uint8_t Encode(float linear) {
  const float v = std::clamp(linear, 0.0F, 1.0F);
  const float srgb = v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * srgb));
}

RgbImage Shade(const SurfacePicture& surfaces, const Image<float>& visibility) {
  RgbImage picture(visibility.width(), visibility.height(), 3);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const bool nothing = surfaces.albedo(x, y, 0) + surfaces.albedo(x, y, 1) <= 0.0F;
      const float light = kSky + visibility(x, y) * surfaces.cosine(x, y);
      for (int c = 0; c < 3; ++c) {
        picture(x, y, c) = Encode(nothing ? 0.5F + 0.12F * static_cast<float>(c)
                                          : 1.3F * light * surfaces.albedo(x, y, c));
      }
    }
  }
  return picture;
}

RgbImage ZoomWindow(const RgbImage& picture, const PixelWindow& window) {
  RgbImage zoomed(window.width * kZoom, window.height * kZoom, 3);
  for (int y = 0; y < zoomed.height(); ++y) {
    for (int x = 0; x < zoomed.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        zoomed(x, y, c) = picture(window.x + x / kZoom, window.y + y / kZoom, c);
      }
    }
  }
  return zoomed;
}

void Paste(const RgbImage& tile, int left, int top, RgbImage* sheet) {
  for (int y = 0; y < tile.height(); ++y) {
    for (int x = 0; x < tile.width(); ++x) {
      for (int c = 0; c < 3; ++c) (*sheet)(left + x, top + y, c) = tile(x, y, c);
    }
  }
}

void Label(const std::string& text, int left, int top, RgbImage* sheet) {
  cv::Mat view(sheet->height(), sheet->width(), CV_8UC3, sheet->data());
  cv::putText(view, text, {left + 3, top + kLabelHeight_px - 5}, cv::FONT_HERSHEY_SIMPLEX, 0.45,
              cv::Scalar(20, 20, 20), 1, cv::LINE_AA);
}

Result<void> WriteJpeg(const RgbImage& picture, const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes =
      exports::EncodeJpeg(picture.view(), picture.width(), kJpegQuality);
  return WriteFileAtomically(
      file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

RgbImage MethodSheet(const ShadowBenchPictures& scene) {
  const int tiles = 1 + static_cast<int>(scene.methods.size());
  const int width = scene.window.width * kZoom, height = scene.window.height * kZoom;
  const int rows = (tiles + kColumns - 1) / kColumns;
  RgbImage sheet(kColumns * (width + 2), rows * (height + kLabelHeight_px), 3);
  std::fill_n(sheet.data(), sheet.size(), std::uint8_t{255});
  for (int i = 0; i < tiles; ++i) {
    const auto& visibility =
        i == 0 ? scene.truth.visibility : scene.methods[i - 1].visibility.visibility;
    const std::string name =
        i == 0 ? "truth (rays)" : std::string(shadows::TraitsOf(scene.methods[i - 1].method).name);
    const int left = i % kColumns * (width + 2), top = i / kColumns * (height + kLabelHeight_px);
    Label(name, left, top, &sheet);
    Paste(ZoomWindow(Shade(scene.surfaces, visibility), scene.window), left, top + kLabelHeight_px,
          &sheet);
  }
  return sheet;
}

// White: correct. Red: too light. Blue: too dark. Grey: different surfaces.
RgbImage ErrorPicture(const shadows::VisibilityPicture& result,
                      const shadows::VisibilityPicture& truth) {
  RgbImage picture(truth.visibility.width(), truth.visibility.height(), 3);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float error = result.visibility(x, y) - truth.visibility(x, y);
      const bool compared = IsCompared(result.depth_m(x, y), truth.depth_m(x, y));
      const float minimum = 1.0F - std::min(std::abs(error), 1.0F);
      const float red = error < 0.0F ? minimum : 1.0F, blue = error > 0.0F ? minimum : 1.0F;
      const std::array<float, 3> color{red, minimum, blue};
      for (int c = 0; c < 3; ++c) {
        picture(x, y, c) = static_cast<std::uint8_t>(
            std::lround(255.0F * (compared ? color[static_cast<std::size_t>(c)] : 0.75F)));
      }
    }
  }
  return picture;
}

// Error images of the whole view, side by side.
RgbImage ErrorSheet(const ShadowBenchPictures& scene) {
  const int width = scene.truth.visibility.width(), height = scene.truth.visibility.height();
  const int tiles = static_cast<int>(scene.methods.size());
  const int columns = std::min(tiles, kErrorColumns), rows = (tiles + columns - 1) / columns;
  RgbImage sheet(columns * (width + 2), rows * (height + kLabelHeight_px), 3);
  std::fill_n(sheet.data(), sheet.size(), std::uint8_t{255});
  for (int i = 0; i < tiles; ++i) {
    const int left = i % columns * (width + 2), top = i / columns * (height + kLabelHeight_px);
    Label(std::string(shadows::TraitsOf(scene.methods[i].method).name), left, top, &sheet);
    Paste(ErrorPicture(scene.methods[i].visibility, scene.truth), left, top + kLabelHeight_px,
          &sheet);
  }
  return sheet;
}

RgbImage PartitionsPicture(const ShadowBenchPictures& scene,
                           const ShadowBenchPictures::OfMethod& method) {
  RgbImage picture = Shade(scene.surfaces, method.visibility.visibility);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float partition = method.partitions.visibility(x, y);
      if (method.partitions.depth_m(x, y) <= 0.0F || partition < 0.0F) continue;
      const int low = std::min(static_cast<int>(partition), 3), high = std::min(low + 1, 3);
      const float share = partition - static_cast<float>(low);
      for (int c = 0; c < 3; ++c) {
        const float tint = (1.0F - share) * kTints[low][c] + share * kTints[high][c];
        picture(x, y, c) =
            static_cast<std::uint8_t>(std::lround(tint * static_cast<float>(picture(x, y, c))));
      }
    }
  }
  // Each map in proportion to its texels, with its partition's tint, dark near the sun.
  int left = 4;
  for (std::size_t i = 0; i < method.maps.size(); ++i) {
    const Image<float>& map = method.maps[i];
    const int side = std::max(picture.height() / 3 * map.width() / method.maps[0].width(), 8);
    RgbImage tile(side, side, 3);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const float depth = map(x * map.width() / side, (side - 1 - y) * map.height() / side);
        for (int c = 0; c < 3; ++c) {
          tile(x, y, c) = depth >= 1.0F ? 30 : Encode(kTints[i][c] * (0.1F + 0.9F * depth));
        }
      }
    }
    if (left + side + 4 > picture.width()) break;
    Paste(tile, left, picture.height() - side - 4, &picture);
    left += side + 4;
  }
  return picture;
}

}  // namespace

Result<void> WriteShadowPictures(const ShadowBenchResult& result,
                                 const std::filesystem::path& folder) {
  for (const ShadowBenchPictures& scene : result.pictures) {
    PLEINAIR_RETURN_IF_ERROR(
        WriteJpeg(Shade(scene.surfaces, scene.truth.visibility), folder / (scene.scene + ".jpg")));
    PLEINAIR_RETURN_IF_ERROR(
        WriteJpeg(MethodSheet(scene), folder / (scene.scene + "_methods.jpg")));
    if (!scene.methods.empty()) {
      PLEINAIR_RETURN_IF_ERROR(
          WriteJpeg(ErrorSheet(scene), folder / (scene.scene + "_errors.jpg")));
    }
    for (const auto& method : scene.methods) {
      if (method.maps.size() < 2) continue;
      const std::string name(shadows::TraitsOf(method.method).name);
      PLEINAIR_RETURN_IF_ERROR(WriteJpeg(PartitionsPicture(scene, method),
                                         folder / (scene.scene + "_" + name + "_partitions.jpg")));
    }
  }
  return {};
}

}  // namespace pleinair::app
