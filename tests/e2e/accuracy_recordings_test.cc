// Tests `pleinair accuracy` on recordings: formats of ground truth, peers, composed images.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/quaternion.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

struct Elsewhere;  // Frame of a motion capture system.
struct Body;       // The body that it tracks.

constexpr int kFrames = 8;

/// "x y z qx qy qz qw" or, with w first, "x,y,z,w,x,y,z".
template <typename To, typename From>
std::string PoseText(const Transform<To, From>& pose, bool w_first) {
  const Vec3 t = pose.translation_m;
  const Quaternion q = QuaternionOf(pose.rotation);
  return w_first ? fmt::format("{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f},{:.12f}", t.x, t.y,
                               t.z, q.w, q.x, q.y, q.z)
                 : fmt::format("{:.12f} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f} {:.12f}", t.x, t.y,
                               t.z, q.x, q.y, q.z, q.w);
}

/// The recording's entry in the report of a run over one recording.
json FilmOf(const fs::path& recording, const fs::path& out) {
  const RunResult run = RunPleinair({"accuracy", recording, "--no-light", "-o", out});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(ReadFile(out / "report.json"));
  EXPECT_EQ(report["films"].size(), 1U);
  return report["films"][0];
}

// The same frames with the same ground truth in four forms: in the marker's frame, and in other
// frames as in the TUM RGB-D benchmark and the EuRoC data sets. The aligned error is the same.
TEST(AccuracyOfRecordings, IsTheSameWhateverTheFormOfTheTruth) {
  const TemporaryFolder folder;
  const Transform<Elsewhere, Marker> elsewhere_from_marker{RotationOf({0.1, -0.7, 0.3, 0.6}),
                                                           {40, -7, 3}};
  const Transform<Body, Camera> body_from_camera{RotationOf({0.5, -0.5, 0.5, 0.5}),
                                                 {0.02, -0.06, 0.01}};
  const std::vector<TumPose> truth = ReadTum(BundledRecording() / "truth.tum");
  std::string in_marker, elsewhere, euroc = "#timestamp, p, q\n", frames = "#timestamp,filename\n";
  const fs::path mav = folder / "euroc/mav0";
  fs::create_directories(mav / "cam0/data");
  fs::create_directories(mav / "state_groundtruth_estimate0");
  for (int i = 0; i < kFrames; ++i) {
    const auto& pose = truth[i].marker_from_camera;
    const std::int64_t stamp_ns = 1'403'636'579'763'555'584 + i * 66'666'667LL;
    in_marker += fmt::format("{:.6f} {}\n", i / 15.0, PoseText(pose, false));
    // Seconds since 1970, as in that benchmark.
    elsewhere += fmt::format("{:.6f} {}\n", 1757847900.0 + i / 15.0,
                             PoseText(elsewhere_from_marker * pose, false));
    euroc += fmt::format("{},{},0,0,0\n", stamp_ns,
                         PoseText(elsewhere_from_marker * pose * body_from_camera.Inverse(), true));
    const std::string picture = fmt::format("{}.jpg", stamp_ns);
    frames += fmt::format("{},{}\n", stamp_ns, picture);
    fs::copy_file(BundledRecording() / fmt::format("frames/{:04}.jpg", i),
                  mav / "cam0/data" / picture);
  }
  WriteFile(mav / "cam0/data.csv", frames);
  WriteFile(mav / "state_groundtruth_estimate0/data.csv", euroc);
  // The quaternion (0.5, -0.5, 0.5, 0.5) rotates camera to body.
  WriteFile(mav / "cam0/sensor.yaml", R"(sensor_type: camera
T_BS:
  rows: 4
  cols: 4
  data: [0, -1, 0, 0.02, 0, 0, -1, -0.06, 1, 0, 0, 0.01, 0, 0, 0, 1]
rate_hz: 15
resolution: [640, 480]
camera_model: pinhole
intrinsics: [605, 605, 319.5, 239.5]
distortion_model: radial-tangential
distortion_coefficients: [0, 0, 0, 0]
)");
  for (const char* name : {"marker", "tum"}) MakeShortRecording(folder / name, kFrames, false);
  for (const char* name : {"scene.toml", "phantom.obj", "phantom.mtl"}) {
    fs::copy_file(folder / "tum" / name, folder / "euroc" / name);
  }
  WriteFile(folder / "marker/truth.tum", in_marker);
  WriteFile(folder / "tum/groundtruth.txt", "# ground truth trajectory\n" + elsewhere);

  const json plain = FilmOf(folder / "marker", folder / "out_marker");
  EXPECT_EQ(plain["found"], kFrames);
  EXPECT_EQ(plain["truth_aligned"], false);
  EXPECT_LT(plain["ate_unaligned_rmse_mm"], 5.0);
  for (const char* name : {"tum", "euroc"}) {
    const json film = FilmOf(folder / name, folder / (std::string("out_") + name));
    EXPECT_EQ(film["found"], kFrames) << name;
    EXPECT_EQ(film["truth_aligned"], true) << name;
    EXPECT_TRUE(film["ate_unaligned_rmse_mm"].is_null()) << name;
    for (const char* error : {"ate_rmse_mm", "rpe_translation_rmse_mm", "rpe_rotation_rmse_deg"}) {
      EXPECT_NEAR(film[error].get<double>(), plain[error].get<double>(), 1e-4) << name << error;
    }
  }
}

