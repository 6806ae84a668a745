// usage: take_shot SCENE.json DIR
// The simulator in a program of one's own: one shot of a scene. DIR gets its preview.png, cloud.pcd and images.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>

#include <fathom/sim/sensor/capture.h>
#include <fathom/sim/sensor/capture_files.h>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: take_shot SCENE.json DIR\n");
    return 2;
  }
  const std::filesystem::path folder = argv[2];
  const std::uint64_t seed = 1;
  fathom::Camera camera(fathom::read_setup(argv[1]), fathom::CaptureMode::photometric, fathom::kDefaultSamplesPerPixel,
                        seed);
  const fathom::Frame frame = camera.shoot(0);
  std::filesystem::create_directories(folder);
  fathom::write_frame(folder, frame, camera.truth(), camera.setup().rig.sensor.noise.bits);
  const auto& depths = frame.depth.pixels();  // metres, 0 where nothing was measured
  const auto measured = std::count_if(depths.begin(), depths.end(), [](float depth) { return depth > 0.0f; });
  std::printf("%td of %zu pixels have a depth. Look at %s\n", measured, depths.size(),
              (folder / "preview.png").c_str());
} catch (const std::exception& problem) {
  std::fprintf(stderr, "error: %s\n", problem.what());
  return 1;
}
