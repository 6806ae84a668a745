// `fathom capture` as users run it: every file of the contract, the same bytes for any number of threads, one line for
// every mistake and nothing left behind.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/files.h"
#include "core/folder_owner.h"
#include "core/image_file.h"
#include "core/json.h"
#include "sim/effects/effects_json.h"
#include "sim/scene/resolved_scene.h"
#include "sim/sensor/capture_files.h"
#include "sim/sensor/depth.h"
#include "tests/app/run_fathom.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"
#include "tests/scene/write_gltf.h"

namespace fathom {
namespace {

/// A cup of water before a small sensor: a quarter of the pixels, so that a shot takes a fraction of a second.
Json small_scene() {
  return Json::parse(R"({
    "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0], "ir_size_px": [640, 512],
               "depth_size_px": [320, 240], "focal_px": 285, "pattern": {"step_px": 1.0}},
    "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}]})");
}

class CaptureCommand : public testing::Test {
 protected:
  CaptureCommand() { write_json(scene_, small_scene()); }

  /// Captures into a subfolder that is returned.
  std::filesystem::path capture(const std::string& name, const std::string& options) {
    const std::filesystem::path output = folder_ / name;
    const ProgramRun run =
        run_fathom(fmt::format("capture {} -o {} --quiet {}", scene_.string(), output.string(), options));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return output;
  }

