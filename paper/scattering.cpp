// Which of the facts that the paper prints of its milk tea hold together: how much of it is matched, and how far below
// its surface, over all that is uncertain of the tea, the sensor and the fill.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/estimate.h"
#include "core/json.h"
#include "core/progress.h"
#include "core/rng.h"
#include "core/units.h"
#include "paper/figures.h"
#include "sim/sensor/turbid_part.h"

namespace fathom {
namespace {

constexpr double kMatched = 0.9;  ///< share of the surface; the paper says that it was measured, not how much of it
constexpr int kPlaces = 3, kDraws = 60, kPlacesOfDraw = 1;

/// Of which milk tea, seen by which sensor. Coefficients at 830 nm.
struct Assumptions {
  double milk;         ///< share of whole milk in the tea
  double milk_per_mm;  ///< reduced scattering coefficient of whole milk
  double anisotropy;   ///< g of Henyey & Greenstein's phase function, the only one there is
  double absorption_per_mm;
  double index;
  double fill_mm = 20.0;
  double height_mm = kPaperHeightMm;
  double dot_sigma_ir_px = PatternModel{}.dot_sigma_ir_px;
  double correlation_min = MatcherModel{}.correlation_min;
  double contrast_min_dn = MatcherModel{}.contrast_min;
  double block_px = MatcherModel{}.window_rows;

  double reduced_scattering_per_mm() const { return milk * milk_per_mm; }
};

/// What is uncertain, at values of its range.
struct Quantity {
  const char* name;
  const char* unit;
  double Assumptions::*of;
  std::vector<double> values;  ///< ascending; joint draws are even between the first and the last
};

// Sources: docs/diagnosis.md, "The paper's own 1 to 2 mm".
const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all{{"milk in the tea", "", &Assumptions::milk, {0.1, 0.2, 0.3, 0.4, 0.5}},
                                         {"milk's reduced scattering", "per mm", &Assumptions::milk_per_mm, {1.8, 3.0}},
                                         {"anisotropy g", "", &Assumptions::anisotropy, {0.6, 0.95}},
                                         {"absorption", "per mm", &Assumptions::absorption_per_mm, {0.0025, 0.008}},
                                         {"index", "", &Assumptions::index, {1.333, 1.339}},
                                         {"fill", "mm", &Assumptions::fill_mm, {10.0, 30.0}},
                                         {"sensor's height", "mm", &Assumptions::height_mm, {500.0, 800.0}},
                                         {"dot's deviation", "ir px", &Assumptions::dot_sigma_ir_px, {0.7, 1.2}},
                                         {"least correlation", "", &Assumptions::correlation_min, {0.45, 0.65}},
                                         {"least contrast", "DN", &Assumptions::contrast_min_dn, {1.0, 8.0}},
                                         {"block", "px", &Assumptions::block_px, {7.0, 11.0}}};
  return all;
}

const Medium& medium_in(const Setup& setup) { return setup.scene.cups.front().filling->medium; }

/// The library's milk tea, as if it were whole milk and tea.
Assumptions library_tea() {
  const Setup setup = paper_setup({"milk_tea", 20.0}, 300.0);
  const Medium& tea = medium_in(setup);
  const double milk = medium_in(paper_setup({"whole_milk", 20.0}, 300.0)).reduced_scattering();
  return {.milk = tea.reduced_scattering() / milk,
          .milk_per_mm = per_mm_from_per_metre(milk),
          .anisotropy = tea.anisotropy,
          .absorption_per_mm = per_mm_from_per_metre(tea.absorption),
          .index = tea.n(setup.rig.sensor.wavelength_nm)};
}

/// `device`: the sensor with its faults, whose dots and matcher were fitted to measured desks and milky plastic.
Setup setup_of(const Assumptions& assumed, double distance_mm, int place, bool device) {
  constexpr ImagePart kPart{0, 0, 144, 120};  // [px] the cup and what a match in it reads
  Json sensor = {{"height_mm", assumed.height_mm}};
  if (device) {
    sensor["model"] = "xtion_pro_live_device";
  } else {
    sensor["pattern"] = {{"dot_sigma_ir_px", assumed.dot_sigma_ir_px}};
    sensor["matcher"] = {{"correlation_min", assumed.correlation_min},
                         {"contrast_min_dn", assumed.contrast_min_dn},
                         {"window_columns", static_cast<int>(assumed.block_px)},
                         {"window_rows", static_cast<int>(assumed.block_px)}};
  }
  Setup setup = paper_setup({"milk_tea", assumed.fill_mm}, distance_mm, sensor);
  Cup& cup = setup.scene.cups.front();
  Medium& tea = cup.filling->medium;
  tea.index = ConstantIndex{assumed.index};
  tea.absorption = per_metre_from_per_mm(assumed.absorption_per_mm);
  tea.scattering = per_metre_from_per_mm(assumed.reduced_scattering_per_mm()) / (1.0 - assumed.anisotropy);
  tea.anisotropy = assumed.anisotropy;
  cup.position += metres_from_mm(place) * Eigen::Vector2d(1.7, 1.0);  // by part of the distance between dots

  SensorModel& model = setup.rig.sensor;
  const Eigen::Vector3d surface(cup.position.x(), cup.position.y(), metres_from_mm(kPaperBottomMm + assumed.fill_mm));
  const Eigen::Vector2d at =
      model.principal_px + model.focal_px * *setup.rig.rectified(surface - setup.rig.camera_in_world());
  ImagePart part = kPart;
  part.left = std::clamp(static_cast<int>(at.x()) - part.width / 2, 1, model.width - part.width - 1);
  part.top = std::clamp(static_cast<int>(at.y()) - part.height / 2, 1, model.height - part.height - 1);
  model.law.quantized = false;  // its steps move tea and desk alike
  model = sensor_of_part(model, part);
  return setup;
}

/// Pixels of the tea that the projector lights, those of them that are matched, and how much too low these read.
struct Reading {
  double lit = 0.0, matched = 0.0, sum_low_mm = 0.0;

