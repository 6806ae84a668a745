// `fathom campaign`: a simulated measurement campaign, in the files that a laboratory would write.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands.h"
#include "app/output_size.h"
#include "app/print.h"
#include "campaign/campaign_spec.h"
#include "core/error.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/image_file.h"
#include "core/input_record.h"
#include "core/manifest.h"
#include "core/progress.h"
#include "core/rng.h"
#include "core/rows.h"
#include "core/table.h"
#include "core/units.h"
#include "diagnosis/measurement/laboratory_rig.h"
#include "sim/effects/effects_json.h"
#include "sim/sensor/capture_files.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct CampaignOptions {
  fs::path spec;
  fs::path truth, model;
  int spp = kDefaultSamplesPerPixel;
  bool infrared = false;
  bool yes = false;
};

/// What randomness is for, so that no two uses share a stream.
enum class Draw : std::uint64_t { fill = 1, place = 2, camera = 3, rig = 4 };

/// The cup, put down once, or the bare desk: its trials follow. `number` counts from 0 over the campaign's cups, as
/// `pour` does.
struct Placement {
  int session, number, pour;
  const CampaignFilling* filling;             ///< none: the bare desk
  double true_fill;                           ///< [m]
  Eigen::Vector2d nominal_place, true_place;  ///< [m] (lateral, distance)
  double time_s = 0.0, stood_s = 0.0;         ///< of its first shot, since the session and since the pour
  int first_frame = 0, trials = 0;
};

double poured(const CampaignSpec& spec, const CampaignFilling& filling, int pour, std::uint64_t seed) {
  if (filling.fill == 0.0) return 0.0;
  Rng rng(seed, Draw::fill, pour);
  return std::clamp(filling.fill + spec.nominal.fill_sigma_m * rng.normal(), 0.0, spec.deepest_fill());
}

Eigen::Vector2d put_down(const CampaignSpec& spec, const Eigen::Vector2d& nominal, int placement, std::uint64_t seed) {
  Rng rng(seed, Draw::place, placement);
  const double x = rng.normal(), y = rng.normal();
  return nominal + spec.nominal.placement_sigma_m * Eigen::Vector2d(x, y);
}

/// Every placement, in the order of time.
std::vector<Placement> plan(const CampaignSpec& spec, std::uint64_t seed) {
  std::vector<Placement> placements;
  int pours = 0, cups = 0, frames = 0;
  for (int session = 0; session < spec.sessions; ++session) {
    double time_s = 0.0, poured_s = 0.0;
    const auto add = [&](Placement placement, int trials) {
      placement.time_s = time_s;
      if (placement.filling) placement.stood_s = time_s - poured_s;
      placement.first_frame = frames;
      placement.trials = trials;
      frames += trials;
      time_s += trials * spec.frame_s;
      placements.push_back(placement);
    };
    if (spec.bare_desk_views > 0)
      add({session, 0, 0, nullptr, 0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}, spec.bare_desk_views);
    for (const CampaignFilling& filling : spec.fillings)
      for (int i = 0; i < spec.pours; ++i, ++pours) {
        const double fill = poured(spec, filling, pours, seed);
        time_s += spec.pour_s;
        poured_s = time_s;
        for (const double distance : spec.distances)
          for (const double lateral : spec.laterals)
            for (int j = 0; j < spec.placements; ++j, ++cups) {
              const Eigen::Vector2d nominal(lateral, distance);
              time_s += spec.placement_s;
              add({session, cups, pours, &filling, fill, nominal, put_down(spec, nominal, cups, seed)}, spec.trials);
            }
      }
  }
  return placements;
}

/// What the laboratory's numbers are off by, as effects.
Json rig_errors(const CampaignSpec& spec, std::uint64_t seed) {
  Json errors = Json::array();
  for (std::size_t i = 0; i < std::size(kRigValues); ++i) {
    const RigValue& value = kRigValues[i];
    const auto sigma = spec.nominal.sigma.find(value.key);
    if (sigma == spec.nominal.sigma.end()) continue;
    Rng rng(seed, Draw::rig, i);
    Json error = {{"name", value.effect}};
    error[value.parameter] = sigma->second * rng.normal();
    errors.push_back(std::move(error));
  }
  return errors;
}

