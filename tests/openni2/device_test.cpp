// What a client of OpenNI2 gets from a virtual device: the frames that the simulator makes, on the device's law.
#include <PS1080.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/image_file.h"
#include "core/json.h"
#include "sim/scene/geometry.h"
#include "sim/sensor/capture_files.h"
#include "sim/sensor/depth.h"
#include "tests/app/run_fathom.h"
#include "tests/core/expect_error.h"
#include "tests/openni2/client.h"

namespace fathom {
namespace {

using openni::STATUS_OK;
namespace fs = std::filesystem;

constexpr double kFocal_px = 285.171;  ///< of the captured scene's sensor, half the Xtion's

class Device : public testing::Test {
 protected:
  static void SetUpTestSuite() { captured_ = std::make_unique<Captured>(); }
  static void TearDownTestSuite() { captured_.reset(); }

  static const Captured& captured() { return *captured_; }
  static const SensorModel& sensor() { return captured_->setup.rig.sensor; }

  OpenNi2 openni2_;

 private:
  static inline std::unique_ptr<Captured> captured_;
};

std::vector<std::uint16_t> in_units(const Image<float>& depth, double unit) {
  const Image<std::uint16_t> whole = depth_in_units(depth, unit);
  return {whole.pixels().begin(), whole.pixels().end()};
}

/// A captured frame's depth in whole mm.
std::vector<std::uint16_t> captured_mm(const std::string& folder, int frame) {
  const RecordedCapture recorded = read_capture(folder);
  return in_units(depth_image(recorded.sensor(), read_frame(recorded, frame, false).disparity_px), 1e-3);
}

std::vector<std::uint16_t> in_dn(const Image<float>& ir) {
  std::vector<std::uint16_t> dn;
  for (const float value : ir.pixels()) dn.push_back(static_cast<std::uint16_t>(std::lround(value)));
  return dn;
}

TEST_F(Device, EveryDepthLiesOnTheLaw) {
  Client client(captured().scene, openni::SENSOR_DEPTH);
  for (const auto& [format, unit] :
       {std::pair(openni::PIXEL_FORMAT_DEPTH_1_MM, 1e-3), std::pair(openni::PIXEL_FORMAT_DEPTH_100_UM, 1e-4)}) {
    std::set<long> law{0};
    for (int code = device_code(sensor(), sensor().law.near) - 1; code <= device_code(sensor(), sensor().law.far);
         ++code)
      law.insert(std::lround(*device_depth(sensor(), code, unit) / unit));
    client.set_mode(format, sensor().width);
    ASSERT_EQ(client.stream.start(), STATUS_OK);
    const ReadFrame frame = client.read();
    client.stream.stop();
    std::size_t measured = 0;
    for (const std::uint16_t depth : frame.pixels) {
      ASSERT_TRUE(law.contains(depth)) << depth << " units of " << unit << " m";
      measured += depth > 0;
    }
    // A matte desk but for the matcher's border (15 %), the projector's shadow and the cup's.
    EXPECT_GT(measured, frame.pixels.size() * 3 / 4);
  }
}

TEST_F(Device, ALiveSceneIsShotAnewForEveryFrame) {
  Client client(captured().scene, openni::SENSOR_DEPTH);
  Camera camera(captured().setup, CaptureMode::photometric, kDefaultSamplesPerPixel, 1);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  ReadFrame before{};
  for (int i = 0; i < 3; ++i) {
    const ReadFrame frame = client.read();
    ASSERT_GT(frame.number, before.number);
    EXPECT_GT(frame.time_us, before.time_us);
    EXPECT_NE(frame.pixels, before.pixels);
    EXPECT_EQ(frame.pixels, in_units(camera.shoot(static_cast<std::uint64_t>(frame.number - 1)).depth, 1e-3));
    before = frame;
  }
}

TEST_F(Device, InfraredIsTheImageThatWasMatched) {
  Client client(captured().scene, openni::SENSOR_IR);
  Camera camera(captured().setup, CaptureMode::photometric, kDefaultSamplesPerPixel, 1);
  for (const int width : {sensor().ir_width, sensor().width}) {
    client.set_mode(openni::PIXEL_FORMAT_GRAY16, width);
    ASSERT_EQ(client.stream.start(), STATUS_OK);
    const ReadFrame frame = client.read();
    client.stream.stop();
    const Frame shot = camera.shoot(static_cast<std::uint64_t>(frame.number - 1));
    EXPECT_EQ(frame.width, width);
    EXPECT_EQ(frame.pixels, in_dn(width == sensor().width ? at_depth_scale(sensor(), shot.ir) : shot.ir));
    EXPECT_EQ(client.stream.getMaxPixelValue(), 1023);
  }
}

TEST_F(Device, DepthAndInfraredAreOfTheSameShot) {
  Client depth(captured().frames, openni::SENSOR_DEPTH), infrared(captured().frames, openni::SENSOR_IR);
  ASSERT_EQ(depth.device.setProperty(openni::DEVICE_PROPERTY_PLAYBACK_SPEED, -1.0f), STATUS_OK);
  ASSERT_EQ(depth.stream.start(), STATUS_OK);
  ASSERT_EQ(infrared.stream.start(), STATUS_OK);
  const ReadFrame a = depth.read(), b = infrared.read();
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.time_us, b.time_us);
  EXPECT_EQ(depth.device.setDepthColorSyncEnabled(true), STATUS_OK);
}

TEST_F(Device, AFolderIsPlayedInALoop) {
  Client client(captured().frames, openni::SENSOR_DEPTH);
  ASSERT_TRUE(client.device.isFile());
  EXPECT_EQ(client.device.getPlaybackControl()->getNumberOfFrames(client.stream), 3);
  ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(-1.0f), STATUS_OK);  // a frame for each read
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  for (int i = 0; i < 7; ++i) {
    const ReadFrame frame = client.read();
    EXPECT_EQ(frame.number, 1 + i % 3);
    EXPECT_EQ(frame.time_us, static_cast<std::uint64_t>(i * 1'000'000LL / 30));
    EXPECT_EQ(frame.pixels, captured_mm(captured().frames, i % 3));
  }
}