  void add(const Reading& other) { lit += other.lit, matched += other.matched, sum_low_mm += other.sum_low_mm; }
  double share() const { return matched / lit; }
  double low_mm() const { return matched > 0.0 ? sum_low_mm / matched : std::numeric_limits<double>::quiet_NaN(); }
};

Reading read_milk_tea(const Setup& setup, std::uint64_t seed) {
  constexpr double kOutlierMm = 10.0;  // matched to something else
  Camera camera(setup, CaptureMode::photometric, kDefaultSamplesPerPixel, seed, LightModel::full);
  const Frame frame = camera.shoot(0);
  Reading reading;
  for (std::size_t i = 0; i < camera.truth().size(); ++i) {
    const TruePixel& truth = camera.truth().pixels()[i];
    if (truth.path != PathKind::scattered || !truth.apparent_depth) continue;
    ++reading.lit;
    if (!(frame.depth.pixels()[i] > 0.0f)) continue;
    const CloudPoint& point = frame.cloud.pixels()[i];
    const double height = (setup.rig.world_from_camera * Eigen::Vector3d(point.x, point.y, point.z)).z();
    const double low_mm = mm_from_metres(truth.position.z() - height);
    if (std::abs(low_mm) <= kOutlierMm) ++reading.matched, reading.sum_low_mm += low_mm;
  }
  return reading;
}

/// At several places, at each over the paper's distances.
struct Readings {
  std::vector<Reading> places;
  std::array<std::vector<Reading>, kSeenDistances> by_distance;
};

/// Of several places together, with errors from how they differ.
struct Measured {
  Reading all;
  double share_error, low_error_mm;

