#include "diagnosis/predict/designs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/json.h"
#include "core/units.h"
#include "diagnosis/measurement/cup_regions.h"
#include "diagnosis/predict/nuisances.h"
#include "diagnosis/predict/physics.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

/// What was poured where so far.
struct Measured {
  std::set<std::string> liquids;
  std::map<std::string, std::set<double>> fills_mm;
  std::set<double> distances_mm, laterals_mm;
};

Measured measured(const Measurement& measurement) {
  Measured found;
  for (const Observation& observation : measurement.observations) {
    const Factors& f = observation.factors;
    if (!has_cup(f) || f.within_mm) continue;
    found.distances_mm.insert(f.distance_mm);
    found.laterals_mm.insert(f.lateral_mm);
    if (!has_liquid(f)) continue;
    found.liquids.insert(f.liquid);
    found.fills_mm[f.liquid].insert(f.fill_mm);
  }
  return found;
}

std::vector<double> ends(const std::set<double>& values) {
  if (values.size() < 2) return {values.begin(), values.end()};
  return {*values.begin(), *values.rbegin()};
}

std::vector<double> without(std::vector<double> values, const std::set<double>& known) {
  std::erase_if(values, [&](double value) { return known.contains(value); });
  return values;
}

std::string lengths(const std::vector<double>& values_mm) {
  return fmt::format("{} mm", fmt::join(values_mm, " and "));
}

/// A scattering that lets no light in: what laboratories write of a liquid that they believe opaque.
const Json kOpaque = {{"index", 1.34}, {"absorption_per_mm", 0.003}, {"scattering_per_mm", 1000}, {"anisotropy", 0}};
constexpr double kMiddleFill_mm = 30.0;

bool is_opaque(const Json& medium) {
  constexpr double kOpaqueFrom_per_mm = 100.0;
  return medium.is_object() && medium.value("scattering_per_mm", 0.0) >= kOpaqueFrom_per_mm;
}

void add_other_liquids(const Measurement& measurement, const Measured& known, const MeasurementPlan& at_places,
                       std::vector<MeasurementPlan>& plans) {
  const auto is_poured = [&](const auto& is) {
    return std::any_of(known.liquids.begin(), known.liquids.end(), [&](const std::string& liquid) {
      const auto medium = measurement.rig.liquids.find(liquid);
      return medium != measurement.rig.liquids.end() && is(medium->second);
    });
  };
  const auto add = [&](const std::string& label, const Json& medium, std::string_view words) {
    const auto same_name = measurement.rig.liquids.find(label);
    if (same_name != measurement.rig.liquids.end() && same_name->second != SharedJson(medium)) return;
    MeasurementPlan plan = at_places;
    plan.name = fmt::format("{:g} mm of {}", kMiddleFill_mm, words);
    plan.fillings = {{label, kMiddleFill_mm}};
    plan.pours = 2;
    plan.media[label] = medium;
    plans.push_back(std::move(plan));
  };
  if (!is_poured([](const Json& medium) { return medium == Json("water"); })) add("water", "water", "clear water");
  if (!is_poured(is_opaque)) add("opaque_liquid", kOpaque, "a liquid that is surely opaque, such as white paint");
}

Observation observation(const Factors& factors, std::string_view observable, std::string_view region, int repeats) {
  Observation result;
  result.observable = observable;
  result.factors = factors;
  result.factors.region = region;
  result.repeats = repeats;
  return result;
}

/// All that a placement's clouds, or a table of heights, could give and that the model predicts.
void add_frame(const Factors& factors, int repeats, std::vector<Observation>& observations) {
  const auto add = [&](std::string_view observable, std::string_view region) {
    observations.push_back(observation(factors, observable, region, repeats));
  };
  if (factors.liquid != "none") {
    for (const std::string_view region : kCupRegionNames) add("height_mm", region);
    add("height_mm", kWholeInterior);
    for (const std::string_view of_walls : {"cup_x_mm", "cup_y_mm", "cup_radius_mm"}) add(of_walls, "walls");
  }
  for (const std::string_view of_desk : {"desk_height_mm", "desk_pitch_deg", "desk_roll_deg", "comb_strength",
                                         "comb_quarter", "comb_half", "millimetre_comb"})
    add(of_desk, "desk");
  for (const std::string_view region : kDeskRegionNames) add("desk_residual_mm", region);
}

std::vector<Observation> observations_of(const MeasurementPlan& plan, int session) {
  std::vector<Observation> observations;
  Factors factors;
  factors.session = session;
  factors.liquid = "none";
  if (plan.bare_desk_views > 0) add_frame(factors, plan.bare_desk_views, observations);
  for (const auto& [liquid, fill_mm] : plan.fillings)
    for (int pour = 0; pour < plan.pours; ++pour, ++factors.pour) {
      const double first_frame_s = factors.time_s + plan.wait_s();
      for (const double distance_mm : plan.distances_mm)
        for (const double lateral_mm : plan.laterals_mm)
          for (int i = 0; i < plan.placements; ++i, ++factors.placement) {
            factors.time_s += plan.wait_s();
            factors.stood_s = factors.time_s - first_frame_s;
            factors.liquid = liquid;
            factors.fill_mm = fill_mm, factors.distance_mm = distance_mm, factors.lateral_mm = lateral_mm;
            add_frame(factors, plan.trials, observations);
          }
    }
  return observations;
}