  TemporaryFolder folder_;
  std::filesystem::path scene_ = folder_ / "scene.json";
};

TEST_F(CaptureCommand, WritesTheFilesOfTheContract) {
  const std::filesystem::path out = capture("out", "");
  for (const char* name : {"ir.exr", "ir.png", "disparity.exr", "depth.exr", "depth.png", "cloud.pcd", "truth.exr"})
    EXPECT_TRUE(std::filesystem::is_regular_file(out / name)) << name;
  const Image<float> ir = read_exr_channel(out / "ir.exr", "Y");
  EXPECT_EQ(ir.width(), 640);
  EXPECT_EQ(ir.height(), 512);
  EXPECT_EQ(read_exr_channel(out / "disparity.exr", "Y").width(), 320);

  std::vector<std::string> names;
  for (const ExrChannel& channel : read_exr(out / "truth.exr")) names.push_back(channel.name);
  EXPECT_EQ(names, (std::vector<std::string>{"apparent.Z", "first.Z", "first.object", "object", "path", "position.X",
                                             "position.Y", "position.Z"}));

  const Image<float> depth = read_exr_channel(out / "depth.exr", "Z");
  const Image<std::uint16_t> depth_mm = read_png_grey(out / "depth.png");
  ASSERT_EQ(depth.width(), 320);
  ASSERT_EQ(depth_mm.height(), 240);
  for (std::size_t i = 0; i < depth.size(); ++i)
    ASSERT_EQ(depth_mm.pixels()[i], std::lround(depth.pixels()[i] * 1000.0f));  // the device's depths are whole mm

  const std::string cloud = read_text(out / "cloud.pcd");
  for (const char* line : {"FIELDS x y z intensity\n", "WIDTH 320\n", "HEIGHT 240\n", "DATA binary\n"})
    EXPECT_NE(cloud.find(line), std::string::npos) << line;
}

TEST_F(CaptureCommand, RecordsWhatItDid) {
  const Json record = read_json(capture("out", "--seed 5 --spp 1 --threads 1") / "run.json");
  EXPECT_EQ(record["scene"], small_scene());
  EXPECT_EQ(record["seed"], 5);
  EXPECT_EQ(record["spp"], 1);
  EXPECT_EQ(record["threads"], 1);
  EXPECT_EQ(record["mode"], "photometric");
  EXPECT_EQ(record["objects"], Json::parse(R"({"1": "desk", "2": "cup 0 paper_cup", "3": "cup 0 water"})"));
  EXPECT_NEAR(record["media"]["cup 0 water"]["index"].get<double>(), 1.3281, 5e-6);  // half a unit of the printed digit
  EXPECT_EQ(record["sensor"]["focal_px"], 285.0);
  EXPECT_GT(record["rays"].get<double>(), 640.0 * 512.0);
  EXPECT_TRUE(record.contains("fathom"));
  for (const char* time : {"build_s", "truth_s", "render_s", "match_s", "total_s"})
    EXPECT_GE(record["timing"][time].get<double>(), 0.0) << time;
}

TEST_F(CaptureCommand, EveryNumberInSightOccursAndNoOther) {
  const std::filesystem::path out = capture("out", "--mode geometric");
  const Json record = read_json(out / "run.json");
  EXPECT_EQ(record["cups"]["cup 0 paper_cup"]["object"], 2);
  EXPECT_EQ(record["cups"]["cup 0 paper_cup"]["liquid"], 3);
  EXPECT_EQ(record["in_sight"], Json::parse(R"({"first": [1, 2, 3], "finally": [1, 2]})"));
  for (const auto& [channel, key] : {std::pair("first.object", "first"), std::pair("object", "finally")}) {
    std::set<int> numbers;
    const Image<float> image = read_exr_channel(out / "truth.exr", channel);
    for (const float number : image.pixels()) numbers.insert(static_cast<int>(number));
    numbers.erase(0);
    EXPECT_EQ(Json(numbers), record["in_sight"][key]) << channel;
  }
}

TEST_F(CaptureCommand, SaysWhereCameraAndObjectsStand) {
  const std::filesystem::path out = capture("out", "--mode geometric");
  const Json record = read_json(out / "run.json");
  const RecordedCapture recorded = read_capture(out);
  EXPECT_EQ(record["camera_matrix"], Json::parse("[[285.0, 0.0, 160.0], [0.0, 285.0, 120.0], [0.0, 0.0, 1.0]]"));
  EXPECT_EQ(record["world_from_camera"], json_from_pose(recorded.setup.rig.world_from_camera));
  const Json at_cup =
      Json::parse("[[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.3], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]");
  EXPECT_EQ(record["world_from_object"]["2"], at_cup);
  EXPECT_EQ(record["world_from_object"]["3"], at_cup);
}

TEST_F(CaptureCommand, ThingsThatShareTheirRoomAreRefusedBeforeAnythingIsWritten) {
  Json scene = small_scene();
  scene["cups"] =
      Json::parse(R"([{"shape": "mug", "position_mm": [0, 300]}, {"shape": "paper_cup", "position_mm": [85, 300]}])");
  write_json(scene_, scene);
  const ProgramRun run = run_fathom("capture " + scene_.string() + " -o " + (folder_ / "out").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err,
            "error: " + scene_.string() + ": /cups/1: stands in /cups/0: things may touch, not share their room\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CaptureCommand, IsReadBackWithItsEffectsAndAModels) {
  Json scene = small_scene();
  scene["effects"] = Json::parse(R"([{"name": "baseline", "baseline_mm": 0.3}, {"name": "fill_scale", "scale": 0.1}])");
  write_json(scene_, scene);
  write_json(folder_ / "model.json",
             {{"effects", Json::parse(R"([{"name": "depth_step_phase", "phase_steps": 0.5}])")}});
  const std::filesystem::path out =
      capture("out", "--mode geometric --device-outputs --model " + (folder_ / "model.json").string());
  const RecordedCapture recorded = read_capture(out);
  const SensorModel& sensor = recorded.sensor();
  EXPECT_EQ(recorded.setup, with_effects_of_model(read_setup(scene_), folder_ / "model.json"));
  EXPECT_EQ(sensor.believed->baseline, 0.075);
  EXPECT_EQ(sensor.law.step_phase, 1.0);
  const Image<float> disparity = read_frame(recorded, 0, false).disparity_px,
                     depth = read_exr_channel(out / "depth.exr", "Z");
  EXPECT_TRUE(std::ranges::equal(depth_image(sensor, disparity, sensor.law.cut).pixels(), depth.pixels()));
  EXPECT_TRUE(std::ranges::equal(depth_in_units(depth_image(sensor, disparity, cut_of(sensor, 1e-4)), 1e-4).pixels(),
                                 read_png_grey(out / "depth_100um.png").pixels()));
}

TEST_F(CaptureCommand, IsReadBackElsewhereWithoutTheFilesThatItsSceneNamed) {
  const std::filesystem::path things = folder_ / "things";
  make_directory(things);
  Mesh plate;
  for (const auto& [x, y] : {std::pair(-0.02, -0.02), {0.02, -0.02}, {0.02, 0.02}, {-0.02, 0.02}})
    plate.add_vertex({x, y, 0.01});
  plate.add_triangle(0, 1, 2), plate.add_triangle(0, 2, 3);
  write_gltf(things / "a plate.gltf", plate);
  Image<std::uint16_t> dots(64, 64);
  for (int i = 0; i < 64; i += 3)
    for (int j = 0; j < 64; j += 2) dots((i * 7 + j) % 64, i) = 65535;
  write_png(things / "dots.png", dots);
  Json scene = small_scene();
  scene["sensor"]["pattern"] = {{"image", "things/dots.png"}};
  scene["objects"] = Json::parse(R"([{"gltf": "things/a plate.gltf", "position_mm": [100, 300, 0]},
                                     {"gltf": "things/a plate.gltf", "position_mm": [-100, 300, 0]}])");
  scene["cups"].push_back(Json::parse(R"({"shape": "things/a plate.gltf", "position_mm": [0, 500], "yaw_deg": 20})"));
  write_json(scene_, scene);
  const fathom::Setup shot = read_setup(scene_);
  const Geometry before = build_geometry(shot.scene, 830.0);
  std::filesystem::rename(capture("out", "--mode geometric"), folder_ / "moved");
  const RecordedCapture moved = read_capture(folder_ / "moved");
  EXPECT_EQ(moved.setup, shot);
  std::filesystem::remove_all(things);
  const RecordedCapture alone = read_capture(folder_ / "moved");
  EXPECT_TRUE(alone.setup.rig.sensor == shot.rig.sensor);
  const Geometry after = build_geometry(alone.setup.scene, 830.0);
  ASSERT_EQ(after.surfaces.size(), before.surfaces.size());
  for (std::size_t i = 0; i < after.surfaces.size(); ++i)
    EXPECT_TRUE(after.surfaces[i].mesh == before.surfaces[i].mesh);
  // The next capture takes away what this one brought.
  std::filesystem::rename(folder_ / "moved", folder_ / "out");
  write_json(scene_, small_scene());
  capture("out", "--mode geometric");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / kSceneFiles));
}

