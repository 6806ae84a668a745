#include "app/live_cloud.h"

#include <OpenNI.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/error.h"
#include "core/units.h"

namespace fathom {
namespace {

/// OpenNI2's words of its last error in one line.
std::string last_error() {
  std::string line;
  for (const char* at = openni::OpenNI::getExtendedError(); *at; ++at)
    if (!std::iscntrl(static_cast<unsigned char>(*at)))
      line += *at;
    else if (*at == '\n' && at[1])
      line += "; ";
  return line.empty() ? "OpenNI2 does not say why" : line;
}

void require(openni::Status status, const std::string& device) {
  if (status == openni::STATUS_OK) return;
  const std::string why = last_error();
  // The driver's own error names the file already.
  throw why.starts_with(device) ? Error(why) : Error(device, why);
}

double metres_per_unit(openni::PixelFormat format, const std::string& device) {
  if (format == openni::PIXEL_FORMAT_DEPTH_1_MM) return kMetresPerMm;
  if (format == openni::PIXEL_FORMAT_DEPTH_100_UM) return 0.1 * kMetresPerMm;
  throw Error(device, "gives depth in another format than 1 mm or 100 µm");
}

/// A URI may be a path. OpenNI2 asks all its drivers, and one of them would wait for a pipe's writer.
void require_no_special_file(const std::string& uri) {
  std::error_code none;
  if (std::filesystem::is_other(uri, none)) throw Error(uri, "is no regular file (a pipe, a socket or a device)");
}

/// Waits for a frame. A device that has failed keeps silent until it is asked for something, so it is asked.
void wait_for_frame(openni::VideoStream& stream, const std::string& device) {
  constexpr int kPatience_ms = 10000, kStep_ms = 250;
  openni::VideoStream* streams[] = {&stream};
  int ready = 0;
  openni::Status status = openni::STATUS_TIME_OUT;
  for (int waited_ms = 0; status == openni::STATUS_TIME_OUT && waited_ms < kPatience_ms; waited_ms += kStep_ms) {
    status = openni::OpenNI::waitForAnyStream(streams, 1, &ready, kStep_ms);
    OniVideoMode mode;
    if (status == openni::STATUS_TIME_OUT)
      require(stream.getProperty(openni::STREAM_PROPERTY_VIDEO_MODE, &mode), device);
  }
  require(status, device);
}

}  // namespace

struct LiveCamera::Session {
  Session() { require(openni::OpenNI::initialize(), "OpenNI2"); }
  ~Session() {
    stream.destroy();
    device.close();
    openni::OpenNI::shutdown();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  openni::Device device;
  openni::VideoStream stream;
};

LiveCamera::LiveCamera(const std::string& uri) : uri_(uri) {
  require_no_special_file(uri_);
  session_ = std::make_unique<Session>();
  if (uri_.empty()) {
    openni::Array<openni::DeviceInfo> devices;
    openni::OpenNI::enumerateDevices(&devices);
    if (devices.getSize() == 0)
      throw Error("OpenNI2", "there is no device; connect one, or name a URI that one of its drivers knows");
    uri_ = devices[0].getUri();
  }
  require(session_->device.open(uri_.c_str()), uri_);
  require(session_->stream.create(session_->device, openni::SENSOR_DEPTH), uri_);
  if (session_->stream.isPropertySupported(openni::STREAM_PROPERTY_MIRRORING))
    require(session_->stream.setMirroringEnabled(false), uri_);  // a real one starts mirrored
  require(session_->stream.start(), uri_);
}

LiveCamera::~LiveCamera() = default;

Image<CloudPoint> LiveCamera::next_cloud() {
  constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
  wait_for_frame(session_->stream, uri_);
  openni::VideoFrameRef frame;
  require(session_->stream.readFrame(&frame), uri_);

  const openni::VideoMode mode = frame.getVideoMode();
  const double unit = metres_per_unit(mode.getPixelFormat(), uri_);
  const double focal_x = 0.5 * mode.getResolutionX() / std::tan(0.5 * session_->stream.getHorizontalFieldOfView());
  const double focal_y = 0.5 * mode.getResolutionY() / std::tan(0.5 * session_->stream.getVerticalFieldOfView());
  Image<CloudPoint> cloud(frame.getWidth(), frame.getHeight(), {kInvalid, kInvalid, kInvalid, 0.0f});
  for (int y = 0; y < cloud.height(); ++y) {
    const auto* row = reinterpret_cast<const openni::DepthPixel*>(static_cast<const char*>(frame.getData()) +
                                                                  y * frame.getStrideInBytes());
    for (int x = 0; x < cloud.width(); ++x) {
      if (row[x] == 0) continue;
      const double z = row[x] * unit;
      const double right = x + frame.getCropOriginX() + 0.5 - 0.5 * mode.getResolutionX();
      const double down = y + frame.getCropOriginY() + 0.5 - 0.5 * mode.getResolutionY();
      cloud(x, y) = {static_cast<float>(z * right / focal_x), static_cast<float>(z * down / focal_y),
                     static_cast<float>(z), 0.0f};
    }
  }
  return cloud;
}

}  // namespace fathom