/// A laboratory that wrote down no more than heights will do so again.
void erase_unlike(const std::vector<Observation>& measured, std::vector<Observation>& planned) {
  const auto kind = [](const Observation& o) { return std::pair(o.observable, o.factors.region == kWholeInterior); };
  std::set<std::pair<std::string, bool>> kinds;
  for (const Observation& observation : measured) kinds.insert(kind(observation));
  std::erase_if(planned, [&](const Observation& observation) { return !kinds.contains(kind(observation)); });
}

}  // namespace

double MeasurementPlan::minutes() const {
  constexpr double kSetUp = 5.0, kPour = 3.0, kPlacement = 1.0;
  const double poured = static_cast<double>(fillings.size()) * pours;
  const double placed = poured * static_cast<double>(distances_mm.size() * laterals_mm.size()) * placements;
  return kSetUp + kPour * poured + (kPlacement + wait_min) * placed;
}

std::vector<MeasurementPlan> possible_plans(const Measurement& measurement) {
  constexpr double kHalfAnHour_min = 30.0;
  const Measured known = measured(measurement);
  std::vector<MeasurementPlan> plans{{.name = "9 bare-desk views", .bare_desk_views = 9}};
  if (known.distances_mm.empty()) return plans;
  MeasurementPlan at_places{.name = "",
                            .bare_desk_views = 3,
                            .distances_mm = ends(known.distances_mm),
                            .laterals_mm = ends(known.laterals_mm)};
  const auto add = [&](std::string name, const auto& change) {
    MeasurementPlan plan = at_places;
    plan.name = std::move(name);
    change(plan);
    if (!plan.distances_mm.empty() && !plan.laterals_mm.empty() && !plan.fillings.empty())
      plans.push_back(std::move(plan));
  };
  add(fmt::format("the empty cup at {} places", at_places.distances_mm.size() * at_places.laterals_mm.size()),
      [](MeasurementPlan& plan) {
        plan.fillings = {{"empty", 0.0}};
      });
  // An eighth and three quarters of the cup, in whole 5 mm.
  const double deep_mm = mm_from_metres(measurement.rig.cup.height() - measurement.rig.cup.bottom());
  const std::vector<double> fills_mm{5.0 * std::round(deep_mm / 40.0), 5.0 * std::round(0.75 * deep_mm / 5.0)};
  for (const auto& [liquid, poured_mm] : known.fills_mm) {
    const std::vector<double> others = without(fills_mm, poured_mm);
    add(fmt::format("{} {} deep", liquid, lengths(others)), [&, liquid = liquid](MeasurementPlan& plan) {
      for (const double fill_mm : others) plan.fillings.emplace_back(liquid, fill_mm);
      plan.pours = 2;
    });
    add(fmt::format("3 new pours of {}", liquid), [&, liquid = liquid, poured = poured_mm](MeasurementPlan& plan) {
      for (const double fill_mm : ends(poured)) plan.fillings.emplace_back(liquid, fill_mm);
      plan.pours = 3;
    });
  }
  const auto deepest_of_each = [&](MeasurementPlan& plan) {
    for (const auto& [liquid, poured_mm] : known.fills_mm) plan.fillings.emplace_back(liquid, *poured_mm.rbegin());
  };
  const std::vector<double> farther = without({200.0, 400.0, 500.0}, known.distances_mm);
  const std::vector<double> aside = without({-150.0, 150.0}, known.laterals_mm);
  add("the deepest fills at distances of " + lengths(farther), [&](MeasurementPlan& plan) {
    plan.distances_mm = farther;
    deepest_of_each(plan);
  });
  add("the deepest fills at laterals of " + lengths(aside), [&](MeasurementPlan& plan) {
    plan.laterals_mm = aside;
    deepest_of_each(plan);
  });
  add("the same pour again half an hour later", [&](MeasurementPlan& plan) {
    deepest_of_each(plan);
    plan.distances_mm.resize(1), plan.laterals_mm.resize(1);
    plan.placements = 2;
    plan.wait_min = kHalfAnHour_min;
  });
  add_other_liquids(measurement, known, at_places, plans);
  return plans;
}

Design design_of(const MeasurementPlan& plan, const Measurement& measurement, const std::vector<std::string>& effects,
                 const SharedJson& model_effects, const std::string& file) {
  int last_session = 0;
  for (const FrameRecord& frame : measurement.frames) last_session = std::max(last_session, frame.session);
  Measurement planned;
  planned.rig = measurement.rig;
  planned.unit = measurement.unit;  // whose bias is taken off there as well, as far as it is known
  planned.observations = observations_of(plan, last_session + 1);
  erase_unlike(measurement.observations, planned.observations);
  planned.rig.liquids.insert(plan.media.begin(), plan.media.end());
  Design design{plan.name, plan.minutes(), physics_of(planned, model_effects, file, effects).evidence};
  // What is not known of the bias counts in these places as if it had nothing to do with the campaign's: patterns have
  // numbers, not names.
  for (Nuisance& nuisance : design.evidence.nuisances)
    if (nuisance.name.starts_with(kUnitPattern)) nuisance.name += ", planned";
  return design;
}

}  // namespace fathom
