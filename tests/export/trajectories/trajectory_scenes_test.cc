#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "export/trajectories/gltf_trajectory.h"
#include "export/trajectories/mcap_trajectory.h"
#include "export/trajectories/mcap_writer.h"

namespace pleinair::exports {
namespace {

using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

template <typename T>
T NumberAt(std::string_view bytes, std::size_t at) {
  T value{};
  EXPECT_LE(at + sizeof(T), bytes.size());
  if (at + sizeof(T) <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// First pose: two metres above a marker on the ground, looking down, image top to the north.
/// Second pose: from the south, level, at a height of one metre.
CameraTrajectory TwoPoses() {
  CameraTrajectory path;
  path.camera =
      CameraModel{.width = 640, .height = 480, .fx = 500, .fy = 510, .cx = 320, .cy = 241};
  path.poses.push_back({2'000'000'000, {{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 2}}, ""});
  path.poses.push_back({2'500'000'000, {{{1, 0, 0, 0, 0, 1, 0, -1, 0}}, {0, -3, 1}}, ""});
  return path;
}

/// The parts of a glb file.
struct Glb {
  Json json;
  std::string_view data;
  std::vector<float> Floats(std::size_t accessor) const {
    const Json& a = json["accessors"][accessor];
    const std::map<std::string, std::size_t> sizes{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t at = json["bufferViews"][a["bufferView"].get<std::size_t>()]["byteOffset"];
    std::vector<float> values(a["count"].get<std::size_t>() * sizes.at(a["type"]));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = NumberAt<float>(data, at + 4 * i);
    return values;
  }
};

Glb TakeApart(std::string_view glb) {
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(NumberAt<std::uint32_t>(glb, 4), 2U);
  EXPECT_EQ(NumberAt<std::uint32_t>(glb, 8), glb.size());
  const auto json_bytes = NumberAt<std::uint32_t>(glb, 12);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(json_bytes % 4, 0U);
  const std::size_t binary = 20 + json_bytes;
  EXPECT_EQ(NumberAt<std::uint32_t>(glb, binary) + binary + 8, glb.size());
  EXPECT_EQ(glb.substr(binary + 4, 4), std::string_view("BIN\0", 4));
  return {Json::parse(glb.substr(20, json_bytes)), glb.substr(binary + 8)};
}

TEST(GltfPath, MovesACameraAsGltfHasItWithYUp) {
  const auto glb = GltfFromTrajectory(TwoPoses(), {});
  ASSERT_TRUE(glb) << glb.error().Message();
  const Glb scene = TakeApart(*glb);
  const Json& animation = scene.json["animations"][0];
  EXPECT_THAT(scene.Floats(animation["samplers"][0]["input"]), ElementsAre(0.0F, 0.5F));
  EXPECT_EQ(animation["channels"][0]["target"]["path"], "translation");
  // East, north, up become x, -z, y.
  EXPECT_THAT(scene.Floats(animation["samplers"][0]["output"]), ElementsAre(0, 2, 0, 0, 1, 3));
  const std::vector<float> q = scene.Floats(animation["samplers"][1]["output"]);
  // glTF cameras look along -z with y up. Looking down is a quarter turn about -x; looking north,
  // level, is the identity.
  const float half = std::sqrt(0.5F);
  EXPECT_THAT(q, testing::Pointwise(testing::FloatNear(1e-6F),
                                    std::vector<float>{-half, 0, 0, half, 0, 0, 0, 1}));
  const Json& camera = scene.json["cameras"][0];
  EXPECT_NEAR(camera["perspective"]["yfov"], 2 * std::atan(240.0 / 510), 1e-12);
  EXPECT_NEAR(camera["perspective"]["aspectRatio"], (640.0 / 500) / (480.0 / 510), 1e-12);
  EXPECT_EQ(camera["extras"]["pleinair"]["cy"], 241);
  EXPECT_EQ(camera["extras"]["pleinair"]["first_timestamp_ns"], 2'000'000'000);
}

TEST(GltfPath, ShowsMarkerAndPointsInTheSameScene) {
  CameraTrajectory path = TwoPoses();
  path.points.push_back({{{1, 2, 3}}, {255, 128, 0}, 0.5});
  const auto glb = GltfFromTrajectory(path, {.up = UpAxis::kZ, .marker_size_m = 0.5});
  ASSERT_TRUE(glb);
  const Glb scene = TakeApart(*glb);
  EXPECT_EQ(scene.json["scenes"][0]["nodes"], Json({0, 1, 2}));
  const Json& marker = scene.json["meshes"][0]["primitives"][0]["attributes"];
  // The marker's top-left corner is in the north-west; its front faces up.
  const std::vector<float> corners = scene.Floats(marker["POSITION"]);
  EXPECT_THAT(std::vector<float>(corners.begin(), corners.begin() + 3),
              ElementsAre(-0.25F, 0.0F, -0.25F));
  const std::vector<float> normals = scene.Floats(marker["NORMAL"]);
  EXPECT_THAT(std::vector<float>(normals.begin(), normals.begin() + 3), ElementsAre(0, 1, 0));
  const Json& points = scene.json["meshes"][1]["primitives"][0];
  EXPECT_EQ(points["mode"], 0);
  EXPECT_THAT(scene.Floats(points["attributes"]["POSITION"]), ElementsAre(1, 3, -2));
}

TEST(GltfPath, TurnsTheShortWayBetweenAnyTwoPoses) {
  CameraTrajectory path;
  path.camera = TwoPoses().camera;
  for (int i = 0; i < 40; ++i) {
    const double angle = i * 0.3;
    const Mat3 turn = RotationOf({0, std::sin(angle / 2), 0, std::cos(angle / 2)});
    path.poses.push_back({i * 1'000'000, {turn, {}}, ""});
  }
  const auto text = GltfFromTrajectory(path, {.up = UpAxis::kY, .binary = false});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("data:application/octet-stream;base64,"));
  const auto glb = GltfFromTrajectory(path, {.up = UpAxis::kY});
  const std::vector<float> q = TakeApart(*glb).Floats(2);
  for (std::size_t i = 4; i < q.size(); i += 4) {
    EXPECT_GT(q[i] * q[i - 4] + q[i + 1] * q[i - 3] + q[i + 2] * q[i - 2] + q[i + 3] * q[i - 1],
              0.9F);
  }
}

TEST(GltfPath, RefusesALensThatNoPerspectiveCameraHas) {
  CameraTrajectory path = TwoPoses();
  path.camera->distortion_model = DistortionModel::kEquidistant;
  EXPECT_FALSE(GltfFromTrajectory(path, {}));
  path.camera.reset();
  EXPECT_FALSE(GltfFromTrajectory(path, {}));
}

/// Reads an MCAP file by its specification, chunk by chunk through the summary's index. Checks
/// every checksum, length and offset.
class McapReader {
 public:
  explicit McapReader(std::string_view file) : file_(file) {
    const std::string_view magic("\x89MCAP0\r\n", 8);
    EXPECT_EQ(file.substr(0, 8), magic);
    EXPECT_EQ(file.substr(file.size() - 8), magic);
    const std::size_t footer = file.size() - 8 - 29;
    EXPECT_EQ(file[footer], 0x02);
    EXPECT_EQ(NumberAt<std::uint64_t>(file, footer + 1), 20U);
    const auto summary = NumberAt<std::uint64_t>(file, footer + 9);
    const auto offsets = NumberAt<std::uint64_t>(file, footer + 17);
    EXPECT_EQ(NumberAt<std::uint32_t>(file, footer + 25),
              Sum(file.substr(summary, footer + 25 - summary)));
    // The data section ends with its own checksum just before the summary.
    EXPECT_EQ(file[summary - 13], 0x0F);
    EXPECT_EQ(NumberAt<std::uint32_t>(file, summary - 4), Sum(file.substr(0, summary - 13)));
    ReadSummary(summary, offsets);
    for (std::size_t at = offsets; at < footer; at += 9 + 17) {
      EXPECT_EQ(file[at], 0x0E);
      const auto group = NumberAt<std::uint64_t>(file, at + 10);
      EXPECT_EQ(file[group], file[at + 9]);
    }
  }

  std::map<std::string, std::vector<std::pair<std::uint64_t, Json>>> messages;
  std::map<std::string, std::string> schema_names;
  std::uint64_t stated_messages = 0;
  int chunks = 0;

 private:
  static std::uint32_t Sum(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  }
  static std::string TextAt(std::string_view bytes, std::size_t* at) {
    const auto length = NumberAt<std::uint32_t>(bytes, *at);
    *at += 4 + length;
    return std::string(bytes.substr(*at - length, length));
  }

  void ReadSummary(std::size_t at, std::size_t end) {
    while (at < end) {
      const char opcode = file_[at];
      const auto length = NumberAt<std::uint64_t>(file_, at + 1);
      const std::string_view content = file_.substr(at + 9, length);
      std::size_t inner = 2;
      if (opcode == 0x03) {
        const std::string name = TextAt(content, &inner);
        EXPECT_EQ(TextAt(content, &inner), "jsonschema");
        EXPECT_EQ(Json::parse(TextAt(content, &inner))["type"], "object");
        schemas_[NumberAt<std::uint16_t>(content, 0)] = name;
      } else if (opcode == 0x04) {
        inner = 4;
        const std::string topic = TextAt(content, &inner);
        EXPECT_EQ(TextAt(content, &inner), "json");
        topics_[NumberAt<std::uint16_t>(content, 0)] = topic;
        schema_names[topic] = schemas_.at(NumberAt<std::uint16_t>(content, 2));
      } else if (opcode == 0x08) {
        ReadChunk(content);
      } else {
        EXPECT_EQ(opcode, 0x0B);
        stated_messages = NumberAt<std::uint64_t>(content, 0);
      }
      at += 9 + length;
    }
    EXPECT_EQ(at, end);
  }

  void ReadChunk(std::string_view index) {
    ++chunks;
    const auto start = NumberAt<std::uint64_t>(index, 16);
    EXPECT_EQ(file_[start], 0x06);
    const std::string_view chunk =
        file_.substr(start + 9, NumberAt<std::uint64_t>(file_, start + 1));
    EXPECT_EQ(chunk.size() + 9, NumberAt<std::uint64_t>(index, 24));
    const std::string_view records = chunk.substr(40);
    EXPECT_EQ(records.size(), NumberAt<std::uint64_t>(chunk, 32));
    EXPECT_EQ(Sum(records), NumberAt<std::uint32_t>(chunk, 24));
    const auto offsets = NumberAt<std::uint32_t>(index, 32);
    for (std::size_t at = 36; at < 36 + offsets; at += 10) {
      ReadMessages(records, NumberAt<std::uint16_t>(index, at),
                   NumberAt<std::uint64_t>(index, at + 2));
    }
  }

  void ReadMessages(std::string_view records, std::uint16_t channel, std::size_t index) {
    EXPECT_EQ(file_[index], 0x07);
    EXPECT_EQ(NumberAt<std::uint16_t>(file_, index + 9), channel);
    const auto bytes = NumberAt<std::uint32_t>(file_, index + 11);
    for (std::size_t at = index + 15; at < index + 15 + bytes; at += 16) {
      const auto time = NumberAt<std::uint64_t>(file_, at);
      const auto place = NumberAt<std::uint64_t>(file_, at + 8);
      EXPECT_EQ(records[place], 0x05);
      const std::string_view message =
          records.substr(place + 9, NumberAt<std::uint64_t>(records, place + 1));
      EXPECT_EQ(NumberAt<std::uint16_t>(message, 0), channel);
      EXPECT_EQ(NumberAt<std::uint64_t>(message, 6), time);
      auto& list = messages[topics_.at(channel)];
      EXPECT_EQ(NumberAt<std::uint32_t>(message, 2), list.size());
      list.emplace_back(time, Json::parse(message.substr(22)));
    }
  }

  std::string_view file_;
  std::map<std::uint16_t, std::string> schemas_, topics_;
};

TEST(McapPath, HoldsCameraPosesAndMarkers) {
  McapTrajectoryOptions options;
  options.start_ns = 1'700'000'000'000'000'000;
  options.marker_size_m = 0.48;
  options.markers = {{1'900'000'000, R"({"frame":0,"timestamp_s":1.9,"markers":[],"lost":[]})"},
                     {2'600'000'000, R"({"frame":2,"timestamp_s":2.6,"markers":[],"lost":[]})"}};
  const auto file = McapFromTrajectory(TwoPoses(), options);
  ASSERT_TRUE(file) << file.error().Message();
  McapReader reader(*file);
  EXPECT_EQ(reader.schema_names["/camera/calibration"], "foxglove.CameraCalibration");
  EXPECT_EQ(reader.schema_names["/tf"], "foxglove.FrameTransform");
  EXPECT_EQ(reader.stated_messages, 8U);
  ASSERT_THAT(reader.messages["/tf"], SizeIs(2));
  const auto& [time, transform] = reader.messages["/tf"][1];
  EXPECT_EQ(time, 1'700'000'002'500'000'000U);
  EXPECT_EQ(transform["timestamp"], (Json{{"sec", 1'700'000'002}, {"nsec", 500'000'000}}));
  EXPECT_EQ(transform["parent_frame_id"], "marker");
  EXPECT_EQ(transform["translation"], (Json{{"x", 0.0}, {"y", -3.0}, {"z", 1.0}}));
  const Json& lens = reader.messages["/camera/calibration"][0].second;
  EXPECT_EQ(lens["K"], Json({500.0, 0.0, 320.0, 0.0, 510.0, 241.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(lens["distortion_model"], "plumb_bob");
  EXPECT_THAT(lens["D"], SizeIs(5));
  EXPECT_THAT(reader.messages["/markers"], SizeIs(2));
  EXPECT_EQ(reader.messages["/scene"][0].second["entities"][0]["cubes"][0]["size"]["x"], 0.48);
}

TEST(McapPath, HasNoTimesBeforeNineteenSeventy) {
  McapTrajectoryOptions options;
  options.start_ns = -10'000'000'000;
  EXPECT_FALSE(McapFromTrajectory(TwoPoses(), options));
}

TEST(McapWriter, SplitsALongFileIntoChunksThatAreAllFound) {
  McapWriter writer;
  const auto a = writer.AddChannel("/a", "A", R"({"type":"object"})");
  const auto b = writer.AddChannel("/b", "B", R"({"type":"object"})");
  const std::string text(1000, 'x');
  for (int i = 0; i < 3000; ++i) {
    writer.AddMessage(i % 3 == 0 ? a : b, static_cast<std::uint64_t>(i),
                      Json{{"number", i}, {"text", text}}.dump());
  }
  const std::string file = writer.Finish();
  McapReader reader(file);
  EXPECT_GT(reader.chunks, 2);
  ASSERT_THAT(reader.messages["/a"], SizeIs(1000));
  ASSERT_THAT(reader.messages["/b"], SizeIs(2000));
  EXPECT_EQ(reader.messages["/a"][999].second["number"], 2997);
  EXPECT_EQ(reader.messages["/a"][999].first, 2997U);
}

}  // namespace
}  // namespace pleinair::exports