  explicit Measured(const std::vector<Reading>& places) {
    Mean share, low_mm;
    for (const Reading& place : places) {
      all.add(place), share.add(place.share());
      if (place.matched > 0.0) low_mm.add(place.low_mm());
    }
    share_error = share.estimate().standard_error;
    low_error_mm = low_mm.estimate().standard_error;
  }
};

Readings measure(const Assumptions& assumed, int places, std::uint64_t seed, bool device, Progress& progress) {
  Readings row;
  for (int place = 0; place < places; ++place) {
    Reading here;
    for (std::size_t d = 0; d < kSeenDistances; ++d) {
      const Reading reading =
          read_milk_tea(setup_of(assumed, kPaperDistancesMm[d], place, device), Rng(seed, place, d).bits());
      row.by_distance[d].push_back(reading), here.add(reading);
    }
    row.places.push_back(here);
    progress.step();
  }
  return row;
}

/// What is measured below a tenth is a few false matches.
constexpr double kChance = 0.1;

void add_row(Table& table, const std::string& quantity, double value, const std::string& unit, double scattering_per_mm,
             const Readings& readings) {
  const Measured measured(readings.places);
  const bool is_seen = measured.all.share() >= kChance;
  std::vector<std::string> cells{quantity,
                                 fmt::format("{:g}", value),
                                 unit,
                                 fmt::format("{:.3f}", scattering_per_mm),
                                 fmt::format("{:.3f}", measured.all.share()),
                                 fmt::format("{:.3f}", measured.share_error),
                                 is_seen ? mm_text(measured.all.low_mm()) : "",
                                 is_seen ? mm_text(measured.low_error_mm) : ""};
  for (const std::vector<Reading>& places : readings.by_distance)
    cells.push_back(is_seen ? mm_text(Measured(places).all.low_mm()) : "");
  table.add(cells);
}

bool is_as_low(double low_mm) { return low_mm >= kPrintedLeastLowMm && low_mm <= kPrintedMostLowMm; }

/// One of all teas, sensors and fills that are possible.
Assumptions drawn(const Assumptions& library, std::uint64_t seed) {
  Rng rng(seed);
  Assumptions assumed = library;
  for (const Quantity& quantity : quantities()) {
    const double low = quantity.values.front(), high = quantity.values.back();
    assumed.*quantity.of = low + (high - low) * rng.uniform();
  }
  assumed.block_px = 2.0 * std::floor(0.5 * assumed.block_px) + 1.0;  // odd
  return assumed;
}

/// "0.3 to 0.7 mm", without the outer twentieth on either side.
std::string range_text(std::vector<double> values, const char* unit) {
  if (values.empty()) return "no draw";
  std::sort(values.begin(), values.end());
  const std::size_t aside = values.size() / 20;
  return fmt::format("{:.1f} to {:.1f} {}", values[aside], values[values.size() - 1 - aside], unit);
}

std::string measured_text(const std::vector<Reading>& places) {
  const Measured measured(places);
  const std::string matched = fmt::format("{:.0f} % matched", 100.0 * measured.all.share());
  if (measured.all.share() < kChance) return matched;
  return fmt::format("{}, {:.2f} ± {:.2f} mm low", matched, measured.all.low_mm(), measured.low_error_mm);
}

std::string of_draws(int count) { return fmt::format("{} of {} draws", count, kDraws); }

}  // namespace

