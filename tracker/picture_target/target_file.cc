#include "tracker/picture_target/target_file.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "base/little_endian.h"
#include "tracker/picture_target/target_making.h"

namespace pleinair::tracker {
namespace {

constexpr std::string_view kMagic = "PLEINTGT";
constexpr std::size_t kHeader = kMagic.size() + 3 * sizeof(std::uint32_t);
/// A target with the maximum size of image, views and keypoints takes 1.0 MB.
constexpr std::size_t kMaxBytes = 2'000'000;
constexpr double kMaxViewEntry = 1e4, kMinDeterminant = 1e-4;
constexpr float kMaxViewSide_px = 4096.0F, kMinScale = 0.1F, kMaxScale = 1000.0F;
constexpr float kMaxAngle_rad = 4.0F;
constexpr double kBesideTarget =
    1.0;  ///< Maximum distance of a keypoint from the target, in target units.
constexpr double kMaxAspect = 8.0;

constexpr std::size_t kKeypointBytes = 2 + 4 * sizeof(float) + 64;
constexpr std::size_t kViewBytes = 6 * sizeof(double);

bool Within(double value, double least, double most) { return value >= least && value <= most; }

/// Description of a fault in the content; empty if there is none.
using Fault = std::string;

Fault ReadPicture(LittleEndianReader* reader, PictureTarget* target) {
  target->name = reader->Take(reader->Get<std::uint16_t>());
  target->width_m = reader->Get<double>();
  target->height_m = reader->Get<double>();
  const int width = reader->Get<std::uint16_t>(), height = reader->Get<std::uint16_t>();
  if (!reader->complete()) return "it ends before its picture";
  if (!IsTargetName(target->name)) return "its name is empty, too long or no plain UTF-8";
  if (!Within(target->width_m, kMinTargetSize_m, kMaxTargetSize_m) ||
      !Within(target->height_m, kMinTargetSize_m, kMaxTargetSize_m) ||
      !Within(target->width_m / target->height_m, 1.0 / kMaxAspect, kMaxAspect)) {
    return "its printed size is none";
  }
  for (const int side : {width, height}) {
    if (!Within(side, kMinTargetPicture_px, kMaxTargetPicture_px)) {
      return "its picture has sides of " + std::to_string(width) + " and " +
             std::to_string(height) + " pixels";
    }
  }
  const std::string_view pixels = reader->Take(static_cast<std::size_t>(width) * height);
  if (!reader->complete()) return "it ends within its picture";
  target->picture = GreyImage(width, height);
  std::memcpy(target->picture.data(), pixels.data(), pixels.size());
  return {};
}

Fault ReadViews(LittleEndianReader* reader, PictureTarget* target) {
  const int views = reader->Get<std::uint16_t>();
  if (views < 1 || views > kMaxTargetViews || reader->rest().size() < views * kViewBytes) {
    return "it announces " + std::to_string(views) + " views but does not hold them";
  }
  for (int i = 0; i < views; ++i) {
    TargetView view;
    for (double& entry : view.from_target) {
      entry = reader->Get<double>();
      if (!Within(entry, -kMaxViewEntry, kMaxViewEntry)) return "one of its views is none";
    }
    const auto& m = view.from_target;
    // Neither degenerate nor mirrored.
    if (!(m[0] * m[4] - m[1] * m[3] > kMinDeterminant)) return "one of its views is none";
    target->views.push_back(view);
  }
  return {};
}

Fault ReadKeypoints(LittleEndianReader* reader, PictureTarget* target) {
  const std::uint32_t keypoints = reader->Get<std::uint32_t>();
  if (keypoints < 1 || keypoints > kMaxTargetKeypoints ||
      reader->rest().size() < keypoints * kKeypointBytes) {
    return "it announces " + std::to_string(keypoints) + " features but does not hold them";
  }
  Fault fault = "one of its features is none";
  for (std::uint32_t i = 0; i < keypoints; ++i) {
    TargetKeypoint keypoint;
    QuantisedDescriptor descriptor;
    keypoint.view = reader->Get<std::uint8_t>();
    const std::uint8_t bright = reader->Get<std::uint8_t>();
    keypoint.x = reader->Get<float>();
    keypoint.y = reader->Get<float>();
    keypoint.scale = reader->Get<float>();
    keypoint.angle_rad = reader->Get<float>();
    for (std::int8_t& value : descriptor.values) {
      value = reader->Get<std::int8_t>();
      if (value == -128) return fault;
    }
    descriptor.bright = bright == 1;
    if (bright > 1 || keypoint.view >= static_cast<int>(target->views.size()) ||
        !Within(keypoint.x, 0.0, kMaxViewSide_px) || !Within(keypoint.y, 0.0, kMaxViewSide_px) ||
        !Within(keypoint.scale, kMinScale, kMaxScale) ||
        !Within(keypoint.angle_rad, -kMaxAngle_rad, kMaxAngle_rad)) {
      return fault;
    }
    const Vec2 place = PlaceOnTarget(*target, keypoint);
    if (!Within(place.x, -kBesideTarget, kTargetSide + kBesideTarget) ||
        !Within(place.y, -kBesideTarget, kTargetSide + kBesideTarget)) {
      return fault;
    }
    target->keypoints.push_back(keypoint);
    target->descriptors.push_back(descriptor);
  }
  return reader->rest().empty() ? Fault() : "it goes on after its end";
}

constexpr const char* kMakeAgain = "make it again with 'pleinair target PICTURE'";

}  // namespace

std::uint32_t Crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) {
        value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
      }
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc = (crc >> 8U) ^ kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFFU];
  }
  return crc ^ 0xFFFFFFFFU;
}

