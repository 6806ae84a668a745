#include "blind/pack.h"

#include <fmt/format.h>

#include "blind/ledger.h"
#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/json.h"
#include "core/parallel.h"

namespace fathom::blind {
namespace {

namespace fs = std::filesystem;

Json sealed_json(const SetTruth& truth) {
  Json json = json_of(truth);
  json["seed"] = truth.seed;
  for (std::size_t i = 0; i < truth.effects.size(); ++i)
    json["effects"][i]["departure"] = truth.effects[i].active.departure;
  return json;
}

SetTruth truth_from_json(const JsonReader& json) {
  const Json& value = json.value();
  SetTruth truth{.number = value.at("set").get<int>(), .seed = value.at("seed").get<std::uint64_t>()};
  truth.kind = json.text("class");
  truth.design = json.text("design");
  truth.book_keeping = json.text("book_keeping");
  truth.left_out = json.text("left_out");
  for (const JsonReader& twin : json.at("aliased").items()) truth.aliased.push_back(twin.text());
  truth.escape = json.number("escape");
  truth.noise_scale = json.number("noise_scale");
  truth.heavy_tails = value.at("heavy_tails").get<bool>();
  for (const JsonReader& hidden : json.at("effects").items())
    truth.effects.push_back({{&hidden_effect(hidden.text("name")), hidden.number("departure")}, hidden.number("s")});
  for (const auto& [liquid, s] : value.at("strength_by_liquid").items())
    truth.strength_by_liquid[liquid] = s.get<double>();
  return truth;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  const fs::path relative =
      fs::weakly_canonical(fs::absolute(file)).lexically_relative(fs::weakly_canonical(fs::absolute(folder)));
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

fs::path set_folder(const fs::path& pack, int number) { return pack / "sets" / fmt::format("{:04}", number); }

void seal_pack(const std::string& kind, std::uint64_t seed, int sets, const fs::path& folder, const fs::path& truth,
               const fs::path& ledger) {
  require_seed(kind, seed);
  if (is_inside(truth, folder)) throw Error(truth.string(), "must lie outside the pack, whose reader must not know it");
  if (fs::exists(folder / "pack.json")) throw Error((folder / "pack.json").string(), "is there already");
  const Views views = views_of(designs());
  std::vector<SetTruth> drawn(static_cast<std::size_t>(sets));
  parallel_items(sets, [&](int i) { drawn[static_cast<std::size_t>(i)] = draw_set(views, seed, i, sets); });
  Json list = Json::array(), options = Json::array();
  for (const SetTruth& set : drawn) {
    list.push_back(sealed_json(set));
    // Which effect the analyser's registry has to lack, where one has to.
    options.push_back({{"set", set.number}, {"left_out", set.left_out}});
  }
  const Json sealed = {{"kind", kind}, {"seed", seed}, {"sets", list}};
  make_directory(folder / "sets");
  write_json(truth, sealed);
  const std::string hash = sha256(read_text(truth));
  const std::string name = folder.filename().string();
  if (!ledger.empty())
    add_to_ledger(ledger,
                  {.event = "made", .pack = name, .kind = kind, .seed = seed, .sets = sets, .truth_sha256 = hash});
  write_json(folder / "pack.json", {{"name", name}, {"kind", kind}, {"truth_sha256", hash}, {"sets", options}});
}

Pack open_pack(const fs::path& folder, const fs::path& truth) {
  const Json about = read_json(folder / "pack.json");
  const JsonReader reader(about, (folder / "pack.json").string());
  Pack pack{.name = reader.text("name"), .kind = reader.text("kind"), .truth_sha256 = reader.text("truth_sha256")};
  if (sha256(read_text(truth)) != pack.truth_sha256)
    throw Error(truth.string(), "is not the truth of this pack: pack.json names another hash");
  const Json sealed = read_json(truth);
  pack.seed = sealed.at("seed").get<std::uint64_t>();
  for (const JsonReader& set : JsonReader(sealed, truth.string()).at("sets").items())
    pack.sets.push_back(truth_from_json(set));
  return pack;
}

}  // namespace fathom::blind