TEST(AccuracyOfRecordings, RunsPeersWhereTheyCanReadThePrintAndSaysWhereNot) {
  const TemporaryFolder folder;
  const fs::path tag = tests::SourceTree() / "recordings/courtyard_tag36h11";
  MakeShortRecording(folder / "sg", 2, false);
  const std::string truth = ReadFile(BundledRecording() / "truth.tum");
  WriteFile(folder / "sg/truth.tum", truth);
  const RunResult run = RunPleinair({"accuracy", tag, folder / "sg", "--no-light", "--against",
                                     "apriltag,aruco", "-o", folder / "out"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(ReadFile(folder / "out/report.json"));
  ASSERT_EQ(report["without_print"].size(), 2U);
  EXPECT_EQ(report["without_print"][0]["film"], (folder / "sg").string());
  EXPECT_THAT(ReadFile(folder / "out/report.html"), HasSubstr("aruco cannot read its marker"));
  int compared = 0;
  for (const json& pair : report["against"]) {
    if (pair["film"] != tag.string()) continue;
    ++compared;
    EXPECT_EQ(pair["markers"], 6);
    EXPECT_EQ(pair["both"], 6);
    // Measured: 0.03 for the library's own corners, 0.03 for ArUco's. A wrong corner order gives no
    // hits; a half-pixel shift gives a fifth.
    EXPECT_LT(pair["corner_px"]["interval"][1], 0.2);
  }
  EXPECT_EQ(compared, 2);
}

TEST(AccuracyOfRecordings, HasWhatCompareGivesOfTheLightHoweverItIsDivided) {
  const TemporaryFolder folder;
  const fs::path site = folder / "site";
  MakeShortRecording(site, 1, true);
  fs::copy_file(BundledRecording() / "frames/0036.jpg", site / "frames/0000.jpg",
                fs::copy_options::overwrite_existing);
  fs::copy(BundledRecording() / "key", site / "key");
  const std::vector<TumPose> truth = ReadTum(BundledRecording() / "truth.tum");
  WriteFile(site / "truth.tum", "0 " + PoseText(truth[36].marker_from_camera, false) + "\n");
  WriteFile(site / "scene.json", R"({"key_frames": [{"frame": 0, "truth": "key/0036_truth.png",
    "object_mask": "key/0036_objmask.png", "shadow": "key/0036_shadow.png"}]})");
  // Its two parts, frames and images, by two shards into separate folders.
  for (const char* shard : {"1", "2"}) {
    const RunResult run =
        RunPleinair({"accuracy", site, "-o", folder / shard, "--shard", std::string(shard) + "/2"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  ASSERT_EQ(RunPleinair({"report", "merge", folder / "1", folder / "2", "-o", folder / "merged"})
                .exit_code,
            0);
  const json report = json::parse(ReadFile(folder / "merged/report.json"));
  ASSERT_EQ(report["light"].size(), 1U);
  ASSERT_EQ(RunPleinair({"replay", site, "-o", folder / "replay", "--frames"}).exit_code, 0);
  const RunResult compared = RunPleinair({"compare", folder / "replay", site, "--json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const json scores = json::parse(compared.out)["pictures"]["0000"];
  for (const char* name : {"dE_obj", "dE_shadow", "dE_near", "dE_all", "SSIM_near"}) {
    EXPECT_NEAR(report["light"][0][name]["mean"].get<double>(), scores[name].get<double>(), 1e-7);
  }
  EXPECT_LT(scores["dE_obj"], 2.0);
  EXPECT_THAT(ReadFile(folder / "merged/report.html"), HasSubstr("<h2>Light</h2>"));
  // The complete run, resumed in the first shard's folder with the other's part.
  fs::copy_file(folder / "2/parts/00001.jsonl", folder / "1/parts/00001.jsonl");
  const RunResult whole = RunPleinair({"accuracy", site, "-o", folder / "1", "--json"});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(json::parse(whole.out)["measured_now"], 0);
  for (const char* file : {"report.json", "report.html", "records.jsonl", "pictures.jsonl"}) {
    EXPECT_EQ(ReadFile(folder / "merged" / file), ReadFile(folder / "1" / file)) << file;
  }
  const RunResult diff = RunPleinair({"report", "diff", folder / "merged", folder / "1"});
  EXPECT_EQ(diff.exit_code, 0) << diff.out;
  EXPECT_THAT(diff.out, HasSubstr("dE_shadow"));
  EXPECT_THAT(diff.out, Not(HasSubstr("WORSE")));
}

}  // namespace
}  // namespace pleinair::e2e
