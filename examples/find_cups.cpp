// usage: find_cups CLOUD.pcd
// Cups and liquids in a cloud of a depth camera over a desk, by the detector's library alone.
#include <cstdio>
#include <exception>

#include <fathom/detector/read_cloud.h>
#include <fathom/detector/robust.h>
#include <fathom/detector/settings_json.h>

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: find_cups CLOUD.pcd\n");
    return 2;
  }
  const fathom::Cloud cloud = fathom::read_cloud(argv[1]);  // [m], camera frame: x right, y down, z forward
  const fathom::DetectorSettings settings = fathom::read_detector_settings({});  // with the templates that come along
  const fathom::Detection found = fathom::detect_robust(cloud, settings);
  if (!found.desk) {
    std::printf("%s\n", found.why.c_str());
    return 0;
  }
  std::printf("desk %.0f mm below the camera, %d segments, %zu cups\n", 1e3 * found.desk->plane.offset, found.segments,
              found.cups.size());
  for (const fathom::DetectedCup& cup : found.cups) {
    const Eigen::Vector3d& at = cup.center_in_camera;
    std::printf("cup at (%.3f, %.3f, %.3f) m, radius %.1f mm: liquid %s (%s)\n", at.x(), at.y(), at.z(),
                1e3 * cup.candidate.circle->radius_m, std::string(name_of(cup.liquid)).c_str(), cup.why.c_str());
  }
} catch (const std::exception& problem) {
  std::fprintf(stderr, "error: %s\n", problem.what());
  return 1;
}