std::string SerializeTarget(const PictureTarget& target) {
  std::string content;
  PutLittleEndian(static_cast<std::uint16_t>(target.name.size()), &content);
  content += target.name;
  PutLittleEndian(target.width_m, &content);
  PutLittleEndian(target.height_m, &content);
  PutLittleEndian(static_cast<std::uint16_t>(target.picture.width()), &content);
  PutLittleEndian(static_cast<std::uint16_t>(target.picture.height()), &content);
  content.append(reinterpret_cast<const char*>(target.picture.data()), target.picture.size());
  PutLittleEndian(static_cast<std::uint16_t>(target.views.size()), &content);
  for (const TargetView& view : target.views) {
    for (const double entry : view.from_target) PutLittleEndian(entry, &content);
  }
  PutLittleEndian(static_cast<std::uint32_t>(target.keypoints.size()), &content);
  for (std::size_t i = 0; i < target.keypoints.size(); ++i) {
    const TargetKeypoint& keypoint = target.keypoints[i];
    PutLittleEndian(static_cast<std::uint8_t>(keypoint.view), &content);
    PutLittleEndian(static_cast<std::uint8_t>(target.descriptors[i].bright ? 1 : 0), &content);
    for (const float value : {keypoint.x, keypoint.y, keypoint.scale, keypoint.angle_rad}) {
      PutLittleEndian(value, &content);
    }
    for (const std::int8_t value : target.descriptors[i].values) PutLittleEndian(value, &content);
  }
  std::string bytes(kMagic);
  PutLittleEndian(static_cast<std::uint32_t>(kTargetFileVersion), &bytes);
  PutLittleEndian(static_cast<std::uint32_t>(content.size()), &bytes);
  PutLittleEndian(Crc32(content), &bytes);
  return bytes + content;
}

Result<PictureTarget> ParseTarget(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kMagic.size() || bytes.substr(0, kMagic.size()) != kMagic) {
    return InputError(name, "is no target file", kMakeAgain);
  }
  if (bytes.size() < kHeader) return InputError(name, "is cut short", kMakeAgain);
  LittleEndianReader header(bytes.substr(kMagic.size(), kHeader - kMagic.size()));
  const auto version = header.Get<std::uint32_t>();
  if (version != kTargetFileVersion) {
    return InputError(name,
                      "is a target file of version " + std::to_string(version) +
                          "; this program knows version " + std::to_string(kTargetFileVersion),
                      "make it again with this program, or take a newer one");
  }
  const auto length = header.Get<std::uint32_t>();
  const auto checksum = header.Get<std::uint32_t>();
  const std::string_view content = bytes.substr(kHeader);
  if (content.size() < length) {
    return InputError(name,
                      "is cut short: " + std::to_string(content.size()) + " of " +
                          std::to_string(length) + " bytes are there",
                      "copy it again, or " + std::string(kMakeAgain));
  }
  if (content.size() > length || Crc32(content) != checksum) {
    return InputError(name, "is damaged: its checksum is wrong",
                      "copy it again, or " + std::string(kMakeAgain));
  }
  PictureTarget target;
  LittleEndianReader reader(content);
  for (const auto read : {&ReadPicture, &ReadViews, &ReadKeypoints}) {
    const Fault fault = read(&reader, &target);
    if (!fault.empty()) {
      return InputError(name, "is no usable target: " + fault, kMakeAgain);
    }
  }
  return target;
}

Result<void> WriteTargetFile(const PictureTarget& target, const std::filesystem::path& file) {
  return WriteFileAtomically(file, SerializeTarget(target));
}

Result<PictureTarget> ReadTargetFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) {
    return InputError(file.string(), "cannot be read: " + error.message(),
                      "give a file that 'pleinair target' has written");
  }
  if (size > kMaxBytes) {
    return InputError(file.string(), "is too large for a target file", kMakeAgain);
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream || stream.gcount() != static_cast<std::streamsize>(bytes.size())) {
    return InputError(file.string(), "cannot be read", "check that you may read it");
  }
  return ParseTarget(bytes, file.string());
}

}  // namespace pleinair::tracker
