// `fathom verify`: certification of light transport, by the code that renders.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "app/results.h"
#include "app/verify_cases.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/json.h"
#include "core/progress.h"
#include "core/units.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/layer_light.h"
#include "sim/optics/walk_length.h"

namespace fathom {
namespace {

/// Verdicts fail beyond so many standard errors: a right program fails once in 370 quantities at a fresh seed.
constexpr double kMostDeviations = 3.0;

struct VerifyOptions {
  double index = 1.33;
  double absorption_per_mm = 0.0;
  double scattering_per_mm = 0.0;
  double anisotropy = 0.0;
  double thickness_mm = 0.0;
  double angle_deg = 0.0;
  double from = 1.0;
  double to = 1.0;
  std::uint64_t photons = 0;
};

using Estimates = std::vector<std::pair<std::string, Estimate>>;

constexpr Range kIndex{0.0, 10.0, true};
constexpr Range kPerMm{0.0, 1e9};
constexpr Range kAnisotropies{-0.9999, 0.9999};
constexpr Range kBeamDeg{0.0, 89.99};

/// Empty when the text is a thickness, which may be "inf".
std::string check_thickness(const std::string& text) {
  const std::string wrong = number_within(kPositive)(text);
  return wrong.empty() || text == "inf" ? std::string() : wrong + ", or inf";
}

/// A plan that shows its progress.
SamplingPlan plan_with(Progress& progress, std::uint64_t photons) {
  SamplingPlan plan;
  plan.samples = photons;
  plan.report = [&progress](std::uint64_t done, std::uint64_t expected) { progress.reach(done, expected); };
  return plan;
}

std::string text_of(const Estimates& estimates, bool as_json) {
  Json object = Json::object();
  for (const auto& [name, estimate] : estimates)
    object[name] = {{"value", estimate.value}, {"standard_error", estimate.standard_error}};
  if (as_json) return json_text(object);
  std::string text = fmt::format("{:<21}  {:>9}  {:>14}\n", "", "value", "standard error");
  for (const auto& [name, estimate] : estimates)
    text += fmt::format("{:<21}  {:>9.6f}  {:>14.6f}\n", name, estimate.value, estimate.standard_error);
  return text;
}

/// Throws Error where the walks would take longer than anybody waits.
void require_short_walks(const Layer& slab, double angle, std::uint64_t photons) {
  constexpr double kWalksAtOnce = 16384.0;  // between two looks at the work that was done
  constexpr double kMostSteps = 2e9;        // of the walks at once: a minute or two
  constexpr double kMostStepsAsked = 1e12;  // of all walks that --photons asks for: hours
  if (!std::isfinite(slab.thickness) && slab.medium.absorption == 0.0) return;  // gives all back, without any walk
  const double steps = expected_steps(slab, angle);
  if (const double most = kMostSteps / kWalksAtOnce; !(steps <= most))
    throw Error(
        "verify slab",
        fmt::format("a walk is expected to take {:.1e} scatterings and reflections, at most {:.1e} are allowed; "
                    "it takes fewer with less scattering, more absorption or another thickness",
                    steps, most));
  if (!(static_cast<double>(photons) * steps <= kMostStepsAsked))
    throw Error(
        "verify slab",
        fmt::format("--photons: {} walks of {:.1e} scatterings and reflections each are too many, at most {:.0f} "
                    "walks are allowed",
                    photons, steps, std::floor(kMostStepsAsked / steps)));
}

void verify_slab(const VerifyOptions& options, const CommonOptions& common) {
  const Turbid medium{options.index, per_metre_from_per_mm(options.absorption_per_mm),
                      per_metre_from_per_mm(options.scattering_per_mm), options.anisotropy};
  const Layer slab{medium, metres_from_mm(options.thickness_mm)};
  const double angle = radians_from_deg(options.angle_deg);
  require_short_walks(slab, angle, options.photons);
  Progress progress("walks", 0, common.quiet);
  const LayerLight light =
      light_in_layers(LayerSpace({slab}), angle, common.seed, plan_with(progress, options.photons));
  Estimates estimates{{"reflectance_total", light.reflectance},
                      {"reflectance_specular", {light.specular, 0.0}},
                      {"transmittance_total", light.transmittance}};
  if (light.absorptance) estimates.emplace_back("absorptance", *light.absorptance);
  print_results(common, "slab", ".txt", text_of(estimates, common.json));
  if (!light.reached)
    print_note(fmt::format("gave up after {} walks, before the standard errors were 0.2 % of the values", light.walks));
}

void verify_fresnel(const VerifyOptions& options, const CommonOptions& common) {
  const double cosine = std::cos(radians_from_deg(options.angle_deg));
  const Estimate reflectance{fresnel_reflectance(cosine, options.from, options.to), 0.0};
  print_results(common, "fresnel", ".txt", text_of({{"reflectance", reflectance}}, common.json));
}

/// A line for each quantity of a case; adds an object for each to `rows`, and the number that lie off to `failures`.
std::string compare(const VerifyCase& row, const std::vector<Estimate>& found, Json& rows, int& failures) {
  std::string text;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Published& published = row.published[i];
    const double sigmas = deviation(found[i], published);
    const bool passed = std::fabs(sigmas) <= kMostDeviations;
    failures += passed ? 0 : 1;
    rows.push_back({{"case", row.name},
                    {"quantity", published.quantity},
                    {"value", found[i].value},
                    {"standard_error", found[i].standard_error},
                    {"published", published.value},
                    {"published_uncertainty", published.uncertainty},
                    {"passed", passed},
                    {"source", row.source}});
    text += fmt::format("{:<53}  {:<19}  {:>9.6f}  {:>8.6f}  {:>9.6g}  {:>6.2f}  {:<7}  {}\n", row.name,
                        published.quantity, found[i].value, found[i].standard_error, published.value, sigmas,
                        passed ? "passed" : "FAILED", row.source);
  }
  return text;
}

/// Throws Error when a verdict fails, after all rows are printed.
void verify_cases(const std::string& name, std::initializer_list<const std::vector<VerifyCase>*> tables,
                  const CommonOptions& common) {
  Json rows = Json::array();
  int failures = 0;
  std::string text = fmt::format("{:<53}  {:<19}  {:>9}  {:>8}  {:>9}  {:>6}  {:<7}  {}\n", "case", "quantity", "value",
                                 "std.err", "published", "sigmas", "verdict", "source");
  for (const std::vector<VerifyCase>* table : tables)
    for (const VerifyCase& row : *table) {
      Progress progress(std::string(row.name), 0, common.quiet);
      text += compare(row, row.compute(common.seed, plan_with(progress, 0)), rows, failures);
    }
  print_results(common, name, ".txt", common.json ? json_text(rows) : text);
  if (failures > 0)
    throw Error("verify", fmt::format("{} of {} quantities lie off their values", failures, rows.size()));
}

}  // namespace