TEST_F(CaptureCommand, SameSeedSameBytesForAnyNumberOfThreads) {
  const std::filesystem::path one = capture("one", "--seed 3 --threads 1"),
                              two = capture("two", "--seed 3 --threads 2");
  for (const char* name : {"ir.exr", "disparity.exr", "depth.exr", "cloud.pcd", "truth.exr"})
    EXPECT_TRUE(read_text(one / name) == read_text(two / name)) << name;
  const std::filesystem::path other = capture("other", "--seed 4");
  EXPECT_FALSE(read_text(one / "ir.exr") == read_text(other / "ir.exr"));
  EXPECT_TRUE(read_text(one / "truth.exr") == read_text(other / "truth.exr"));  // chance has no part in it
}

TEST_F(CaptureCommand, FramesDifferInTheirNoiseOnly) {
  const std::filesystem::path out = capture("out", "--frames 2");
  EXPECT_FALSE(read_text(out / "frame_0000" / "ir.exr") == read_text(out / "frame_0001" / "ir.exr"));
  EXPECT_TRUE(std::filesystem::exists(out / "truth.exr"));
  EXPECT_EQ(read_json(out / "run.json")["frames"], 2);
}

TEST_F(CaptureCommand, HasAllLightWhereAnythingStandsUnlessAskedOtherwise) {
  const auto light_of = [&](const std::string& name, const std::string& options) {
    return read_json(capture(name, options) / "run.json")["light"];
  };
  EXPECT_EQ(light_of("water", ""), "full");
  EXPECT_EQ(light_of("direct", "--light direct"), "direct");
  EXPECT_EQ(light_of("geometric", "--mode geometric"), "direct");
  Json scene = small_scene();
  scene["cups"][0]["liquid"] = {{"index", 1.33}, {"scattering_per_mm", 100}, {"anisotropy", 0}};  // like paint
  write_json(scene_, scene);
  EXPECT_EQ(light_of("paint", ""), "direct");
  scene.erase("cups");
  scene["objects"] = {{{"solid", "can"}, {"position_mm", {0, 300}}}};
  write_json(scene_, scene);
  EXPECT_EQ(light_of("can", ""), "full");
  scene.erase("objects");
  scene["desk"] = Json::object();
  write_json(scene_, scene);
  EXPECT_EQ(light_of("desk", ""), "direct");
}

