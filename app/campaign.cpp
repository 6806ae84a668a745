// `fathom campaign`: a simulated measurement campaign, in the files that a laboratory would write.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/campaign_spec.h"
#include "app/commands.h"
#include "app/nominal_rig.h"
#include "core/error.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/rng.h"
#include "core/rows.h"
#include "core/table.h"
#include "core/units.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

struct CampaignOptions {
  fs::path spec;
  fs::path truth;
  int spp = kDefaultSamplesPerPixel;
};

/// What randomness is for, so that no two uses share a stream.
enum class Draw : std::uint64_t { fill = 1, place = 2, camera = 3 };

/// The cup, put down once: its trials follow. `number` counts from 0 over the campaign, as `pour` does.
struct Placement {
  int number, pour;
  const CampaignFilling* filling;
  double true_fill;                           ///< [m]
  Eigen::Vector2d nominal_place, true_place;  ///< [m] (lateral, distance)
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

std::vector<Placement> plan(const CampaignSpec& spec, std::uint64_t seed) {
  std::vector<Placement> placements;
  int pour = 0;
  for (const CampaignFilling& filling : spec.fillings)
    for (int i = 0; i < spec.pours; ++i, ++pour) {
      const double fill = poured(spec, filling, pour, seed);
      for (const double distance : spec.distances)
        for (const double lateral : spec.laterals)
          for (int j = 0; j < spec.placements; ++j) {
            const int number = static_cast<int>(placements.size());
            const Eigen::Vector2d nominal(lateral, distance);
            placements.push_back({number, pour, &filling, fill, nominal, put_down(spec, nominal, number, seed)});
          }
    }
  return placements;
}

fs::path cloud_file(const CampaignSpec& spec, const Placement& placement, int trial) {
  return fs::path("clouds") / fmt::format("{:06}.pcd", placement.number * spec.trials + trial);
}

Setup setup_of(const CampaignSpec& spec, const Placement& placement) {
  Cup cup{.shape = spec.cup, .position = placement.true_place, .filling = std::nullopt};
  if (placement.true_fill > 0.0) cup.filling = Filling{placement.filling->medium, placement.true_fill};
  return {.scene = {.desk = spec.desk, .cups = {std::move(cup)}, .objects = {}}, .rig = spec.rig, .source = {}};
}

/// Shoots the trials whose clouds are not there yet, or not whole: somebody may have copied the folder halfway.
int shoot(const CampaignSpec& spec, const Placement& placement, const CampaignOptions& options,
          const CommonOptions& common) {
  std::vector<int> missing;
  const SensorModel& sensor = spec.rig.sensor;
  for (int trial = 0; trial < spec.trials; ++trial)
    if (!is_whole_pcd(common.output / cloud_file(spec, placement, trial), sensor.width, sensor.height))
      missing.push_back(trial);
  if (missing.empty()) return 0;
  const std::uint64_t seed = Rng(common.seed, Draw::camera, placement.number).bits();
  Camera camera(setup_of(spec, placement), spec.mode, options.spp, seed);
  for (const int trial : missing)
    write_pcd(common.output / cloud_file(spec, placement, trial),
              camera.shoot(static_cast<std::uint64_t>(trial)).cloud);
  return static_cast<int>(missing.size());
}

/// One shot a second, one session.
Table frames_table(const CampaignSpec& spec, const std::vector<Placement>& placements) {
  Table table({"frame", "session", "pour", "placement", "trial", "time_s", "liquid", "fill_mm", "distance_mm",
               "lateral_mm", "cloud"});
  for (const Placement& p : placements)
    for (int trial = 0; trial < spec.trials; ++trial) {
      const std::string frame = fmt::format("{}", p.number * spec.trials + trial);
      table.add({frame, "0", fmt::format("{}", p.pour), fmt::format("{}", p.number), fmt::format("{}", trial), frame,
                 p.filling->liquid, fmt::format("{:g}", mm_from_metres(p.filling->fill)),
                 fmt::format("{:g}", mm_from_metres(p.nominal_place.y())),
                 fmt::format("{:g}", mm_from_metres(p.nominal_place.x())), cloud_file(spec, p, trial).string()});
    }
  return table;
}

Json truth_json(const std::vector<Placement>& placements) {
  Json list = Json::array();
  for (const Placement& p : placements)
    list.push_back({{"placement", p.number},
                    {"pour", p.pour},
                    {"liquid", p.filling->liquid},
                    {"fill_mm", mm_from_metres(p.true_fill)},
                    {"distance_mm", mm_from_metres(p.true_place.y())},
                    {"lateral_mm", mm_from_metres(p.true_place.x())}});
  return {{"placements", list}};
}

/// campaign.json says what the folder belongs to; clouds of anything else are never mixed in.
void check_folder(const fs::path& folder, const Json& identity) {
  const fs::path file = folder / "campaign.json";
  if (fs::exists(file)) {
    if (read_json(file) != identity)
      throw Error(file.string(), "is of another spec, seed or program version; choose another folder");
    return;
  }
  for (const char* name : {"clouds", "frames.csv", "rig.json"})
    if (fs::exists(folder / name)) throw Error((folder / name).string(), "is there already; choose another folder");
}

/// campaign.json comes first, so that a run cut short at any later moment can go on.
void claim_folder(const fs::path& folder, const Json& identity) {
  make_directory(folder);
  write_json(folder / "campaign.json", identity);
  make_directory(folder / "clouds");
  remove_leftovers(folder / "clouds");
}

void require_truth_outside(const fs::path& truth, const fs::path& folder) {
  const auto resolved = [](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); };
  const fs::path inside = resolved(truth).lexically_relative(resolved(folder));
  if (!inside.empty() && *inside.begin() != "..")
    throw UsageError("--truth must lie outside the folder of -o, which holds what a laboratory knows");
}

void run_campaign(const CampaignOptions& options, const CommonOptions& common) {
  if (!options.truth.empty()) require_truth_outside(options.truth, common.output);
  const CampaignSpec spec = read_campaign_spec(options.spec);
  const Json identity = {
      {"fathom", FATHOM_VERSION}, {"seed", common.seed}, {"spp", options.spp}, {"spec", spec.source}};
  const std::vector<Placement> placements = plan(spec, common.seed);
  check_folder(common.output, identity);
  if (!options.truth.empty()) write_json(options.truth, truth_json(placements));
  claim_folder(common.output, identity);
  write_json(common.output / "rig.json", json_from_laboratory_rig(spec.nominal));
  Progress progress("placement", placements.size(), common.quiet);
  int shot = 0;
  for (const Placement& placement : placements) {
    shot += shoot(spec, placement, options, common);
    progress.step();
  }
  const Table frames = frames_table(spec, placements);
  write_table(common.output / "frames.csv", frames);  // last: its presence says that the campaign is complete
  fmt::print("{}", format_rows({{"placements", static_cast<double>(placements.size()), ""},
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
  app.add_option("--spp", options->spp, "Samples per infrared pixel, on a square grid")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  return [options, &common] {
    require_output(common);
    run_campaign(*options, common);
  };
}

}  // namespace fathom
