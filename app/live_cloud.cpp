#include "app/live_cloud.h"

#include <OpenNI.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

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

void require(openni::Status status, const std::string& device, const std::string& hint = "") {
  if (status == openni::STATUS_OK) return;
  const std::string why = last_error();
  // Our driver's own error names the file already.
  throw why.starts_with(device) ? Error(why) : Error(device, why + hint);
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

void unmirror(openni::VideoStream& stream, const std::string& device) {
  if (stream.isPropertySupported(openni::STREAM_PROPERTY_MIRRORING))
    require(stream.setMirroringEnabled(false), device);  // a real one starts mirrored
}

/// The infrared mode of the depth mode's size and rate, if there is one.
std::optional<openni::VideoMode> mode_beside(const openni::SensorInfo& infrared, const openni::VideoMode& depth) {
  const openni::Array<openni::VideoMode>& modes = infrared.getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i)
    if (modes[i].getPixelFormat() == openni::PIXEL_FORMAT_GRAY16 &&
        modes[i].getResolutionX() == depth.getResolutionX() && modes[i].getResolutionY() == depth.getResolutionY() &&
        modes[i].getFps() == depth.getFps())
      return modes[i];
  return std::nullopt;
}

template <class Pixel>
const Pixel* row_of(const openni::VideoFrameRef& frame, int y) {
  return reinterpret_cast<const Pixel*>(static_cast<const char*>(frame.getData()) + y * frame.getStrideInBytes());
}

}  // namespace

struct LiveCamera::Session {
  Session() { require(openni::OpenNI::initialize(), "OpenNI2"); }
  ~Session() {
    stream.destroy();
    infrared.destroy();
    device.close();
    openni::OpenNI::shutdown();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  openni::Device device;
  openni::VideoStream stream, infrared;
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
  require(session_->device.open(uri_.c_str()), uri_,
          "; scenes and captures need Fathom's driver where OpenNI2 looks: package libfathom-openni2, or "
          "docs/virtual_xtion.md");
  require(session_->stream.create(session_->device, openni::SENSOR_DEPTH), uri_);
  unmirror(session_->stream, uri_);
  start_infrared();
  require(session_->stream.start(), uri_);
}

/// Not every device has such a stream beside depth. Clouds are without intensities then.
void LiveCamera::start_infrared() {
  openni::VideoStream& infrared = session_->infrared;
  const openni::SensorInfo* sensor = session_->device.getSensorInfo(openni::SENSOR_IR);
  if (!sensor) return;
  const auto mode = mode_beside(*sensor, session_->stream.getVideoMode());
  if (!mode || infrared.create(session_->device, openni::SENSOR_IR) != openni::STATUS_OK) return;
  if (infrared.setVideoMode(*mode) == openni::STATUS_OK) {
    unmirror(infrared, uri_);
    if (infrared.start() == openni::STATUS_OK) return;
  }
  infrared.destroy();
}

LiveCamera::~LiveCamera() = default;

Image<CloudPoint> LiveCamera::next_cloud() {
  constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
  const auto next_frame = [this](openni::VideoStream& stream) {
    openni::VideoFrameRef frame;
    wait_for_frame(stream, uri_);
    require(stream.readFrame(&frame), uri_);
    return frame;
  };
  const openni::VideoFrameRef frame = next_frame(session_->stream);
  const openni::VideoFrameRef infrared =
      session_->infrared.isValid() ? next_frame(session_->infrared) : openni::VideoFrameRef();
  const bool has_infrared =
      infrared.isValid() && infrared.getWidth() == frame.getWidth() && infrared.getHeight() == frame.getHeight() &&
      infrared.getCropOriginX() == frame.getCropOriginX() && infrared.getCropOriginY() == frame.getCropOriginY();

  const openni::VideoMode mode = frame.getVideoMode();
  const double unit = metres_per_unit(mode.getPixelFormat(), uri_);
  const double focal_x = 0.5 * mode.getResolutionX() / std::tan(0.5 * session_->stream.getHorizontalFieldOfView());
  const double focal_y = 0.5 * mode.getResolutionY() / std::tan(0.5 * session_->stream.getVerticalFieldOfView());
  Image<CloudPoint> cloud(frame.getWidth(), frame.getHeight(), {kInvalid, kInvalid, kInvalid, 0.0f});
  for (int y = 0; y < cloud.height(); ++y) {
    const auto* row = row_of<openni::DepthPixel>(frame, y);
    const auto* light = has_infrared ? row_of<openni::Grayscale16Pixel>(infrared, y) : nullptr;
    for (int x = 0; x < cloud.width(); ++x) {
      const float intensity = light ? light[x] : 0.0f;
      cloud(x, y).intensity = intensity;
      if (row[x] == 0) continue;
      const double z = row[x] * unit;
      const double right = x + frame.getCropOriginX() + 0.5 - 0.5 * mode.getResolutionX();
      const double down = y + frame.getCropOriginY() + 0.5 - 0.5 * mode.getResolutionY();
      cloud(x, y) = {static_cast<float>(z * right / focal_x), static_cast<float>(z * down / focal_y),
                     static_cast<float>(z), intensity};
    }
  }
  return cloud;
}

}  // namespace fathom
