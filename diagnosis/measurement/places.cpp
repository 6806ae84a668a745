#include "diagnosis/measurement/places.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "core/units.h"

namespace fathom {
namespace {

/// What a written place may mean.
struct PlaceReading {
  const char* mistake;
  double lateral_factor;
  double outer_radii;  ///< to be added to the distance
  const char* first_words;
  const char* last_words;
};

constexpr std::array<PlaceReading, kPlaceReadings> kReadings{{
    {"flipped_axis", -1.0, 0.0, "The lateral axis is flipped", "cups beside it stand mirrored"},
    {"unit_error", 10.0, 0.0, "Laterals were written down in centimetres, not in millimetres", "cups stand so"},
    {"unit_error", 25.4, 0.0, "Laterals were written down in inches, not in millimetres", "cups stand so"},
    {"unit_error", 1000.0, 0.0, "Laterals were written down in metres, not in millimetres", "cups stand so"},
    {"distance_to_front", 1.0, 1.0, "Distances were measured to the cup's front, not to its axis", "cups stand so"},
}};

/// Whether it says anything else than what is written.
bool moves(const PlaceReading& reading, const FrameRecord& frame) {
  return !frame.bare_desk() && (frame.lateral_m != 0.0 || reading.outer_radii != 0.0);
}

void apply(const PlaceReading& reading, const LaboratoryRig& rig, FrameRecord& frame) {
  frame.lateral_m = frame.lateral_m == 0.0 ? 0.0 : reading.lateral_factor * frame.lateral_m;
  frame.distance_m += reading.outer_radii * rig.cup.outer_radius(0.0);
}

/// Whether what is seen inside stands clear of the desk, as every cup's bottom does.
bool shows_bottom(const std::optional<FrameEstimates>& estimates) {
  constexpr double kLeastBottom = 0.002, kFewestPixels = 10.0;
  return estimates && estimates->interior.weight >= kFewestPixels && estimates->interior.mean > kLeastBottom;
}

/// Whether walls stand around where the cup should, of whatever cup they are.
bool shows_walls(const std::optional<FrameEstimates>& estimates) {
  constexpr double kNear = 0.006;  // [m] a hand's error; the fit reaches 12 mm
  return estimates && estimates->outline && estimates->outline->off.norm() < kNear;
}

/// Whether the desk is seen between the cup and the sensor: else its wall may be what stands in another cup.
bool shows_desk_in_front(std::span<const SensedPoint> points, const LaboratoryRig& rig, const Plane& desk,
                         const Eigen::Vector2d& cup) {
  constexpr double kFrom = 0.012, kTo = 0.024, kAside = 0.020;  // [m] clear of the matcher's windows at the wall
  constexpr double kFewest_px = 3.0;
  const Eigen::Isometry3d to_desk = desk_from_camera(desk);
  const Eigen::Vector2d axis = axis_from_camera(rig, cup);
  const Eigen::Vector2d to_sensor = -axis.normalized();
  double height = 0.0, seen = 0.0;
  for (const SensedPoint& sensed : points) {
    const Eigen::Vector3d point = to_desk * sensed.point.cast<double>();
    const Eigen::Vector2d from_axis = point.head<2>() - axis;
    const double ahead = from_axis.dot(to_sensor) - rig.cup.widest();
    if (ahead < kFrom || ahead > kTo || (from_axis - from_axis.dot(to_sensor) * to_sensor).norm() > kAside) continue;
    height += sensed.weight * point.z();
    seen += sensed.weight;
  }
  return seen >= kFewest_px && std::abs(height / seen) < 0.5 * rig.cup.bottom();
}

/// Whether walls as wide as the rig's cup stand there or nearby.
bool shows_width(const std::optional<FrameEstimates>& estimates) {
  constexpr double kAsWide = 0.003;  // [m]
  return estimates && estimates->outline && std::abs(estimates->outline->wider) < kAsWide;
}

/// Whether the rig's cup is where it should be.
bool shows_cup_of(const LaboratoryRig& rig, std::span<const SensedPoint> points,
                  const std::optional<FrameEstimates>& estimates, const Eigen::Vector2d& cup) {
  return shows_walls(estimates) && shows_width(estimates) && shows_desk_in_front(points, rig, estimates->desk, cup);
}

/// Cups that a reading moves, and those that stand where it says.
struct Count {
  int moved = 0, elsewhere = 0;
};

std::string sentence_of(const PlaceReading& reading, const std::map<int, Count>& of_sessions, std::size_t sessions) {
  Count all;
  std::vector<int> numbers;
  for (const auto& [session, count] : of_sessions) {
    all.moved += count.moved, all.elsewhere += count.elsewhere;
    numbers.push_back(session);
  }
  const std::string where =
      numbers.size() < sessions ? fmt::format(" in session {}", fmt::join(numbers, " and ")) : std::string();
  return fmt::format("{}{}: {} of {} {}.", reading.first_words, where, all.elsewhere, all.moved, reading.last_words);
}

}  // namespace

StandsElsewhere stands_elsewhere(std::span<const SensedPoint> points, const LaboratoryRig& rig,
                                 const FrameRecord& frame, const std::optional<FrameEstimates>& as_written) {
  StandsElsewhere stands{};
  if (frame.bare_desk() || shows_walls(as_written)) return stands;
  for (std::size_t i = 0; i < kPlaceReadings; ++i) {
    if (!moves(kReadings[i], frame)) continue;
    FrameRecord other = frame;
    apply(kReadings[i], rig, other);
    const Eigen::Vector2d place(other.lateral_m, other.distance_m);
    const std::optional<FrameEstimates> there = estimate_frame(points, rig, {place, frame.fill_m});
    stands[i] = shows_cup_of(rig, points, there, place) ||
                (shows_bottom(there) && !shows_bottom(as_written) && !shows_width(as_written));
  }
  return stands;
}

bool put_places_right(std::span<const StandsElsewhere> frames, Measurement& measurement) {
  constexpr int kFewest = 4;
  std::map<int, std::array<Count, kPlaceReadings>> sessions;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (std::size_t k = 0; k < kPlaceReadings; ++k) {
      Count& count = sessions[measurement.frames[i].session][k];
      count.moved += moves(kReadings[k], measurement.frames[i]);
      count.elsewhere += frames[i][k];
    }
  std::map<std::size_t, std::map<int, Count>> wrong;  // by reading, then by session
  for (const auto& [session, counts] : sessions)
    for (std::size_t k = 0; k < kPlaceReadings; ++k) {
      if (counts[k].elsewhere < kFewest || 2 * counts[k].elsewhere < counts[k].moved) continue;
      wrong[k][session] = counts[k];
      break;
    }
  for (const auto& [k, of_sessions] : wrong) {
    for (FrameRecord& frame : measurement.frames)
      if (of_sessions.contains(frame.session) && moves(kReadings[k], frame))
        apply(kReadings[k], measurement.rig, frame);
    measurement.mistakes.push_back({kReadings[k].mistake, sentence_of(kReadings[k], of_sessions, sessions.size())});
  }
  return !wrong.empty();
}

}  // namespace fathom
