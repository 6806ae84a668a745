// A client of OpenNI2 that knows nothing but its interface, and what tests compare it with.
#pragma once

#include <OpenNI.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/scene/setup.h"
#include "tests/core/temporary_folder.h"

namespace fathom {

/// OpenNI2 between initialize() and shutdown().
class OpenNi2 {
 public:
  OpenNi2() { EXPECT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK) << openni::OpenNI::getExtendedError(); }
  ~OpenNi2() { openni::OpenNI::shutdown(); }
  OpenNi2(const OpenNi2&) = delete;
  OpenNi2& operator=(const OpenNi2&) = delete;
};

/// What a stream gave, as numbers that outlive it.
struct ReadFrame {
  int number, width, height;
  std::uint64_t time_us;
  std::vector<std::uint16_t> pixels;
};

/// An open device with a stream of one sensor.
class Client {
 public:
  Client(const std::string& uri, openni::SensorType sensor);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Fails the test when none comes within 20 s.
  ReadFrame read();
  /// The supported mode of that format and width.
  void set_mode(openni::PixelFormat format, int width);
  template <class T>
  T property(int id) {
    T value{};
    EXPECT_EQ(stream.getProperty(id, &value), openni::STATUS_OK) << id;
    return value;
  }
  std::vector<std::uint16_t> table(int id, std::size_t entries);

  openni::Device device;
  openni::VideoStream stream;
};

/// A small scene and what `fathom capture --frames 3` makes of it.
struct Captured {
  Captured();

  TemporaryFolder folder;
  std::string scene = (folder / "scene.json").string();
  std::string frames = (folder / "frames").string();
  Setup setup;
};

}  // namespace fathom