TEST_F(Device, AFolderIsSoughtAndEnds) {
  Client client(captured().frames, openni::SENSOR_DEPTH);
  openni::PlaybackControl& playback = *client.device.getPlaybackControl();
  ASSERT_EQ(playback.setSpeed(0.0f), STATUS_OK);
  ASSERT_EQ(playback.setRepeatEnabled(false), STATUS_OK);
  ASSERT_EQ(playback.seek(client.stream, 2), STATUS_OK);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  EXPECT_EQ(client.read().number, 3);
  openni::VideoStream* streams[] = {&client.stream};
  int ready = 0;
  EXPECT_EQ(openni::OpenNI::waitForAnyStream(streams, 1, &ready, 300), openni::STATUS_TIME_OUT);
  EXPECT_EQ(playback.seek(client.stream, 1), STATUS_OK);
  EXPECT_EQ(client.read().number, 2);
  EXPECT_NE(playback.seek(client.stream, 3), STATUS_OK);
  EXPECT_NE(playback.setSpeed(-2.0f), STATUS_OK);
}

TEST_F(Device, PlaysAtTheRateOfTheDeviceOrAMultiple) {
  Client client(captured().frames, openni::SENSOR_DEPTH);
  ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(0.5f), STATUS_OK);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  client.read();
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 4; ++i) client.read();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(seconds, 3.0 / 15.0);  // the first may have waited; a busy machine only makes it longer
}