Figure reproduce_scattering(const ReproduceSettings& settings) {
  Figure figure{
      .name = "scattering",
      .title = "Milk tea: which printed facts hold together",
      .sentence = "The more milk the tea has, the more of it is matched, and the nearer to its surface.",
      .table = Table({"quantity", "value", "unit", "reduced_scattering_per_mm", "matched_share", "matched_error",
                      "low_mm", "low_error_mm", "low_at_200_mm", "low_at_300_mm", "low_at_400_mm", "low_at_500_mm"})};
  constexpr std::array kMilkOfDevice{0.2, 0.5, 1.0};
  const int places = std::max(settings.trials.value_or(kPlaces), 2);
  const Assumptions library = library_tea();
  std::size_t values = 0;
  for (const Quantity& quantity : quantities()) values += quantity.values.size();
  const std::size_t steps = (1 + values + kMilkOfDevice.size()) * places + kDraws * kPlacesOfDraw;
  Progress progress("place", steps, settings.quiet);

  const auto add = [&](const std::string& quantity, double value, const char* unit, const Assumptions& assumed,
                       const Readings& readings) {
    add_row(figure.table, quantity, value, unit, assumed.reduced_scattering_per_mm(), readings);
  };
  const Readings as_in_library = measure(library, places, settings.seed, false, progress);
  add("the library's milk tea", library.milk, "", library, as_in_library);
  std::vector<std::string> over_distance, of_device;
  for (std::size_t d = 0; d < kSeenDistances; ++d)
    over_distance.push_back(
        fmt::format("{:g} mm: {}", kPaperDistancesMm[d], measured_text(as_in_library.by_distance[d])));
  for (const Quantity& quantity : quantities())
    for (const double value : quantity.values) {
      Assumptions assumed = library;
      assumed.*quantity.of = value;
      add(quantity.name, value, quantity.unit, assumed, measure(assumed, places, settings.seed, false, progress));
    }
  for (const double milk : kMilkOfDevice) {
    Assumptions assumed = library;
    assumed.milk = milk;
    const Readings readings = measure(assumed, places, settings.seed, true, progress);
    add("as the device sees it: milk in the tea", milk, "", assumed, readings);
    of_device.push_back(fmt::format("{:.0f} % milk: {}", 100.0 * milk, measured_text(readings.places)));
  }

  Table cloud({"reduced_scattering_per_mm", "matched_share", "low_mm", "fill_error_mm"});
  int matched = 0, low = 0, both = 0, both_with_fill = 0;
  std::vector<double> scattering, low_mm, low_with_fill_mm;  // where it is matched
  for (int draw = 0; draw < kDraws; ++draw) {
    Rng rng(settings.seed, kPlaces, draw);
    const Assumptions assumed = drawn(library, rng.bits());
    const double fill_error_mm = kFillSigmaMm * rng.normal();
    const Reading reading = Measured(measure(assumed, kPlacesOfDraw, rng.bits(), false, progress).places).all;
    const bool is_matched = reading.share() >= kMatched, is_seen = reading.share() >= kChance;
    const bool is_low = is_seen && is_as_low(reading.low_mm());
    matched += is_matched, low += is_low, both += is_matched && is_low;
    both_with_fill += is_matched && is_as_low(reading.low_mm() + fill_error_mm);
    if (is_matched) {
      scattering.push_back(assumed.reduced_scattering_per_mm());
      low_mm.push_back(reading.low_mm()), low_with_fill_mm.push_back(reading.low_mm() + fill_error_mm);
    }
    cloud.add({fmt::format("{:.3f}", assumed.reduced_scattering_per_mm()), fmt::format("{:.3f}", reading.share()),
               is_seen ? mm_text(reading.low_mm()) : "", mm_text(fill_error_mm)});
  }

  figure.facts = {
      {fmt::format("The library's milk tea, μs′ = {:g} per mm", library.reduced_scattering_per_mm()),
       "matched, 1–2 mm low", measured_text(as_in_library.places)},
      {"The same, over the distances", "constant", fmt::format("{}", fmt::join(over_distance, "; "))},
      {"The same, as the device sees it", "matched, 1–2 mm low", fmt::format("{}", fmt::join(of_device, "; "))},
      {"All that is uncertain: at least 90 % are matched", "matched",
       fmt::format("{}, with μs′ of {}", of_draws(matched), range_text(scattering, "per mm"))},
      {"The same: light from below the surface reads 1 to 2 mm low", "1–2 mm low", of_draws(low)},
      {"The same: both", "both", of_draws(both)},
      {"The same: both, with an error of the fill of σ = 1 mm", "both", of_draws(both_with_fill)},
      {"Where 90 % are matched: how much too low, by light alone (90 % of draws)", "1–2 mm", range_text(low_mm, "mm")},
      {"The same, with the error of the fill", "1–2 mm", range_text(low_with_fill_mm, "mm")}};
  write_table(settings.folder / "scattering_draws.csv", cloud);
  draw_figure(settings, figure,
              R"(
set title 'Milk tea, all that is uncertain drawn at random: what is matched, and how far below its surface'
set xlabel 'share of the surface that is matched'
set ylabel 'light alone reads it too low by [mm]'
set cblabel 'reduced scattering coefficient μs'' [1/mm]' textcolor rgb ink
set palette defined (0 '#C6DFF0', 0.5 '#0072B2', 1 '#003E63'); set cbrange [0:1.5]
set xrange [0:1]; set yrange [-0.75:2.25]; set key bottom left Left reverse
set object 1 rectangle from 0.9, 1 to 1, 2 fs solid noborder fc rgb '#F6D9C6' behind
set label 1 'the paper: matched, 1–2 mm low' at 0.89, 1.5 right textcolor rgb red
plot 'scattering_draws.csv' using 'matched_share':'low_mm':'reduced_scattering_per_mm' with points pt 7 ps 1.1 lc palette \
       title 'a tea, a sensor, a fill, at 200 to 500 mm', \
     'scattering.csv' every ::1::5 using 'matched_share':'low_mm':'low_error_mm' with yerrorlines pt 5 ps 1 lw 1.5 lc rgb orange \
       title '10, 20, 30, 40, 50 % milk, else as in the library', \
     '' every ::26::28 using 'matched_share':'low_mm' with linespoints pt 9 ps 1.6 lw 1.5 lc rgb green \
       title '50 and 100 % milk, as the device sees it', \
     '' every ::0::0 using 'matched_share':'low_mm':(1) with yerrorbars pt 7 ps 2 lw 2.5 lc rgb red \
       title 'the library''s milk tea, with the fill''s error of ±1 mm')");
  return figure;
}

}  // namespace fathom
