// usage: read_depth URI
// The first depth image of a device, by OpenNI2 alone.
#include <OpenNI.h>

#include <cstdio>

int main(int argc, char** argv) {
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoFrameRef frame;
  if (argc != 2 || openni::OpenNI::initialize() != openni::STATUS_OK || device.open(argv[1]) != openni::STATUS_OK ||
      depth.create(device, openni::SENSOR_DEPTH) != openni::STATUS_OK || depth.start() != openni::STATUS_OK ||
      depth.readFrame(&frame) != openni::STATUS_OK) {
    std::fprintf(stderr, "error: %s\n", openni::OpenNI::getExtendedError());
    return 1;
  }
  const auto* pixels = static_cast<const openni::DepthPixel*>(frame.getData());
  const int count = frame.getWidth() * frame.getHeight();
  int measured = 0;
  for (int i = 0; i < count; ++i) measured += pixels[i] > 0;
  std::printf("%d of %d pixels have a depth\n", measured, count);
  return measured > count / 2 ? 0 : 1;
}
