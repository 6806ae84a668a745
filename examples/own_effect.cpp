// usage: own_effect SCENE.json MM
// An effect of one's own: cups stand on a wet ring. How much nearer the scene then looks.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <fathom/core/units.h>
#include <fathom/sim/effects/changes.h>
#include <fathom/sim/sensor/capture.h>

namespace {

void apply(fathom::Setup& setup, const fathom::EffectSetting& setting) {
  const double raised = fathom::metres_from_mm(setting.values[0]);
  fathom::for_each_cup(setup, [&](fathom::Cup&, fathom::CupShape& shape) {
    for (Eigen::Vector2d& point : shape.inner) point.y() += raised;
    for (Eigen::Vector2d& point : shape.outer) point.y() += raised;
  });
}

const fathom::Effect kWetRing{.id = "wet_ring",
                              .sentence = "The cup stands on a film of water.",
                              .parameters = {{"height_mm", "of the film", 0.0, 0.3, 0.0, 2.0}},
                              .citation = "one's own desk",
                              .confounded = {"cup_bottom_height"},
                              .discriminated_by = "wiping the desk",
                              .apply = apply};

double mean_depth(const fathom::Setup& setup) {
  fathom::Camera camera(setup, fathom::CaptureMode::geometric, 1, 1);
  const fathom::Frame frame = camera.shoot(0);
  double sum = 0.0, count = 0.0;
  for (const float depth : frame.depth.pixels())
    if (depth > 0.0f) sum += depth, ++count;
  return sum / count;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: own_effect SCENE.json MM\n");
    return 2;
  }
  fathom::Setup setup = fathom::read_setup(argv[1]);
  const double without = mean_depth(setup);
  char* end = nullptr;
  const double height_mm[] = {std::strtod(argv[2], &end)};
  if (end == argv[2] || *end != '\0') {
    std::fprintf(stderr, "error: MM must be a number, got '%s'\n", argv[2]);
    return 1;
  }
  kWetRing.apply(setup, {height_mm});
  std::printf("%s Mean depth less by %.4f mm.\n", std::string(kWetRing.sentence).c_str(),
              fathom::mm_from_metres(without - mean_depth(setup)));
} catch (const std::exception& problem) {
  std::fprintf(stderr, "error: %s\n", problem.what());
  return 1;
}
