#include "export/trajectories/colmap_binary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

#include "base/little_endian.h"
#include "export/trajectories/colmap_camera.h"

namespace pleinair::exports {
namespace {

constexpr const char* kWhole = "get a whole copy of it";
/// A 2D point of an image: x, y and the 3D point's id.
constexpr std::size_t kSeenBytes = 2 * sizeof(double) + sizeof(std::uint64_t);
/// An element of a point's track: the image's id and the index in it.
constexpr std::size_t kTrackBytes = 2 * sizeof(std::uint32_t);

/// A file with a count followed by its entries.
class EntryFile {
 public:
  EntryFile(std::string_view bytes, std::string name) : reader(bytes), name_(std::move(name)) {
    count_ = reader.Get<std::uint64_t>();
  }

  /// Advances to the next entry; false after the last.
  bool Next() {
    if (!reader.complete() || entry_ == count_) return false;
    ++entry_;
    return true;
  }

  /// "FILE, entry 3 of 20".
  std::string Where() const { return fmt::format("{}, entry {} of {}", name_, entry_, count_); }

  /// Errors: the file ended before all requested bytes were read.
  Result<void> CheckComplete() const {
    if (reader.complete()) return {};
    return entry_ == 0 ? InputError(name_, "ends within its count of entries", kWhole)
                       : InputError(Where(), "ends before the entry does", kWhole);
  }

  /// Errors: the same, and bytes after the last entry.
  Result<void> CheckEnd() const {
    PLEINAIR_RETURN_IF_ERROR(CheckComplete());
    if (reader.rest().empty()) return {};
    return InputError(
        name_,
        fmt::format("has {} bytes behind the {} entries it promises", reader.rest().size(), count_),
        kWhole);
  }

  /// Skips an unused list with its count.
  void SkipList(std::size_t item_bytes) {
    const auto count = reader.Get<std::uint64_t>();
    const bool fits = count <= reader.rest().size() / item_bytes;
    reader.Take(fits ? count * item_bytes : std::string_view::npos);
  }

  LittleEndianReader reader;

