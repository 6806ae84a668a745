#include "report/cup_shots_json.h"

#include <cmath>

#include "core/cup_profile.h"
#include "core/files.h"
#include "core/json.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/measurement/cup_shots.h"

namespace fathom {
namespace {

/// To a tenth of a millimetre: a point's noise is ten times that.
double tenths_mm(double metres) { return std::round(mm_from_metres(metres) * 10.0) / 10.0 + 0.0; }

template <class Vector>
void append_mm(const Vector& place, Json& to) {
  for (const double metres : place.template cast<double>()) to.push_back(tenths_mm(metres));
}

Json json_from(const CupShot& shot) {
  const FrameRecord& frame = *shot.frame;
  Json json = {{"frame", frame.frame},
               {"session", frame.session},
               {"pour", frame.pour},
               {"placement", frame.placement},
               {"liquid", frame.liquid},
               {"fill_mm", mm_from_metres(frame.fill_m)},
               {"distance_mm", mm_from_metres(frame.distance_m)},
               {"lateral_mm", mm_from_metres(frame.lateral_m)},
               {"camera_mm", Json::array()},
               {"points_mm", Json::array()}};
  append_mm(shot.camera, json["camera_mm"]);
  for (const Eigen::Vector3f& point : shot.points) append_mm(point, json["points_mm"]);
  return json;
}

}  // namespace

void write_cup_shots(const std::filesystem::path& folder, const Measurement& measurement,
                     std::span<const std::filesystem::path> folders) {
  constexpr std::size_t kMostPoints = 60'000;  // 1 MB
  Json json = {{"cup", profiles_json(measurement.rig.cup)},
               {"heights_within_mm", mm_from_metres(interior_radius(measurement.rig.cup))},
               {"shots", Json::array()}};
  for (const CupShot& shot : cup_shots(measurement, folders, kMostPoints)) json["shots"].push_back(json_from(shot));
  write_text(folder / kShotsFile, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace fathom
