#include "tests/openni2/client.h"

#include <fmt/format.h>

#include "core/json.h"
#include "tests/app/run_fathom.h"

namespace fathom {

Client::Client(const std::string& uri, openni::SensorType sensor) {
  EXPECT_EQ(device.open(uri.c_str()), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
  EXPECT_EQ(stream.create(device, sensor), openni::STATUS_OK) << openni::OpenNI::getExtendedError();
}

Client::~Client() {
  stream.stop();
  stream.destroy();
  device.close();
}

ReadFrame Client::read() {
  openni::VideoStream* streams[] = {&stream};
  int ready = 0;
  openni::VideoFrameRef frame;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, 20000) != openni::STATUS_OK ||
      stream.readFrame(&frame) != openni::STATUS_OK) {
    ADD_FAILURE() << "no frame: " << openni::OpenNI::getExtendedError();
    return {};
  }
  EXPECT_EQ(frame.getStrideInBytes(), 2 * frame.getWidth());
  EXPECT_EQ(frame.getDataSize(), 2 * frame.getWidth() * frame.getHeight());
  const auto* pixels = static_cast<const std::uint16_t*>(frame.getData());
  return {frame.getFrameIndex(), frame.getWidth(), frame.getHeight(), frame.getTimestamp(),
          std::vector(pixels, pixels + frame.getDataSize() / 2)};
}

void Client::set_mode(openni::PixelFormat format, int width) {
  const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i)
    if (modes[i].getPixelFormat() == format && modes[i].getResolutionX() == width) {
      EXPECT_EQ(stream.setVideoMode(modes[i]), openni::STATUS_OK);
      return;
    }
  ADD_FAILURE() << "there is no mode of format " << format << " and width " << width;
}

std::vector<std::uint16_t> Client::table(int id, std::size_t entries) {
  std::vector<std::uint16_t> values(entries);
  int size = static_cast<int>(entries * sizeof(std::uint16_t));
  EXPECT_EQ(stream.getProperty(id, values.data(), &size), openni::STATUS_OK) << id;
  EXPECT_EQ(size, static_cast<int>(entries * sizeof(std::uint16_t))) << id;
  return values;
}

Captured::Captured() {
  // A quarter of the pixels, so that a shot takes a fraction of a second.
  const Json json = Json::parse(R"({
    "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0], "ir_size_px": [640, 512],
               "depth_size_px": [320, 240], "focal_px": 285.171},
    "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}]})");
  write_json(scene, json);
  setup = read_setup(scene);
  const ProgramRun run = run_fathom(fmt::format("capture {} --frames 3 -o {} --quiet", scene, frames));
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

}  // namespace fathom