TEST_F(Device, SaysWhatTheXtionSays) {
  Client client(captured().scene, openni::SENSOR_DEPTH);
  EXPECT_NEAR(client.stream.getHorizontalFieldOfView(), 2 * std::atan(160.0 / kFocal_px), 1e-6);  // float
  EXPECT_NEAR(client.stream.getVerticalFieldOfView(), 2 * std::atan(120.0 / kFocal_px), 1e-6);
  EXPECT_EQ(client.stream.getMinPixelValue(), 0);
  EXPECT_EQ(client.stream.getMaxPixelValue(), 10000);
  EXPECT_EQ(client.property<std::uint64_t>(XN_STREAM_PROPERTY_ZERO_PLANE_DISTANCE), 120u);
  EXPECT_NEAR(client.property<double>(XN_STREAM_PROPERTY_ZERO_PLANE_PIXEL_SIZE), 120.0 / (2 * kFocal_px), 1e-12);
  EXPECT_EQ(client.property<double>(XN_STREAM_PROPERTY_EMITTER_DCMOS_DISTANCE), 7.5);
  EXPECT_EQ(client.property<std::uint64_t>(XN_STREAM_PROPERTY_CONST_SHIFT), 200u);
  EXPECT_EQ(client.property<std::uint64_t>(XN_STREAM_PROPERTY_PARAM_COEFF), 4u);
  EXPECT_EQ(client.property<std::uint64_t>(XN_STREAM_PROPERTY_SHIFT_SCALE), 10u);
  EXPECT_EQ(client.property<std::uint64_t>(XN_STREAM_PROPERTY_MAX_SHIFT), 2047u);
  EXPECT_FALSE(
      client.stream.isPropertySupported(XN_STREAM_PROPERTY_DCMOS_RCMOS_DISTANCE));  // there is no colour camera
  EXPECT_FALSE(client.device.hasSensor(openni::SENSOR_COLOR));

  // OpenNI2's formula of the properties above, which the driver does not use.
  const std::vector<std::uint16_t> s2d = client.table(XN_STREAM_PROPERTY_S2D_TABLE, 2048);
  const double pixel_cm = 120.0 / (2 * kFocal_px);
  for (int shift = 0; shift < 2047; ++shift) {
    const double metric = ((shift - 800) / 4.0 - 0.375) * pixel_cm;
    const double depth_mm = 10.0 * (metric * 120.0 / (7.5 - metric) + 120.0);
    const bool in_range = metric < 7.5 && std::floor(depth_mm) >= 450.0 && std::floor(depth_mm) <= 10000.0;
    ASSERT_EQ(s2d[shift], in_range ? static_cast<int>(depth_mm) : 0) << shift;
  }
  const std::vector<std::uint16_t> d2s = client.table(XN_STREAM_PROPERTY_D2S_TABLE, 10001);
  for (int shift = 1; shift < 2047; ++shift)
    if (s2d[shift] > s2d[shift - 1] && s2d[shift] < s2d[shift + 1]) {
      ASSERT_EQ(d2s[s2d[shift]], shift);
    }
}

TEST_F(Device, GivesShiftsThatItsTableTakesToDepths) {
  Client client(captured().frames, openni::SENSOR_DEPTH);
  const std::vector<std::uint16_t> s2d = client.table(XN_STREAM_PROPERTY_S2D_TABLE, 2048);
  client.set_mode(openni::PIXEL_FORMAT_SHIFT_9_2, sensor().width);
  EXPECT_EQ(client.stream.getMaxPixelValue(), 2047);
  ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(-1.0f), STATUS_OK);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  std::vector<std::uint16_t> depth = client.read().pixels;
  for (std::uint16_t& pixel : depth) pixel = s2d.at(pixel);
  EXPECT_EQ(depth, captured_mm(captured().frames, 0));
}

TEST_F(Device, RegistersDepthToWhereAColourCameraStands) {
  Client client(captured().frames, openni::SENSOR_DEPTH);
  EXPECT_EQ(client.device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  ASSERT_TRUE(client.device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  ASSERT_EQ(client.device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), STATUS_OK);
  EXPECT_EQ(client.device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(-1.0f), STATUS_OK);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  const RecordedCapture recorded = read_capture(captured().frames);
  const Image<float> depth = depth_image(recorded.sensor(), read_frame(recorded, 0, false).disparity_px);
  EXPECT_EQ(client.read().pixels,
            in_units(registered_to_colour(depth, recorded.sensor().focal_px, recorded.sensor().focal_px), 1e-3));
}

/// The captured scene with effects, and its recording.
std::pair<std::string, std::string> capture_with(const Captured& captured, const std::string& name,
                                                 const char* effects) {
  const std::string scene = (captured.folder / (name + ".json")).string(), frames = (captured.folder / name).string();
  Json json = captured.setup.source;
  json["effects"] = Json::parse(effects);
  write_json(scene, json);
  const ProgramRun run = run_fathom(fmt::format("capture {} --mode geometric -o {} --quiet", scene, frames));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return {scene, frames};
}

std::vector<std::uint16_t> written_mm(const std::string& folder) {
  const Image<std::uint16_t> depth = read_png_grey(folder + "/depth.png");
  return {depth.pixels().begin(), depth.pixels().end()};
}

TEST_F(Device, ADeviceThatErrsGivesTheDepthsOfItsCaptureAndWhatItBelieves) {
  const auto [scene, frames] = capture_with(
      captured(), "erring", R"([{"name": "focal_length", "focal_px": 5}, {"name": "baseline", "baseline_mm": 1},
                                   {"name": "depth_step_phase", "phase_steps": 0.5},
                                   {"name": "depth_quantization", "law": 1, "step_px": 0.5}])");
  for (const std::string& uri : {scene, frames}) {
    Client client(uri, openni::SENSOR_DEPTH);
    EXPECT_NEAR(client.stream.getHorizontalFieldOfView(), 2.0 * std::atan(160.0 / kFocal_px), 1e-6);  // a float
    EXPECT_NEAR(client.property<double>(XN_STREAM_PROPERTY_ZERO_PLANE_PIXEL_SIZE), 120.0 / (2 * kFocal_px), 1e-12);
    EXPECT_EQ(client.property<double>(XN_STREAM_PROPERTY_EMITTER_DCMOS_DISTANCE), 7.5);
  }
  Client client(frames, openni::SENSOR_DEPTH);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  EXPECT_EQ(client.read().pixels, written_mm(frames));
}

