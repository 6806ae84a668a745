#include "bench/bench_scene.h"

#include "core/files.h"

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

}  // namespace fathom
