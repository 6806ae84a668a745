// fathom check: what a measurement directory lacks, in seconds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "app/results.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/rows.h"
#include "core/units.h"
#include "core/visible_text.h"
#include "diagnosis/decision/sufficiency.h"
#include "diagnosis/predict/nominal_model.h"
#include "report/check_words.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOfLaboratory[] = {"rig.json", "frames.csv"};

std::string lengths(const std::set<double>& values_mm) { return fmt::format("{:g}", fmt::join(values_mm, ", ")); }

std::string trials_text(const MeasurementCheck& check) {
  return check.fewest_trials == check.most_trials ? fmt::format("{}", check.most_trials)
                                                  : fmt::format("{} to {}", check.fewest_trials, check.most_trials);
}

std::string cloud_text(const MeasurementCheck& check) {
  if (check.height <= 1) return fmt::format("{} points, without rows", check.width);
  return fmt::format("{} x {}", check.width, check.height);
}

/// Where a diagnosis takes the unit's bias from.
std::string unit_text(const MeasurementCheck& check) {
  const std::string file = check.rig.unit.map ? "as in " + check.rig.unit.file : "";
  if (check.clouds == 0) return file.empty() ? "not known: there are no clouds" : file;
  return file.empty() ? "will be learned from the desks" : file + ", the rest will be learned from the desks";
}

Json unit_json(const MeasurementCheck& check) {
  if (check.rig.unit.map) return {{"from", "calibration"}, {"file", check.rig.unit.file}};
  return {{"from", check.clouds > 0 ? "desks" : "nothing"}};
}

std::string sessions_text(const MeasurementCheck& check) {
  const auto text = [](double value, const char* unit, bool is_stated) {
    return fmt::format("{:.3g}{}, {}", value, unit, is_stated ? "as stated" : "the default");
  };
  return fmt::format("{}; {}", text(mm_from_metres(check.rig.session_m), " mm", check.session_mm_stated),
                     text(deg_from_radians(check.rig.session_rad), "°", check.session_deg_stated));
}

std::vector<Row> rows_of(const MeasurementCheck& check) {
  const auto count = [](std::size_t number) { return static_cast<double>(number); };
  std::vector<Row> rows{{"frames", count(check.frames)},
                        {"clouds", count(check.clouds)},
                        {"heights_without_cloud", count(check.heights)},
                        {"bare_desk_views", count(check.bare_desk_views)},
                        {"sessions", count(check.sessions)},
                        {"pours", count(check.pours)},
                        {"placements", count(check.placements)},
                        {"trials_of_each", trials_text(check)}};
  if (!check.distances_mm.empty()) {
    rows.push_back({"distances", lengths(check.distances_mm), "mm"});
    rows.push_back({"laterals", lengths(check.laterals_mm), "mm"});
  }
  for (const auto& [liquid, fills_mm] : check.fills_mm)
    if (liquid == "empty")
      rows.push_back({"empty_cup", "yes"});
    else
      rows.push_back({"fills_of_" + liquid, lengths(fills_mm), "mm"});
  rows.push_back({"cup", check.rig.cup_shape});
  rows.push_back({"unit", unit_text(check)});
  if (check.sessions > 1) rows.push_back({"sessions_differ_by", sessions_text(check)});
  if (check.clouds_read > 0) {
    rows.push_back({"clouds_looked_at", count(check.clouds_read)});
    rows.push_back({"first_cloud", cloud_text(check)});
  }
  return rows;
}

/// What keeps a diagnosis from a verdict; null where nothing does.
const Shortfall* lack_of_verdict(const MeasurementCheck& check) {
  // Clouds have many observations each; heights have one.
  const bool has_few = check.clouds == 0 && check.heights < kEnoughForSmooth;
  const auto lack = std::ranges::find_if(check.lacks, [&](const Shortfall& one) {
    return one.lack == Lack::conditions || (one.lack == Lack::repeats && has_few);
  });
  return lack == check.lacks.end() ? nullptr : &*lack;
}

std::string rows_text(const MeasurementCheck& check) {
  std::string text = format_rows(rows_of(check), false);
  for (const Shortfall& shortfall : check.lacks) {
    const LackWords words = lack_words(shortfall, check);
    text += "\n" + on_one_line(words.what) + "\n  costs:  " + on_one_line(words.costs) +
            "\n  remedy: " + on_one_line(words.remedy) + "\n";
  }
  if (const Shortfall* lack = lack_of_verdict(check))
    return text + fmt::format("\nA diagnosis can run, but its verdict will be insufficient. {}\n",
                              on_one_line(lack_words(*lack, check).what));
  return text +
         (check.lacks.empty()
              ? "\nA diagnosis can run; nothing is missing.\n"
              : fmt::format("\nA diagnosis can run; {} would make it say more.\n",
                            check.lacks.size() == 1 ? "one thing" : fmt::format("{} things", check.lacks.size())));
}

Json json_of(const MeasurementCheck& check) {
  Json json = {
      {"can_run", true},
      {"can_answer", lack_of_verdict(check) == nullptr},
      {"frames", check.frames},
      {"clouds", check.clouds},
      {"heights_without_cloud", check.heights},
      {"bare_desk_views", check.bare_desk_views},
      {"sessions", check.sessions},
      {"pours", check.pours},
      {"placements", check.placements},
      {"trials_of_each", {check.fewest_trials, check.most_trials}},
      {"distances_mm", check.distances_mm},
      {"laterals_mm", check.laterals_mm},
      {"fills_mm", check.fills_mm},
      {"cup", check.rig.cup_shape},
      {"unit", unit_json(check)},
      {"session_mm", {{"value", mm_from_metres(check.rig.session_m)}, {"stated", check.session_mm_stated}}},
      {"session_deg", {{"value", deg_from_radians(check.rig.session_rad)}, {"stated", check.session_deg_stated}}},
      {"clouds_looked_at", check.clouds_read},
      {"missing", Json::array()}};
  for (const Shortfall& shortfall : check.lacks) {
    const LackWords words = lack_words(shortfall, check);
    json["missing"].push_back({{"name", words.id},
                               {"what", words.what},
                               {"costs", words.costs},
                               {"remedy", words.remedy},
                               {"of", shortfall.names}});
  }
  return json;
}

/// A laboratory to start from, into a folder that holds none.
void write_example(const fs::path& folder) {
  make_directory(folder);
  for (const char* name : kOfLaboratory)
    if (fs::exists(folder / name)) throw Error((folder / name).string(), "is there already; choose another folder");
  for (const char* name : kOfLaboratory)
    write_text(folder / name, read_text(data_directory() / "measurements" / "beaker" / name));
  print_text(fmt::format("{0}/rig.json and {0}/frames.csv are a laboratory to change into yours; fathom check {0}\n",
                         on_one_line(folder.string())));
}

}  // namespace

std::function<void()> define_check(CLI::App& app, const CommonOptions& common) {
  const auto folder = add_measurement_folder(app, false);
  const auto example = std::make_shared<bool>(false);
  app.add_flag("--example", *example, "Writes a rig.json and a frames.csv to start from into the folder of -o");
  return [folder, example, &common] {
    if (*example) {
      require_output(common);
      return write_example(common.output);
    }
    if (folder->empty()) throw UsageError("DIR is required, or --example");
    const MeasurementCheck check = check_measurement(*folder);
    nominal_model(check.rig, (*folder / "rig.json").string());  // refuses names and media that a diagnosis refuses
    print_results(common, "check", ".txt", common.json ? json_text(json_of(check)) : rows_text(check));
  };
}

}  // namespace fathom