TEST_F(Device, ARecordingInTheColoursViewStartsRegistered) {
  const auto [scene, frames] =
      capture_with(captured(), "colour", R"([{"name": "colour_registration", "registered": 1}])");
  Client client(frames, openni::SENSOR_DEPTH);
  EXPECT_EQ(client.device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  EXPECT_NEAR(client.stream.getHorizontalFieldOfView(), 2.0 * std::atan(160.0 / kColourFocalPx), 1e-6);  // a float
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  EXPECT_EQ(client.read().pixels, written_mm(frames));
  client.stream.stop();
  ASSERT_EQ(client.device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_OFF), STATUS_OK);
  EXPECT_NEAR(client.stream.getHorizontalFieldOfView(), 2.0 * std::atan(160.0 / kFocal_px), 1e-6);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  EXPECT_EQ(client.read().pixels, captured_mm(frames, 0));
}

TEST_F(Device, MirrorsAndCrops) {
  const std::vector<std::uint16_t> plain = captured_mm(captured().frames, 0);
  Client client(captured().frames, openni::SENSOR_DEPTH);
  EXPECT_FALSE(client.stream.getMirroringEnabled());
  ASSERT_EQ(client.stream.setMirroringEnabled(true), STATUS_OK);
  EXPECT_FALSE(client.stream.setCropping(300, 0, 21, 10) == STATUS_OK);  // reaches over the edge
  ASSERT_EQ(client.stream.setCropping(40, 50, 101, 31), STATUS_OK);
  ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(-1.0f), STATUS_OK);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  const ReadFrame frame = client.read();
  ASSERT_EQ(frame.width, 101);
  ASSERT_EQ(frame.height, 31);
  for (int y = 0; y < 31; ++y)
    for (int x = 0; x < 101; ++x)
      ASSERT_EQ(frame.pixels[y * 101 + x], plain[(50 + y) * 320 + 319 - (40 + x)]) << x << " " << y;
}

TEST_F(Device, RefusesModesThatItDoesNotHave) {
  Client client(captured().frames, openni::SENSOR_DEPTH);
  openni::VideoMode mode = client.stream.getVideoMode();
  mode.setFps(60);
  const auto says = [](const char* reason) {
    return std::string(openni::OpenNI::getExtendedError()).find(reason) != std::string::npos;
  };
  EXPECT_NE(client.stream.setVideoMode(mode), STATUS_OK);
  EXPECT_TRUE(says("does not have this video mode"));
  mode = client.stream.getVideoMode();
  mode.setPixelFormat(openni::PIXEL_FORMAT_DEPTH_100_UM);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  EXPECT_NE(client.stream.setVideoMode(mode), STATUS_OK);  // the size of frames is settled
  EXPECT_TRUE(says("stop it first"));
}

/// OpenNI2's own words around a line are a tab and a line break.
std::string error_of_opening(const std::string& uri) {
  openni::Device device;
  EXPECT_NE(device.open(uri.c_str()), STATUS_OK);
  return openni::OpenNI::getExtendedError();
}