constexpr const char* kFramesFile = "frames.csv";

std::string cloud_file(const Placement& placement, int trial) {
  return fmt::format("clouds/{:06}.pcd", placement.first_frame + trial);
}

std::string infrared_file(const Placement& placement, int trial) {
  return fmt::format("infrared/{:06}.png", placement.first_frame + trial);
}

Setup setup_of(const CampaignSpec& spec, const Placement& placement, const Json& effects, const std::string& file) {
  Setup setup{
      .scene = {.desk = spec.desk, .cups = {}, .objects = {}}, .rig = spec.rig, .file = file, .effects = effects};
  UnitModel& unit = setup.rig.sensor.unit;
  unit.on_for_s += placement.time_s;
  unit.frame_interval_s = spec.frame_s;
  setup.circumstances.time_s = placement.time_s;
  setup.circumstances.stood_s = placement.stood_s;
  setup.circumstances.liquids = spec.media;
  if (!placement.filling) return setup;
  setup.circumstances.liquid = placement.filling->liquid;
  Cup cup{.shape = spec.cup, .position = placement.true_place, .filling = std::nullopt};
  if (placement.true_fill > 0.0) cup.filling = Filling{placement.filling->medium, placement.true_fill};
  setup.scene.cups.push_back(std::move(cup));
  return setup;
}

/// Shoots the trials whose files are not there yet, or not as they were written.
int shoot(const CampaignSpec& spec, const Placement& placement, const Setup& setup, const CampaignOptions& options,
          const CommonOptions& common, Manifest& manifest) {
  std::vector<int> missing;
  for (int trial = 0; trial < placement.trials; ++trial)
    if (!manifest.holds(cloud_file(placement, trial)) ||
        (options.infrared && !manifest.holds(infrared_file(placement, trial))))
      missing.push_back(trial);
  if (missing.empty()) return 0;
  fs::remove(common.output / kFramesFile);  // while it is there the campaign counts as complete
  const std::uint64_t seed = placement.filling ? Rng(common.seed, Draw::camera, placement.number).bits()
                                               : Rng(common.seed, Draw::camera, placement.session, -1).bits();
  const Setup shot = with_effects(setup);
  Camera camera(shot, spec.mode, options.spp, seed, measured_light(shot));
  for (const int trial : missing) {
    const Frame frame = camera.shoot(static_cast<std::uint64_t>(trial));
    write_pcd(common.output / cloud_file(placement, trial), frame.cloud);
    manifest.add(cloud_file(placement, trial));
    if (!options.infrared) continue;
    write_png(common.output / infrared_file(placement, trial), whole_dn(frame.ir));
    manifest.add(infrared_file(placement, trial));
  }
  return static_cast<int>(missing.size());
}

Table frames_table(const CampaignSpec& spec, const std::vector<Placement>& placements, bool infrared) {
  std::vector<std::string> columns{"frame",  "session", "pour",        "placement",  "trial", "time_s",
                                   "liquid", "fill_mm", "distance_mm", "lateral_mm", "cloud"};
  if (infrared) columns.push_back("ir");
  Table table(std::move(columns));
  for (const Placement& p : placements)
    for (int trial = 0; trial < p.trials; ++trial) {
      std::vector<std::string> cells{fmt::format("{}", p.first_frame + trial),
                                     fmt::format("{}", p.session),
                                     fmt::format("{}", p.pour),
                                     fmt::format("{}", p.number),
                                     fmt::format("{}", trial),
                                     fmt::format("{:g}", p.time_s + trial * spec.frame_s),
                                     p.filling ? p.filling->liquid : "none",
                                     fmt::format("{:g}", p.filling ? mm_from_metres(p.filling->fill) : 0.0),
                                     fmt::format("{:g}", mm_from_metres(p.nominal_place.y())),
                                     fmt::format("{:g}", mm_from_metres(p.nominal_place.x())),
                                     cloud_file(p, trial)};
      if (infrared) cells.push_back(infrared_file(p, trial));
      table.add(std::move(cells));
    }
  return table;
}

