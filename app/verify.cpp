// `fathom verify`: certification of light transport, by the code that renders.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/verify_cases.h"
#include "core/error.h"
#include "core/json.h"
#include "core/progress.h"
#include "core/units.h"
#include "sim/optics/fresnel.h"
#include "sim/optics/layer_light.h"

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

void check(bool allowed, const char* option, double value, const char* must) {
  if (!allowed) throw Error(option, fmt::format("must be {}, got {}", must, value));
}

void check_index(const char* option, double index) {
  check(index > 0.0 && index <= 10.0, option, index, "above 0 and at most 10");
}

void check_angle(double angle_deg, double most_deg, const char* must) {
  check(angle_deg >= 0.0 && angle_deg <= most_deg, "--angle-deg", angle_deg, must);
}

void check_slab(const VerifyOptions& options) {
  constexpr double kMostPerMm = 1e9;
  const auto coefficient = [](double per_mm) { return per_mm >= 0.0 && per_mm <= kMostPerMm; };
  check_index("--index", options.index);
  check(coefficient(options.absorption_per_mm), "--absorption-per-mm", options.absorption_per_mm, "from 0 to 1e9");
  check(coefficient(options.scattering_per_mm), "--scattering-per-mm", options.scattering_per_mm, "from 0 to 1e9");
  check(std::fabs(options.anisotropy) < 1.0, "--anisotropy", options.anisotropy, "above -1 and below 1");
  check(options.thickness_mm > 0.0, "--thickness-mm", options.thickness_mm, "above 0, or inf");
  check_angle(options.angle_deg, std::nextafter(90.0, 0.0), "at least 0 and below 90");
}

/// A plan that shows its progress.
SamplingPlan plan_with(Progress& progress, std::uint64_t photons) {
  SamplingPlan plan;
  plan.samples = photons;
  plan.report = [&progress](std::uint64_t done, std::uint64_t expected) { progress.reach(done, expected); };
  return plan;
}

void print(const Estimates& estimates, bool as_json) {
  Json object = Json::object();
  for (const auto& [name, estimate] : estimates)
    object[name] = {{"value", estimate.value}, {"standard_error", estimate.standard_error}};
  if (as_json) {
    fmt::print("{}\n", object.dump(2));
    return;
  }
  fmt::print("{:<21}  {:>9}  {:>14}\n", "", "value", "standard error");
  for (const auto& [name, estimate] : estimates)
    fmt::print("{:<21}  {:>9.6f}  {:>14.6f}\n", name, estimate.value, estimate.standard_error);
}

void verify_slab(const VerifyOptions& options, const CommonOptions& common) {
  check_slab(options);
  const Turbid medium{options.index, per_metre_from_per_mm(options.absorption_per_mm),
                      per_metre_from_per_mm(options.scattering_per_mm), options.anisotropy};
  const LayerSpace space({{medium, metres_from_mm(options.thickness_mm)}});
  Progress progress("walks", 0, common.quiet);
  const LayerLight light =
      light_in_layers(space, radians_from_deg(options.angle_deg), common.seed, plan_with(progress, options.photons));
  Estimates estimates{{"reflectance_total", light.reflectance},
                      {"reflectance_specular", {light.specular, 0.0}},
                      {"transmittance_total", light.transmittance}};
  if (light.absorptance) estimates.emplace_back("absorptance", *light.absorptance);
  print(estimates, common.json);
  if (!light.reached)
    fmt::print(stderr, "note: gave up after {} walks, before the standard errors were 0.2 % of the values\n",
               light.walks);
}

void verify_fresnel(const VerifyOptions& options, const CommonOptions& common) {
  check_index("--from", options.from);
  check_index("--to", options.to);
  check_angle(options.angle_deg, 90.0, "from 0 to 90");
  const double cosine = std::cos(radians_from_deg(options.angle_deg));
  print({{"reflectance", {fresnel_reflectance(cosine, options.from, options.to), 0.0}}}, common.json);
}

/// Throws Error when a verdict fails, after all rows are printed.
void verify_cases(std::initializer_list<const std::vector<Case>*> tables, const CommonOptions& common) {
  Json rows = Json::array();
  int failures = 0;
  if (!common.json)
    fmt::print("{:<55} {:<20} {:>9} {:>9} {:>9} {:>6}  {:<7}  {}\n", "case", "quantity", "value", "std.err",
               "published", "sigmas", "verdict", "source");
  for (const std::vector<Case>* table : tables)
    for (const Case& row : *table) {
      std::vector<Estimate> found;
      {
        Progress progress(std::string(row.name), 0, common.quiet);
        found = row.compute(common.seed, plan_with(progress, 0));
      }
      for (std::size_t i = 0; i < found.size(); ++i) {
        const Published& published = row.published[i];
        const double sigmas = deviation(found[i], published);
        const bool passed = std::fabs(sigmas) <= kMostDeviations;
        failures += passed ? 0 : 1;
        if (common.json)
          rows.push_back({{"case", row.name},
                          {"quantity", published.quantity},
                          {"value", found[i].value},
                          {"standard_error", found[i].standard_error},
                          {"published", published.value},
                          {"published_uncertainty", published.uncertainty},
                          {"passed", passed},
                          {"source", row.source}});
        else
          fmt::print("{:<55} {:<20} {:>9.6f} {:>9.6f} {:>9.6g} {:>6.2f}  {:<7}  {}\n", row.name, published.quantity,
                     found[i].value, found[i].standard_error, published.value, sigmas, passed ? "passed" : "FAILED",
                     row.source);
      }
      std::fflush(stdout);
    }
  if (common.json) fmt::print("{}\n", rows.dump(2));
  if (failures > 0) throw Error("verify", fmt::format("{} of the quantities above lie off their values", failures));
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
  slab->add_option("--index", options->index, "Refractive index of the slab")->required();
  slab->add_option("--absorption-per-mm", options->absorption_per_mm, "Absorption coefficient")->required();
  slab->add_option("--scattering-per-mm", options->scattering_per_mm, "Scattering coefficient")->required();
  slab->add_option("--anisotropy", options->anisotropy, "Mean cosine of the scattering angle (Henyey-Greenstein)")
      ->required();
  slab->add_option("--thickness-mm", options->thickness_mm, "Thickness; inf: a half-space")->required();
  slab->add_option("--angle-deg", options->angle_deg, "Of the beam to the normal, in air")->capture_default_str();
  slab->add_option("--photons", options->photons, "Walks; without it as many as make the standard errors 0.2 %")
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1} << 40));
  CLI::App* fresnel = add("fresnel", "Reflectance of a smooth interface for unpolarised light");
  fresnel->add_option("--from", options->from, "Refractive index that the light comes from")->required();
  fresnel->add_option("--to", options->to, "Refractive index beyond the interface")->required();
  fresnel->add_option("--angle-deg", options->angle_deg, "Of incidence")->required();
  CLI::App* furnace = add("furnace", "White furnaces: where nothing absorbs, all light leaves");
  CLI::App* all = add("all", "Every published table and every furnace; fails when one value lies off");
  return [=, &common] {
    if (*slab) verify_slab(*options, common);
    if (*fresnel) verify_fresnel(*options, common);
    if (*furnace) verify_cases({&furnace_cases()}, common);
    if (*all) verify_cases({&published_cases(), &furnace_cases()}, common);
  };
}

}  // namespace fathom