TEST_F(Device, AWrongSceneIsAnsweredByItsOwnLine) {
  const std::string scene = (captured().folder / "wrong.json").string();
  write_json(scene, Json::parse(R"({"sensor": {"height_mm": 650, "pitch_deg": 60}, "cup": []})"));
  const std::string line = error_of_opening(scene);
  expect_error([&] { read_setup(scene); }, {line.substr(1, line.size() - 2)});
  EXPECT_NE(line.find(scene + ": /cup: unknown key 'cup'"), std::string::npos) << line;

  EXPECT_EQ(error_of_opening("no.json"), "\tno.json: no such file\n");
  std::filesystem::create_directory(captured().folder / "empty");
  EXPECT_NE(error_of_opening((captured().folder / "empty").string()).find("holds no complete capture"),
            std::string::npos);
  EXPECT_NE(error_of_opening(std::string(300, 'x') + ".json").find("is too long a path for OpenNI2"),
            std::string::npos);

  Json twice = captured().setup.source;
  twice["cups"].push_back(twice["cups"][0]);
  write_json(scene, twice);
  EXPECT_NE(error_of_opening(scene).find("/cups/1: stands in /cups/0"), std::string::npos);

  write_json(scene, captured().setup.source);  // mended, under the same name
  Client client(scene, openni::SENSOR_DEPTH);
}

TEST_F(Device, ASceneThatCannotBeShotIsAnsweredWhenItIsOpened) {
  const std::string scene = (captured().folder / "crowded.json").string();
  Json json = captured().setup.source;
  for (int i = 0; i < 64; ++i) {  // more liquids than a ray can be in
    json["cups"].push_back(json["cups"][0]);
    json["cups"].back()["position_mm"] = {120 * (i % 8), 1000 + 120 * (i / 8)};
  }
  write_json(scene, json);
  const std::string line = error_of_opening(scene);
  expect_error([&] { build_geometry(read_setup(scene).scene, 830.0); }, {line.substr(1, line.size() - 2)});
}

/// A copy of the captured frames whose `file` is damaged: cut to a part of its length, or with wrong bytes in the
/// middle.
class Damaged {
 public:
  Damaged(const Captured& captured, const std::string& file) : path_(fs::path(frames_) / file) {
    fs::copy(captured.frames, frames_, fs::copy_options::recursive);
  }
  void cut(double share) const {
    fs::resize_file(path_, static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(path_))));
  }
  void scribble() const {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(fs::file_size(path_) / 2));
    file << std::string(200, '\xff');
  }
  const std::string& frames() const { return frames_; }
  std::string path() const { return path_.string(); }

 private:
  TemporaryFolder folder_;
  std::string frames_ = (folder_ / "frames").string();
  fs::path path_;
};

void expect_one_line_about(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), text.size() - 1) << text;
}

TEST_F(Device, ADamagedRecordingIsNamedWhenItIsOpened) {
  for (const char* file : {"frame_0000/disparity.exr", "frame_0002/disparity.exr", "frame_0001/ir.exr"}) {
    const Damaged damaged(captured(), file);
    for (const double share : {0.95, 0.5, 0.01, 0.0}) {
      damaged.cut(share);
      expect_one_line_about(error_of_opening(damaged.frames()), damaged.path());
    }
    fs::remove(damaged.path());
    expect_one_line_about(error_of_opening(damaged.frames()), damaged.path());
    fs::copy(fs::path(captured().frames) / "truth.exr", damaged.path());  // an image, but with no channel of that name
    if (std::string(file).ends_with("ir.exr")) {
      expect_one_line_about(error_of_opening(damaged.frames()), damaged.path());  // and not of the size
    }
  }
}

TEST_F(Device, ADamagedFirstFrameIsNamedWhenTheStreamStarts) {
  const Damaged damaged(captured(), "frame_0000/disparity.exr");
  damaged.scribble();
  Client client(damaged.frames(), openni::SENSOR_DEPTH);
  EXPECT_NE(client.stream.start(), STATUS_OK);
  expect_one_line_about(openni::OpenNI::getExtendedError(), damaged.path());
}

