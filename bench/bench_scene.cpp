#include "bench/bench_scene.h"

#include "core/files.h"
#include "sim/render/truth.h"

namespace fathom {

BenchScene::BenchScene(Setup described)
    : setup(std::move(described)),
      geometry(build_geometry(setup.scene, setup.rig.sensor.wavelength_nm)),
      world(geometry),
      projector(world, setup.rig.projector_in_world()) {}

Setup paper_water() { return read_setup(data_directory() / "paper_water.json"); }

Setup slanted_plane() {
  Setup setup = paper_water();
  setup.scene.cups.clear();
  return setup;
}

Setup crop(Setup setup, int ir_width, int ir_height) {
  SensorModel& sensor = setup.rig.sensor;
  const double scale = sensor.ir_scale();
  const Eigen::Vector2i size(sensor.width, sensor.height);
  sensor.ir_width = ir_width;
  sensor.ir_height = ir_height;
  sensor.width = static_cast<int>(ir_width / scale);
  sensor.height = static_cast<int>(ir_height / scale);
  sensor.principal_px -= 0.5 * (size - Eigen::Vector2i(sensor.width, sensor.height)).cast<double>();
  return setup;
}

std::vector<Eigen::Vector2i> pixels_on_cups(const PointLight& projector, const Rig& rig) {
  constexpr int kDesk = 1;
  const int scale = static_cast<int>(rig.sensor.ir_scale());
  const Image<TruePixel> truth = trace_truth(projector, rig);
  std::vector<Eigen::Vector2i> pixels;
  for (int y = 0; y < scale * truth.height(); ++y)
    for (int x = 0; x < scale * truth.width(); ++x)
      if (const TruePixel& seen = truth(x / scale, y / scale); seen.object > kDesk || seen.path > PathKind::direct)
        pixels.emplace_back(x, y + rig.sensor.ir_first_row());
  return pixels;
}

}  // namespace fathom