TEST_F(CaptureCommand, IsReadBackAsItWasShot) {
  const std::filesystem::path out = capture("out", "--frames 2 --seed 3");
  const RecordedCapture recorded = read_capture(out);
  const fathom::Setup setup = setup_from_json(small_scene(), "scene");
  EXPECT_EQ(recorded.sensor().focal_px, setup.rig.sensor.focal_px);
  EXPECT_EQ(recorded.sensor().noise.bits, 10);
  ASSERT_EQ(recorded.frames.size(), 2u);
  Camera camera(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, 3);
  for (std::size_t i = 0; i < 2; ++i) {
    const Frame shot = camera.shoot(i), read = read_frame(recorded, i, true);
    EXPECT_TRUE(std::ranges::equal(read.ir.pixels(), shot.ir.pixels()));
    EXPECT_TRUE(std::ranges::equal(read.disparity_px.pixels(), shot.disparity_px.pixels()));
    EXPECT_TRUE(read_frame(recorded, i, false).ir.empty());
  }
}

TEST_F(CaptureCommand, IsRefusedWhenReadBackIncomplete) {
  const std::filesystem::path out = capture("out", "--mode geometric");
  EXPECT_FALSE(read_capture(out).infrared);
  write_exr(out / "disparity.exr", {{"Y", Image<float>(4, 3)}});
  expect_error([&] { read_frame(read_capture(out), 0, false); },
               {"disparity.exr: is 4 × 3 pixels, expected", "320 × 240"});
  std::filesystem::remove(out / "disparity.exr");
  expect_error([&] { read_frame(read_capture(out), 0, false); }, {"disparity.exr: "});
  std::filesystem::remove(out / "run.json");
  expect_error([&] { read_capture(out); }, {"out: holds no complete capture: there is no run.json"});
}

TEST_F(CaptureCommand, GoesOnAfterAKillWithTheSameBytes) {
  const std::string options = "--mode geometric --frames 4";
  const std::filesystem::path whole = capture("whole", options), out = capture("out", options);
  const auto written = [&](const char* file) { return std::filesystem::last_write_time(out / file); };
  const auto kept = written("frame_0001/cloud.pcd"), damaged = written("frame_0002/depth.exr");
  std::filesystem::remove(out / "run.json");  // as a kill leaves it: one frame damaged, one half there
  std::string text = read_text(out / "frame_0002/depth.exr");
  text.back() ^= 1;
  write_text(out / "frame_0002/depth.exr", text);
  std::filesystem::remove(out / "frame_0003/cloud.pcd");
  capture("out", options);
  EXPECT_EQ(written("frame_0001/cloud.pcd"), kept);
  EXPECT_NE(written("frame_0002/depth.exr"), damaged);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(whole)) {
    if (!entry.is_regular_file() || entry.path().filename() == "run.json") continue;  // which has times
    const std::filesystem::path name = entry.path().lexically_relative(whole);
    EXPECT_EQ(read_text(out / name), read_text(entry.path())) << name;
  }
}

