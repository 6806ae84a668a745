#include "detector/settings_json.h"

#include <cmath>

#include "core/fields.h"
#include "core/files.h"
#include "core/input_policy.h"

namespace fathom {
namespace {

constexpr Range kShare{0.0, 1.0}, kSomeShare{0.0, 1.0, true}, kMost{0.5, 1.0}, kCount{1.0, 1e6};

/// Of both methods' searches for the desk.
template <class Search>
std::span<const Field<Search>> plane_fields() {
  static const Field<Search> fields[] = {
      {"plane_threshold_mm", Length{&Search::threshold_m}, kPositive, "points of a plane are no farther from it"},
      {"plane_share_min", &Search::share_min, kSomeShare, "least share of the points that a plane holds"},
      {"prior_angle_max_deg",
       Angle{&Search::prior_angle_max_rad},
       {0.0, 180.0, true},
       "most that the desk is tilted against where it should be, where the sensor's place is given"},
      {"prior_height_max_mm", Length{&Search::prior_height_max_m}, kPositive,
       "the same of the sensor's height above it"}};
  return fields;
}

/// Of what is level inside a cup.
template <class Inside, int fewest>
std::span<const Field<Inside>> inside_fields() {
  static const Field<Inside> fields[] = {{"interior_margin_mm", Length{&Inside::margin_m}, kNonNegative,
                                          "points inside a cup are farther from its wall than this"},
                                         {"interior_points_min",
                                          &Inside::points_min,
                                          {fewest, kCount.high},
                                          "with fewer points nothing is said of what is inside"}};
  return fields;
}

std::span<const Field<SegmentSearch>> segment_fields() {
  static const Field<SegmentSearch> fields[] = {
      {"reach_mm",
       Length{&SegmentSearch::reach_m},
       {100.0, 5000.0},
       "things are looked for no farther from below the sensor"},
      {"segment_points_min", &SegmentSearch::points_min, kCount, "fewest points of what stands together"}};
  return fields;
}

std::span<const Field<WallSearch>> wall_fields() {
  static const Field<WallSearch> fields[] = {
      {"wall_tolerance_mm", Length{&WallSearch::tolerance_m}, kPositive, "points of a wall are no farther from it"},
      {"hypotheses", &WallSearch::hypotheses, kCount, "circles that are tried for each wall"}};
  return fields;
}

std::span<const Field<CupLimits>> limit_fields() {
  static const Field<CupLimits> fields[] = {
      {"radius_mm", LengthRange{&CupLimits::radius_min_m, &CupLimits::radius_max_m}, "radii of cups"},
      {"height_mm", LengthRange{&CupLimits::height_min_m, &CupLimits::height_max_m}, "heights of cups"},
      {"lean_max_deg",
       Part<CupLimits>{[](const JsonReader& json, CupLimits& limits) {
                         limits.lean_max = std::tan(radians_from_deg(json.number({0.0, 80.0})));
                       },
                       [](const CupLimits& limits) { return Json(deg_from_radians(std::atan(limits.lean_max))); }},
       {0.0, 80.0},
       "most that a cup's wall leans"},
      {"radius_sigma_max_mm", Length{&CupLimits::radius_sigma_max_m}, kPositive,
       "a wall whose radius is less certain is no cup's"},
      {"lid_share_max", &CupLimits::lid_share_max, kShare,
       "largest share of the lines of sight into the opening that end at a lid"},
      {"beyond_share_max", &CupLimits::beyond_share_max, kShare,
       "largest share of the lines of sight to the wall that end behind it"},
      {"inside_points_min",
       &CupLimits::inside_min,
       {0.0, kCount.high},
       "fewest points inside that show that it is open"}};
  return fields;
}

std::span<const Field<VesselRaysSettings>> ray_fields() {
  static const Field<VesselRaysSettings> fields[] = {
      {"lid_mm", Length{&VesselRaysSettings::lid_m}, kNonNegative, "what ends less deep below the rim is a lid"}};
  return fields;
}

std::span<const Field<UsualBottom>> bottom_fields() {
  static const Field<UsualBottom> fields[] = {
      {"bottom_mm", Length{&UsualBottom::height_m}, kNonNegative, "height of bottoms that no template knows"},
      {"bottom_sigma_mm", Length{&UsualBottom::sigma_m}, kPositive, "its standard deviation"}};
  return fields;
}

std::span<const Field<RobustConfig>> robust_fields() {
  static const Field<RobustConfig> fields[] = {
      {"baseline_mm", Length{&RobustConfig::baseline_m}, kNonNegative, "between camera and projector"}};
  return fields;
}

std::span<const Field<FillSettings>> fill_fields() {
  static const Field<FillSettings> fields[] = {
      {"index", &FillSettings::index, {1.0, 2.0, true}, "refractive index of clear liquids"},
      {"liquid_prior", &FillSettings::liquid_prior, kShare, "probability of a liquid before anything is seen"},
      {"liquid_sure", &FillSettings::liquid_sure, kMost, "from this probability the answer is yes"},
      {"dry_sure", &FillSettings::dry_sure, kMost, "from this probability of no liquid the answer is no"},
      {"kind_sure", &FillSettings::kind_sure, kMost, "from this probability a liquid's kind is told"}};
  return fields;
}

auto tables_of(RobustConfig& config) {
  return std::tuple{FieldsOf<DeskSearch>{plane_fields<DeskSearch>(), config.desk},
                    FieldsOf<SegmentSearch>{segment_fields(), config.segments},
                    FieldsOf<WallSearch>{wall_fields(), config.wall},
                    FieldsOf<CupLimits>{limit_fields(), config.cup},
                    FieldsOf<VesselRaysSettings>{ray_fields(), config.rays},
                    FieldsOf<SurfaceSettings>{inside_fields<SurfaceSettings, 3>(), config.surface},
                    FieldsOf<UsualBottom>{bottom_fields(), config.bottom},
                    FieldsOf<RobustConfig>{robust_fields(), config},
                    FieldsOf<FillSettings>{fill_fields(), config.fill}};
}

std::span<const Field<PlaneSearch>> repeat_fields() {
  static const Field<PlaneSearch> fields[] = {
      {"planes_max", &PlaneSearch::planes_max, {1.0, 100.0}, "planes that are looked for at the most"},
      {"plane_iterations_max", &PlaneSearch::iterations_max, kCount, "of RANSAC for each of them"}};
  return fields;
}

std::span<const Field<PaperConfig>> cluster_fields() {
  static const Field<PaperConfig> fields[] = {
      {"height_max_mm", Length{&PaperConfig::height_max_m}, kPositive, "points higher above the desk are no cup's"},
      {"cluster_distance_mm", Length{&PaperConfig::cluster_distance_m}, kPositive,
       "points that are nearer to one another stand together"},
      {"cluster_points_min", &PaperConfig::cluster_points_min, kCount, "fewest points of what stands together"}};
  return fields;
}

std::span<const Field<CupGates>> gate_fields() {
  static const Field<CupGates> fields[] = {
      {"width_mm", LengthRange{&CupGates::width_min_m, &CupGates::width_max_m}, "widths of cups with their handles"},
      {"top_min_mm", Length{&CupGates::top_min_m}, kNonNegative, "a cup reaches at least so high"},
      {"band_mm", LengthRange{&CupGates::band_low_m, &CupGates::band_high_m},
       "heights between which a circle is fitted"},
      {"circle_rms_max_mm", Length{&CupGates::circle_rms_max_m}, kPositive, "largest RMS of that circle"},
      {"radius_mm", LengthRange{&CupGates::radius_min_m, &CupGates::radius_max_m}, "its radius"}};
  return fields;
}

std::span<const Field<IcpSettings>> icp_fields() {
  static const Field<IcpSettings> fields[] = {
      {"icp_score_max_mm", Length{&IcpSettings::score_max_m}, kPositive, "largest mean distance from the template"},
      {"icp_iterations_max", &IcpSettings::iterations_max, kCount, "of ICP"}};
  return fields;
}

std::span<const Field<RegistrationConfig>> registration_fields() {
  static const Field<RegistrationConfig> fields[] = {
      {"normal_radius_mm", Length{&RegistrationConfig::normal_radius_m}, kPositive, "of the neighbours of a normal"},
      {"feature_radius_mm", Length{&RegistrationConfig::feature_radius_m}, kPositive,
       "of the neighbours of a descriptor"},
      {"iterations", &RegistrationConfig::iterations, kCount, "samples of correspondences that are tried"},
      {"score_max_mm", Length{&RegistrationConfig::score_max_m}, kPositive, "largest mean distance from the template"}};
  return fields;
}

std::span<const Field<DetectorSettings>> settings_fields() {
  using Settings = DetectorSettings;
  static const Field<Settings> fields[] = {
      {"registration",
       Part<Settings>{[](const JsonReader& json, Settings& settings) {
                        read_fields(json, registration_fields(), settings.registration);
                      },
                      nullptr, "#/$defs/registration", "an object"},
       "parameters of `sac-ia` and `prerejective`"},
      {"robust",
       Part<Settings>{[](const JsonReader& json, Settings& settings) { read_fields(json, tables_of(settings.robust)); },
                      nullptr, "#/$defs/robust", "an object"},
       "parameters of the method `robust`"},
      {"templates",
       Part<Settings>{[](const JsonReader& json, Settings& settings) {
                        for (const JsonReader& item : json.items())
                          settings.templates.push_back(
                              load_template(path_named_in(item.file(), item.pointer(), item.text())));
                      },
                      nullptr, R"({"type": "array", "items": {"type": "string"}})", "a list of paths"},
       "files of `fathom template` beside this one; without them those that come with the program"}};
  return fields;
}

auto tables_of(DetectorSettings& settings) {
  PaperConfig& paper = settings.paper;
  return std::tuple{FieldsOf<PlaneSearch>{plane_fields<PlaneSearch>(), paper.plane},
                    FieldsOf<PlaneSearch>{repeat_fields(), paper.plane},
                    FieldsOf<PaperConfig>{cluster_fields(), paper},
                    FieldsOf<CupGates>{gate_fields(), paper.cup},
                    FieldsOf<IcpSettings>{icp_fields(), paper.icp},
                    FieldsOf<InteriorSettings>{inside_fields<InteriorSettings, 2>(), paper.interior},
                    FieldsOf<DetectorSettings>{settings_fields(), settings}};
}

}  // namespace

DetectorSettings detector_settings(const JsonReader& json) {
  DetectorSettings settings;
  read_fields(json, tables_of(settings));
  if (settings.templates.empty()) settings.templates = load_templates(data_directory() / "templates");
  return settings;
}

DetectorSettings read_detector_settings(const std::filesystem::path& path) {
  const Json json = path.empty() ? Json::object() : read_json(path);
  return detector_settings(JsonReader(json, path.string()));
}

std::vector<KeyTable> detector_key_tables() {
  DetectorSettings standard;
  return {{"", "", "The method `paper`, and the others' objects", key_rows(tables_of(standard))},
          {"robust", "robust", "The method `robust`", key_rows(tables_of(standard.robust))},
          {"registration", "registration", "The methods `sac-ia` and `prerejective`",
           key_rows(registration_fields(), standard.registration)}};
}

}  // namespace fathom