std::function<void()> define_verify(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<VerifyOptions>();
  app.require_subcommand(1);
  const auto add = [&app](const char* name, const char* what) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->fallthrough();  // to the options that every command has
    return sub;
  };
  CLI::App* slab = add("slab", "Reflectance and transmittance of a turbid slab in air, for a collimated beam");
  slab->add_option("--index", options->index, "Refractive index of the slab")->check(number_within(kIndex))->required();
  slab->add_option("--absorption-per-mm", options->absorption_per_mm, "Absorption coefficient")
      ->check(number_within(kPerMm))
      ->required();
  slab->add_option("--scattering-per-mm", options->scattering_per_mm, "Scattering coefficient")
      ->check(number_within(kPerMm))
      ->required();
  slab->add_option("--anisotropy", options->anisotropy, "Mean cosine of the scattering angle (Henyey-Greenstein)")
      ->check(number_within(kAnisotropies))
      ->required();
  slab->add_option_function<std::string>(
          "--thickness-mm",
          [options](const std::string& text) {
            options->thickness_mm = decimal<double>(text).value_or(std::numeric_limits<double>::infinity());
          },
          "Thickness; inf: a half-space")
      ->type_name("FLOAT|inf")
      ->check(check_thickness)
      ->required();
  slab->add_option("--angle-deg", options->angle_deg, "Of the beam to the normal, in air")
      ->check(number_within(kBeamDeg))
      ->capture_default_str();
  slab->add_option("--photons", options->photons, "Walks; without it as many as make the standard errors 0.2 %")
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1} << 40));
  CLI::App* fresnel = add("fresnel", "Reflectance of a smooth interface for unpolarised light");
  fresnel->add_option("--from", options->from, "Refractive index that the light comes from")
      ->check(number_within(kIndex))
      ->required();
  fresnel->add_option("--to", options->to, "Refractive index beyond the interface")
      ->check(number_within(kIndex))
      ->required();
  fresnel->add_option("--angle-deg", options->angle_deg, "Of incidence")->check(number_within({0.0, 90.0}))->required();
  CLI::App* furnace = add("furnace", "White furnaces: where nothing absorbs, all light leaves");
  CLI::App* all = add("all", "Every published table and every furnace; fails when one value lies off");
  return [=, &common] {
    if (*slab) verify_slab(*options, common);
    if (*fresnel) verify_fresnel(*options, common);
    if (*furnace) verify_cases("furnace", {&furnace_cases()}, common);
    if (*all) verify_cases("verify", {&published_cases(), &furnace_cases()}, common);
  };
}

}  // namespace fathom