TEST_F(CaptureCommand, NothingOfAnotherCaptureStays) {
  capture("out", "--mode geometric --frames 3");
  write_text(folder_ / "out/notes.txt", "mine");
  write_text(folder_ / "out/frame_0002/notes.txt", "mine");
  const std::filesystem::path out = capture("out", "--mode geometric --seed 2 --frames 2");
  EXPECT_FALSE(std::filesystem::exists(out / "frame_0002/cloud.pcd"));
  EXPECT_EQ(read_text(out / "notes.txt"), "mine");  // somebody else's files do
  EXPECT_EQ(read_text(out / "frame_0002/notes.txt"), "mine");
}

/// A kill while an older capture is cleared away leaves its manifest, with which the next run goes on.
TEST_F(CaptureCommand, WhatIsHalfClearedAwayIsCleared) {
  const std::filesystem::path out = capture("out", "--mode geometric --frames 3");
  std::filesystem::remove(out / "run.json");
  std::filesystem::remove(out / "frame_0000/cloud.pcd");
  capture("out", "--mode geometric --frames 2");
  EXPECT_TRUE(std::filesystem::exists(out / "frame_0000/cloud.pcd"));
  EXPECT_FALSE(std::filesystem::exists(out / "frame_0002"));
}

TEST_F(CaptureCommand, AFolderOfSomebodyElseIsLeftAlone) {
  std::filesystem::create_directories(folder_ / "mine");
  write_text(folder_ / "mine/cloud.pcd", "mine");
  const std::string command =
      fmt::format("capture {} -o {} --mode geometric", scene_.string(), (folder_ / "mine").string());
  EXPECT_EQ(run_fathom(command).err,
            fmt::format("error: {}: is there already; choose another folder\n", (folder_ / "mine/cloud.pcd").string()));
  EXPECT_EQ(read_text(folder_ / "mine/cloud.pcd"), "mine");
  std::filesystem::remove(folder_ / "mine/cloud.pcd");
  std::filesystem::create_directories(folder_ / "mine/frame_0007");
  EXPECT_EQ(run_fathom(command).err, fmt::format("error: {}: is there already; choose another folder\n",
                                                 (folder_ / "mine/frame_0007").string()));
  std::filesystem::remove(folder_ / "mine/frame_0007");
  write_text(folder_ / "mine/manifest.jsonl", "{\"command\": \"campaign\"}\n");
  EXPECT_EQ(run_fathom(command).err,
            fmt::format("error: {}: is of another command, or damaged; choose another folder\n",
                        (folder_ / "mine/manifest.jsonl").string()));
  EXPECT_EQ(read_text(folder_ / "mine/manifest.jsonl"), "{\"command\": \"campaign\"}\n");
}

TEST_F(CaptureCommand, AFolderThatAnotherProcessWritesIsLeftAlone) {
  const std::filesystem::path out = capture("out", "--mode geometric");
  const auto written = std::filesystem::last_write_time(out / "run.json");
  const FolderOwner owner(out);
  const ProgramRun run =
      run_fathom(fmt::format("capture {} -o {} --mode geometric --seed 2", scene_.string(), out.string()));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err.rfind(fmt::format("error: {}: is being written by process {} on ", out.string(), ::getpid()), 0),
            0u)
      << run.err;
  EXPECT_EQ(std::filesystem::last_write_time(out / "run.json"), written);
}

TEST_F(CaptureCommand, GeometricModeMakesNoImages) {
  const std::filesystem::path out = capture("out", "--mode geometric");
  EXPECT_FALSE(std::filesystem::exists(out / "ir.exr"));
  EXPECT_TRUE(std::filesystem::exists(out / "depth.exr"));
  EXPECT_TRUE(std::filesystem::exists(out / "cloud.pcd"));
}

TEST_F(CaptureCommand, AShotOfNothingSaysSo) {
  write_json(scene_, {{"sensor", small_scene()["sensor"]}, {"desk", nullptr}});
  const ProgramRun run =
      run_fathom(fmt::format("capture {} -o {} --mode geometric", scene_.string(), (folder_ / "out").string()));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "warning: " + scene_.string() +
                         ": frames without a pixel that has a depth: 1 of 1; is anything lit and in range?\n");
}