TEST_F(Device, ADamagedLaterFrameIsNamedByTheStream) {
  const Damaged damaged(captured(), "frame_0002/disparity.exr");
  damaged.scribble();
  Client client(damaged.frames(), openni::SENSOR_DEPTH);
  ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(-1.0f), STATUS_OK);  // a frame for each read
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  EXPECT_EQ(client.read().number, 1);
  EXPECT_EQ(client.read().number, 2);
  openni::VideoStream* streams[] = {&client.stream};
  int ready = 0;
  EXPECT_EQ(openni::OpenNI::waitForAnyStream(streams, 1, &ready, 2000), openni::STATUS_TIME_OUT);
  OniVideoMode mode;
  EXPECT_NE(client.stream.getProperty(openni::STREAM_PROPERTY_VIDEO_MODE, &mode), STATUS_OK);
  const std::string said = openni::OpenNI::getExtendedError();  // and a line of OpenNI2's own
  EXPECT_NE(said.find(damaged.path()), std::string::npos) << said;
  client.stream.stop();
  EXPECT_NE(client.stream.start(), STATUS_OK);
  expect_one_line_about(openni::OpenNI::getExtendedError(), damaged.path());
}

TEST_F(Device, DetectNamesTheDamagedFileAtOnce) {
  for (const char* file : {"frame_0000/disparity.exr", "frame_0002/disparity.exr"})
    for (const bool cut : {true, false}) {
      const Damaged damaged(captured(), file);
      if (cut)
        damaged.cut(0.5);
      else
        damaged.scribble();
      const auto start = std::chrono::steady_clock::now();
      const ProgramRun run = run_fathom("detect --frames 3 --live " + damaged.frames());
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      EXPECT_EQ(run.exit_code, 1);
      EXPECT_NE(run.err.find("error: " + damaged.path() + ": "), std::string::npos) << run.err;
      EXPECT_EQ(run.err.find("imeout"), std::string::npos) << run.err;
      EXPECT_LT(seconds, 8.0);  // one is enough on an idle machine; the wait for a frame that does not come is 10
    }
}

TEST_F(Device, ARecordingPlaysBackTheSameFrames) {
  const std::string file = (captured().folder / "recording.oni").string();
  std::vector<ReadFrame> seen;
  {
    Client client(captured().frames, openni::SENSOR_DEPTH);
    ASSERT_EQ(client.device.getPlaybackControl()->setSpeed(-1.0f), STATUS_OK);
    openni::Recorder recorder;
    ASSERT_EQ(recorder.create(file.c_str()), STATUS_OK);
    ASSERT_EQ(recorder.attach(client.stream), STATUS_OK);
    ASSERT_EQ(recorder.start(), STATUS_OK);
    ASSERT_EQ(client.stream.start(), STATUS_OK);
    // The recorder starts on a thread of its own and says nothing of when: it has the last frames, not the first.
    for (int i = 0; i < 40; ++i) {
      seen.push_back(client.read());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    recorder.stop();
    recorder.destroy();
  }
  Client client(file, openni::SENSOR_DEPTH);
  openni::PlaybackControl& playback = *client.device.getPlaybackControl();
  const int recorded = playback.getNumberOfFrames(client.stream);
  ASSERT_GE(recorded, 3);
  ASSERT_LE(recorded, 40);
  ASSERT_EQ(playback.setSpeed(-1.0f), STATUS_OK);
  ASSERT_EQ(client.stream.start(), STATUS_OK);
  for (int i = 0; i < recorded; ++i) EXPECT_EQ(client.read().pixels, seen[seen.size() - recorded + i].pixels) << i;
  EXPECT_NEAR(client.stream.getHorizontalFieldOfView(), 2 * std::atan(160.0 / kFocal_px), 1e-6);
  EXPECT_EQ(client.property<double>(XN_STREAM_PROPERTY_EMITTER_DCMOS_DISTANCE), 7.5);
  EXPECT_EQ(client.table(XN_STREAM_PROPERTY_S2D_TABLE, 2048).size(), 2048u);
}

TEST(Devices, AreThoseThatTheEnvironmentLists) {
  ::setenv("FATHOM_DEVICES", "scenes/water.json::frames", 1);
  std::vector<std::string> uris;
  {
    const OpenNi2 openni2;
    openni::Array<openni::DeviceInfo> devices;
    openni::OpenNI::enumerateDevices(&devices);
    for (int i = 0; i < devices.getSize(); ++i)
      if (std::string(devices[i].getVendor()) == "Fathom") uris.emplace_back(devices[i].getUri());
  }
  ::unsetenv("FATHOM_DEVICES");
  EXPECT_EQ(uris, (std::vector<std::string>{"scenes/water.json", "frames"}));
}

}  // namespace
}  // namespace fathom