Json truth_json(const std::vector<Placement>& placements, const Json& effects) {
  Json list = Json::array();
  for (const Placement& p : placements) {
    if (!p.filling) continue;
    list.push_back({{"placement", p.number},
                    {"pour", p.pour},
                    {"liquid", p.filling->liquid},
                    {"fill_mm", mm_from_metres(p.true_fill)},
                    {"distance_mm", mm_from_metres(p.true_place.y())},
                    {"lateral_mm", mm_from_metres(p.true_place.x())}});
  }
  return {{"effects", effects}, {"placements", list}};
}

void require_truth_outside(const fs::path& truth, const fs::path& folder) {
  const auto resolved = [](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); };
  const fs::path inside = resolved(truth).lexically_relative(resolved(folder));
  if (!inside.empty() && *inside.begin() != "..")
    throw UsageError("--truth must lie outside the folder of -o, which holds what a laboratory knows");
}

void run_campaign(const CampaignOptions& options, const CommonOptions& common) {
  if (!options.truth.empty()) require_truth_outside(options.truth, common.output);
  const InputRecord inputs;
  const CampaignSpec spec = read_campaign_spec(options.spec);
  if (options.infrared && spec.mode == CaptureMode::geometric)
    throw UsageError("--infrared needs a campaign of mode photometric: geometric frames have no images");
  Json effects = spec.effects;
  if (!options.model.empty())
    for (const Json& effect : effects_of_model(options.model)) effects.push_back(effect);
  for (const Json& error : rig_errors(spec, common.seed)) effects.push_back(error);
  const std::string size =
      require_space(common, {spec.frames(), frame_bytes(spec.rig.sensor, options.infrared)}, options.yes);
  const std::vector<Placement> placements = plan(spec, common.seed);
  const auto setup = [&](const Placement& p) { return setup_of(spec, p, effects, options.spec.string()); };
  with_effects(setup(placements.front()));  // a mistake in an effect shows before a folder is made
  with_effects(setup(placements.back()));   // and an effect of cups reads its files
  const RunIdentity identity{
      "campaign", {{"seed", common.seed}, {"spp", options.spp}, {"infrared", options.infrared}}, inputs.files()};

  const FolderOwner owner(common.output);
  Manifest manifest(common.output, identity);
  manifest.require_same_run(std::vector<std::string>{"clouds", "infrared", "frames.csv", "rig.json"});
  if (!options.truth.empty()) {
    if (options.truth.has_parent_path()) make_directory(options.truth.parent_path());
    write_json(options.truth, truth_json(placements, effects));
  }
  announce(common, size);
  manifest.begin();  // first, so that a run cut short at any later moment can go on
  std::vector<const char*> folders{"clouds"};
  if (options.infrared) folders.push_back("infrared");
  for (const char* folder : folders) {
    make_directory(common.output / folder);
    remove_leftovers(common.output / folder);
  }
  write_json(common.output / "rig.json", json_from_laboratory_rig(spec.nominal));
  Progress progress("placement", placements.size(), common.quiet);
  int shot = 0;
  for (const Placement& placement : placements) {
    shot += shoot(spec, placement, setup(placement), options, common, manifest);
    progress.step();
  }
  manifest.finish();
  const Table frames = frames_table(spec, placements, options.infrared);
  write_table(common.output / kFramesFile, frames);  // last: its presence says that the campaign is complete
  print_text(format_rows({{"placements", static_cast<double>(placements.size()), ""},
                          {"frames", static_cast<double>(frames.rows()), ""},
                          {"frames_shot_now", static_cast<double>(shot), ""}},
                         common.json));
}

}  // namespace

std::function<void()> define_campaign(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<CampaignOptions>();
  app.add_option("spec", options->spec, "Campaign file (*.json), see scenes/campaigns")->required()->type_name("SPEC");
  app.add_option("--truth", options->truth, "Where to write the true fills and places, which the folder never holds")
      ->type_name("T.json");
  app.add_option("--model", options->model, "Model of a diagnosis, whose effects are there as well")
      ->type_name("M.json");
  app.add_option("--spp", options->spp, "Samples per infrared pixel, on a square grid")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_flag("--infrared", options->infrared, "Infrared images beside the clouds, named in the column ir");
  app.add_flag("--yes", options->yes, "Also where it writes more than 20 GB");
  return [options, &common] { run_campaign(*options, common); };
}

}  // namespace fathom
