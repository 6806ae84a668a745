#include "app/remove_diagnosis.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/files.h"
#include "core/view_page.h"
#include "report/cup_shots_json.h"
#include "report/gnuplot.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// A table and the first of its columns: a measurement has a heights.csv of its own.
struct TableFile {
  const char* name;
  std::string_view columns;
};
constexpr std::array kTables{
    TableFile{"map_desk.csv", "x,y,mean_mm"},           TableFile{"map_cup.csv", "x,y,radius,from_deg"},
    TableFile{"map_unseen.csv", "x,y,radius,from_deg"}, TableFile{"map_numbers.csv", "x,y,mean_mm"},
    TableFile{"heights.csv", "number,before_mm"},       TableFile{"shape.csv", "x,y,mean_mm"},
    TableFile{"residuals.csv", "observable,region"}};

/// next_1.json and so on.
bool is_campaign(const std::string& name) {
  constexpr std::string_view kBegin = "next_", kEnd = ".json";
  if (name.size() <= kBegin.size() + kEnd.size() || !name.starts_with(kBegin) || !name.ends_with(kEnd)) return false;
  return std::all_of(name.begin() + kBegin.size(), name.end() - kEnd.size(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void remove_diagnosis(const fs::path& folder) {
  fs::remove(folder / "report.json");
  remove_if_ours(folder / "report.html", "<title>Fathom: diagnosis</title>");
  remove_if_ours(folder / kShotsFile, kShotsBegin);
  remove_view_page(folder);
  std::vector<fs::path> campaigns;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_campaign(entry.path().filename().string())) campaigns.push_back(entry.path());
  for (const fs::path& campaign : campaigns) fs::remove(campaign);
  fs::remove(folder / "next.json");
  for (const char* name : {"map", "heights", "shape"}) remove_drawing(folder, name);
  for (const TableFile& table : kTables) remove_if_ours(folder / table.name, table.columns);
}

}  // namespace fathom
