// The raised bottom in closed form and exactly, for arrays.
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "core/units.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "theory/triangulation.h"

namespace fathom {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Rows of fill, distance, lateral, height, baseline [mm], index and pitch [°] (NaN: the sensor aims at the point), as
/// the program's `theory` takes them; rows of eq7, exact [mm], incidences at projector and camera [°], epipolar [px].
Numbers raised_bottoms(const Numbers& rows) {
  constexpr int kGiven = 7, kFound = 5;
  if (rows.ndim() != 2 || rows.shape(1) != kGiven) throw Error("rows", "must be n x 7");
  Numbers found({rows.shape(0), py::ssize_t{kFound}});
  const auto given = rows.unchecked<2>();
  auto result = found.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < given.shape(0); ++i) {
    theory::TriangulationSetup setup{.sensor_height = metres_from_mm(given(i, 3)),
                                     .baseline = metres_from_mm(given(i, 4)),
                                     .fill = metres_from_mm(given(i, 0)),
                                     .index = given(i, 5),
                                     .lateral = metres_from_mm(given(i, 2)),
                                     .distance = metres_from_mm(given(i, 1))};
    if (!std::isnan(given(i, 6))) setup.pitch = radians_from_deg(given(i, 6));
    try {
      const auto [eq7, exact] = theory::raised_bottom(setup);
      result(i, 0) = mm_from_metres(eq7);
      result(i, 1) = mm_from_metres(exact.height);
      result(i, 2) = deg_from_radians(exact.incidence_projector);
      result(i, 3) = deg_from_radians(exact.incidence_camera);
      result(i, 4) = exact.epipolar_mismatch_px;
    } catch (const std::invalid_argument& problem) {
      throw Error("theory", problem.what());
    }
  }
  return found;
}

}  // namespace

void define_theory_functions(py::module_& module) { module.def("raised_bottoms", &raised_bottoms, py::arg("rows")); }

}  // namespace fathom