TEST_F(CaptureCommand, BlackSurfacesAreHoles) {
  Json scene = small_scene();
  scene["desk"]["albedo"] = 0.0;
  write_json(scene_, scene);
  const std::filesystem::path out = capture("out", "");
  const Image<float> depth = read_exr_channel(out / "depth.exr", "Z");
  const Image<float> object = read_exr_channel(out / "truth.exr", "object");
  double desk = 0.0, valid = 0.0;
  for (int y = 20; y < 60; ++y)  // well away from the cup, whose dots windows at its edge share
    for (int x = 20; x < 80; ++x) {
      desk += object(x, y) == 1.0f;
      valid += depth(x, y) > 0.0f;
    }
  EXPECT_EQ(desk, 40.0 * 60.0);
  EXPECT_EQ(valid, 0.0);
}

TEST_F(CaptureCommand, MistakesAreAnsweredInOneLineAndLeaveNothing) {
  const std::pair<std::string, std::string> mistakes[] = {
      {"{", "line 1"},
      {R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650}})", "/sensor: needs either aim_mm or pitch_deg"},
      {R"({"sensor": {"height_mm": 650, "pitch_deg": 60}, "cup": []})", "/cup: unknown key 'cup'"},
      {R"({"sensor": {"height_mm": 650, "pitch_deg": 60}, "objects": [{"gltf": "none.glb"}]})",
       "scene.json: /objects/0/gltf: there is no file "},
      {R"({"sensor": {"height_mm": 650, "pitch_deg": 60, "wavelength_nm": 2000},
           "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 3}]})",
       "scene.json: /cups/0/liquid: the index of water is known from 200 to 1100 nm, the sensor works at 2000 nm"},
  };
  for (const auto& [scene, message] : mistakes) {
    write_text(scene_, scene);
    const std::filesystem::path out = folder_ / "out";
    const ProgramRun run = run_fathom(fmt::format("capture {} -o {}", scene_.string(), out.string()));
    EXPECT_EQ(run.exit_code, 1) << scene;
    EXPECT_EQ(run.err.rfind("error: ", 0), 0u) << run.err;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_TRUE(!std::filesystem::exists(out) || std::filesystem::is_empty(out)) << scene;
    EXPECT_EQ(run.out, "");
  }
}

TEST_F(CaptureCommand, OfManyFramesSaysTheirSizeAndAsksForMoreThanTwentyGigabytes) {
  const std::filesystem::path out = folder_ / "out";
  const std::string command = fmt::format("capture {} -o {} --mode geometric ", scene_.string(), out.string());
  const ProgramRun two = run_fathom(command + "--frames 2");
  ASSERT_EQ(two.exit_code, 0) << two.err;
  double bytes = 0.0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
    if (entry.path().string().find("frame_") != std::string::npos && entry.is_regular_file())
      bytes += static_cast<double>(entry.file_size());
  double said = 0.0;
  ASSERT_EQ(std::sscanf(two.err.c_str() + out.string().size(), ": 2 frames are up to %lf MB", &said), 1) << two.err;
  EXPECT_GE(1e6 * said, bytes);
  EXPECT_LE(1e6 * said, 2.0 * bytes);  // a cloud is most of it, the images are compressed
  std::filesystem::remove_all(out);
  const ProgramRun many = run_fathom(command + "--frames 100000");
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_NE(many.err.find("20 GB are written only with --yes"), std::string::npos) << many.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(CaptureCommand, BadUsageIsTwo) {
  EXPECT_EQ(run_fathom(fmt::format("capture {}", scene_.string())).exit_code, 2);  // -o DIR is missing
  EXPECT_EQ(run_fathom(fmt::format("capture {} -o x --mode exact", scene_.string())).exit_code, 2);
  EXPECT_EQ(run_fathom(fmt::format("capture {} -o x --spp 0", scene_.string())).exit_code, 2);
}

}  // namespace
}  // namespace fathom