 private:
  std::string name_;
  std::uint64_t count_ = 0, entry_ = 0;
};

Vec3 GetVector(LittleEndianReader* reader) {
  Vec3 v;
  for (double* component : {&v.x, &v.y, &v.z}) *component = reader->Get<double>();
  return v;
}

Result<std::map<std::int64_t, CameraModel>> ParseCameras(std::string_view bytes,
                                                         const std::string& name) {
  std::map<std::int64_t, CameraModel> cameras;
  EntryFile file(bytes, name);
  while (file.Next()) {
    const auto id = file.reader.Get<std::uint32_t>();
    ColmapCamera camera;
    camera.model = ColmapModelName(file.reader.Get<std::int32_t>());
    camera.width = file.reader.Get<std::int64_t>();
    camera.height = file.reader.Get<std::int64_t>();
    for (std::size_t i = 0; i < ColmapParameterCount(camera.model); ++i) {
      camera.parameters.push_back(file.reader.Get<double>());
    }
    PLEINAIR_RETURN_IF_ERROR(file.CheckComplete());
    PLEINAIR_ASSIGN_OR_RETURN(const CameraModel model, CameraFromColmap(camera, file.Where()));
    if (!cameras.emplace(id, model).second) {
      return InputError(file.Where(), "has the number of another camera", kWhole);
    }
  }
  PLEINAIR_RETURN_IF_ERROR(file.CheckEnd());
  return cameras;
}

/// Reads a name that ends with a zero byte. Without that byte the file is incomplete.
std::string_view GetName(LittleEndianReader* reader) {
  const std::size_t length = reader->rest().find('\0');
  const std::string_view name = reader->Take(length);
  reader->Take(1);
  return name;
}

bool IsPrintable(std::string_view name) {
  return !name.empty() && std::none_of(name.begin(), name.end(),
                                       [](unsigned char c) { return c < ' ' || c == 127; });
}

Result<std::vector<ColmapPicture>> ParseImages(std::string_view bytes, const std::string& name) {
  std::vector<ColmapPicture> pictures;
  EntryFile file(bytes, name);
  while (file.Next()) {
    ColmapPicture picture;
    picture.where = file.Where();
    file.reader.Get<std::uint32_t>();  // Its id.
    Quaternion turn;
    for (double* component : {&turn.w, &turn.x, &turn.y, &turn.z}) {
      *component = file.reader.Get<double>();
    }
    const Vec3 shift = GetVector(&file.reader);
    picture.camera_id = file.reader.Get<std::uint32_t>();
    picture.name = GetName(&file.reader);
    file.SkipList(kSeenBytes);
    PLEINAIR_RETURN_IF_ERROR(file.CheckComplete());
    PLEINAIR_ASSIGN_OR_RETURN(picture.camera_from_reference,
                              (PoseFromFile<Camera, Reference>(picture.where, shift, turn)));
    if (!IsPrintable(picture.name)) {
      return InputError(picture.where, "has an image's name that is empty or not printable",
                        kWhole);
    }
    pictures.push_back(std::move(picture));
  }
  PLEINAIR_RETURN_IF_ERROR(file.CheckEnd());
  return pictures;
}

Result<std::vector<TrajectoryPoint>> ParsePoints(std::string_view bytes, const std::string& name) {
  std::vector<TrajectoryPoint> points;
  EntryFile file(bytes, name);
  while (file.Next()) {
    file.reader.Get<std::uint64_t>();  // Its id.
    TrajectoryPoint point;
    point.place.xyz = GetVector(&file.reader);
    for (std::uint8_t& code : point.rgb) code = file.reader.Get<std::uint8_t>();
    point.error_px = file.reader.Get<double>();
    file.SkipList(kTrackBytes);
    PLEINAIR_RETURN_IF_ERROR(file.CheckComplete());
    PLEINAIR_RETURN_IF_ERROR(CheckPose(file.Where(), point.place.xyz, Quaternion{}));
    if (!std::isfinite(point.error_px)) {
      return InputError(file.Where(), "has an error that is not finite", kWhole);
    }
    points.push_back(point);
  }
  PLEINAIR_RETURN_IF_ERROR(file.CheckEnd());
  return points;
}

void PutAll(std::initializer_list<double> numbers, std::string* bytes) {
  for (const double number : numbers) PutLittleEndian(number, bytes);
}

}  // namespace

Result<ColmapModel> ParseColmapBinary(const ColmapFiles& files, const std::string& folder) {
  const auto in_folder = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  ColmapModel model;
  model.images_file = in_folder("images.bin");
  PLEINAIR_ASSIGN_OR_RETURN(model.cameras, ParseCameras(files.cameras, in_folder("cameras.bin")));
  PLEINAIR_ASSIGN_OR_RETURN(model.pictures, ParseImages(files.images, model.images_file));
  if (!files.points3d.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(model.points, ParsePoints(files.points3d, in_folder("points3D.bin")));
  }
  return model;
}

ColmapFiles ColmapBinary(const ColmapModel& model) {
  ColmapFiles files;
  PutLittleEndian(std::uint64_t{model.cameras.size()}, &files.cameras);
  for (const auto& [id, lens] : model.cameras) {
    const ColmapCamera camera = ColmapFromCamera(lens);
    PutLittleEndian(static_cast<std::uint32_t>(id), &files.cameras);
    PutLittleEndian(std::int32_t{ColmapModelId(camera.model)}, &files.cameras);
    PutLittleEndian(camera.width, &files.cameras);
    PutLittleEndian(camera.height, &files.cameras);
    for (const double parameter : camera.parameters) PutLittleEndian(parameter, &files.cameras);
  }
  constexpr std::uint64_t kNone = 0;  // No 2D points of an image, no track of a point.
  PutLittleEndian(std::uint64_t{model.pictures.size()}, &files.images);
  std::uint32_t number = 0;
  for (const ColmapPicture& picture : model.pictures) {
    PutLittleEndian(++number, &files.images);
    const Quaternion q = QuaternionOf(picture.camera_from_reference.rotation);
    const Vec3 t = picture.camera_from_reference.translation_m;
    PutAll({q.w, q.x, q.y, q.z, t.x, t.y, t.z}, &files.images);
    PutLittleEndian(static_cast<std::uint32_t>(picture.camera_id), &files.images);
    files.images += picture.name;
    files.images += '\0';
    PutLittleEndian(kNone, &files.images);
  }
  PutLittleEndian(std::uint64_t{model.points.size()}, &files.points3d);
  std::uint64_t point_number = 0;
  for (const TrajectoryPoint& point : model.points) {
    PutLittleEndian(++point_number, &files.points3d);
    PutAll({point.place.xyz.x, point.place.xyz.y, point.place.xyz.z}, &files.points3d);
    for (const std::uint8_t code : point.rgb) PutLittleEndian(code, &files.points3d);
    PutLittleEndian(point.error_px, &files.points3d);
    PutLittleEndian(kNone, &files.points3d);
  }
  return files;
}

}  // namespace pleinair::exports
