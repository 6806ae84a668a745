#include "sim/scene/medium_json.h"

#include <fmt/format.h>

#include <cmath>

#include "core/fields.h"
#include "core/library.h"
#include "core/units.h"
#include "sim/optics/water.h"

namespace fathom {
namespace {

constexpr Range kIndex{1.0, 4.0};
constexpr double kRoomC = 20.0;  ///< of every number in a medium's description

struct WaterLike {
  double n = 0.0, at_nm = 0.0;
};

std::span<const Field<WaterLike>> water_like_fields() {
  static const Field<WaterLike> fields[] = {
      {"dispersion",
       Choice<WaterLike>{{"water"}, [](const WaterLike&) { return std::size_t{0}; }, [](WaterLike&, std::size_t) {}},
       "water's index at any temperature (IAPWS R9-97)", true},
      {"n", &WaterLike::n, kIndex, "beside `at_nm`: the index there, which a constant added to water's makes"},
      {"at_nm", &WaterLike::at_nm, {kWaterMinNm, kWaterMaxNm}, "wavelength of `n`"}};
  return fields;
}

/// Water's index, or with "n" and "at_nm" water's plus what makes it n there.
WaterIndex water_like_index(const JsonReader& json) {
  WaterLike like;
  read_fields(json, water_like_fields(), like);
  if (json.has("n") != json.has("at_nm")) json.fail("needs n and at_nm, or neither");
  return {.temperature_c = kRoomC, .above_water = json.has("n") ? like.n - water_index(like.at_nm, kRoomC) : 0.0};
}

std::span<const Field<SellmeierIndex>> sellmeier_fields() {
  using Law = SellmeierIndex;
  constexpr std::string_view kNumbers = R"({"type": "array", "items": {"type": "number"}, "minItems": 1})";
  static const Field<Law> fields[] = {
      {"sellmeier_a",
       Part<Law>{[](const JsonReader& json, Law& law) { law.a = json.numbers(); }, nullptr, kNumbers,
                 "a list of numbers"},
       "A of n² − 1 = Σ A λ² / (λ² − B), λ in µm", true},
      {"sellmeier_b_um2",
       Part<Law>{[](const JsonReader& json, Law& law) { law.b_um2 = json.numbers(); }, nullptr, kNumbers,
                 "a list of numbers"},
       "B", true},
      {"range_nm", unread<Law>("#/$defs/vector2", "[least, largest]"), "wavelengths at which that holds", true}};
  return fields;
}

void set_index(const JsonReader& index, Medium& medium) {
  if (index.value().is_number()) {
    medium.index = ConstantIndex{index.number(kIndex)};
    return;
  }
  if (index.has("dispersion")) {
    medium.index = water_like_index(index);
    medium.wavelength_min_nm = kWaterMinNm;
    medium.wavelength_max_nm = kWaterMaxNm;
    return;
  }
  SellmeierIndex law;
  read_fields(index, sellmeier_fields(), law);
  if (law.a.size() != law.b_um2.size() || law.a.empty())
    index.fail_at("sellmeier_b_um2", "must hold as many numbers as sellmeier_a, at least one");
  const Eigen::Vector2d range = index.at("range_nm").vector2();
  if (range[0] <= 0.0 || range[1] <= range[0])
    index.fail_at("range_nm", "must be two wavelengths above 0, the lower first");
  for (const double b_um2 : law.b_um2) {
    const double resonance_nm = b_um2 > 0.0 ? 1e3 * std::sqrt(b_um2) : 0.0;
    if (resonance_nm >= range[0] && resonance_nm <= range[1])
      index.fail_at("sellmeier_b_um2", fmt::format("has a resonance at {:g} nm, inside range_nm", resonance_nm));
  }
  medium.index = std::move(law);
  medium.wavelength_min_nm = range[0];
  medium.wavelength_max_nm = range[1];
  for (const double wavelength_nm : range) {
    const double n = medium.n(wavelength_nm);
    if (!(n >= kIndex.low && n <= kIndex.high))
      index.fail_at("sellmeier_a",
                    fmt::format("gives the index {:g} at {:g} nm, must be from 1 to 4", n, wavelength_nm));
  }
}

std::span<const Field<Medium>> range_fields() {
  static const Field<Medium> fields[] = {
      {"index", unread<Medium>("#/$defs/vector2", "[least, largest]"), "at 830 nm and 20 °C"},
      {"absorption_per_mm", unread<Medium>("#/$defs/vector2", "[least, largest]"), "of the key of this name"},
      {"reduced_scattering_per_mm", unread<Medium>("#/$defs/vector2", "[least, largest]"),
       "of `scattering_per_mm` times 1 − `anisotropy`"}};
  return fields;
}

/// The ranges must hold the values that they are about.
void check_ranges(const JsonReader& json, const Medium& medium) {
  const auto check = [&](const char* key, double value) {
    if (!json.has(key)) return;
    const Eigen::Vector2d range = json.at(key).vector2();
    // 1e-6: the coefficients are written with six digits at most.
    if (value < range[0] * (1.0 - 1e-6) || value > range[1] * (1.0 + 1e-6))
      json.fail_at(key, fmt::format("must hold the value itself, {:g}", value));
  };
  Medium described;
  read_fields(json, range_fields(), described);
  if (const auto* like_water = std::get_if<WaterIndex>(&medium.index))
    check("index", water_index(830.0, kRoomC) + like_water->above_water);
  check("absorption_per_mm", per_mm_from_per_metre(medium.absorption));
  check("reduced_scattering_per_mm", per_mm_from_per_metre(medium.reduced_scattering()));
}

std::span<const Field<Medium>> medium_fields() {
  static const Field<Medium> fields[] = {
      {"name", &Medium::name, "what it is called"},
      {"index",
       Part<Medium>{
           set_index, nullptr,
           R"({"anyOf": [{"type": "number", "minimum": 1, "maximum": 4}, {"$ref": "#/$defs/water_like"}, {"$ref": "#/$defs/dispersion"}]})",
           "1 to 4, or an object"},
       "refractive index: a number, water's, or a law of dispersion", true},
      {"absorption_per_mm", PerLength{&Medium::absorption}, kNonNegative, "absorption coefficient at 830 nm and 20 °C"},
      {"absorption_per_mm_k", PerLength{&Medium::absorption_per_kelvin}, "its change with temperature"},
      {"scattering_per_mm", PerLength{&Medium::scattering}, kNonNegative, "scattering coefficient"},
      {"anisotropy",
       &Medium::anisotropy,
       {-0.999, 0.999},
       "mean cosine of the scattering angle (Henyey and Greenstein)"},
      {"ranges", unread<Medium>("#/$defs/ranges", "an object"), "within which the numbers are believed to lie"},
      {"source", &Medium::source, "where the numbers come from"},
      {"quality", unread<Medium>(R"({"type": "string"})", "a text"), "how good they are"}};
  return fields;
}

Medium described_medium(const JsonReader& json, const char* name = "liquid") {
  Medium medium;
  medium.name = name;
  read_fields(json, medium_fields(), medium);
  if (json.has("ranges")) check_ranges(json.at("ranges"), medium);
  return medium;
}

Medium library_medium(const std::string& name, const JsonReader& asked_by, const char* library = "media",
                      const char* kind = "liquid") {
  const std::filesystem::path file = library_file(library, kind, name, asked_by.file(), asked_by.pointer());
  const Json text = read_json(file);
  Medium medium = described_medium(JsonReader(text, file.string()));
  medium.name = name;
  return medium;
}

/// A share of the medium's volume in water.
void dilute(Medium& medium, WaterIndex& index, double share, const Medium& water) {
  index.above_water *= share;
  medium.absorption = share * medium.absorption + (1.0 - share) * water.absorption;
  medium.absorption_per_kelvin = share * medium.absorption_per_kelvin + (1.0 - share) * water.absorption_per_kelvin;
  medium.scattering *= share;
}

/// Only what absorbs may be described otherwise than water.
Medium described_water(const JsonReader& json) {
  const Medium medium = described_medium(json);
  const auto* index = std::get_if<WaterIndex>(&medium.index);
  if (!index || index->above_water != 0.0 || medium.scatters())
    json.fail("must be water: of the index {\"dispersion\": \"water\"}, without scattering");
  return medium;
}

struct Change {
  double temperature_c = kRoomC, dilution = 1.0;
};

std::span<const Field<Change>> change_fields() {
  static const Field<Change> fields[] = {
      {"name", unread<Change>(R"({"type": "string"})", "a name"),
       "of `fathom list media`, of a liquid that follows water's dispersion"},
      {"of", unread<Change>("#/$defs/liquid", "an object"), "its description, instead of the name"},
      {"in", unread<Change>("#/$defs/liquid", "an object"),
       "description of the water that it is diluted in, instead of the library's"},
      {"temperature_c", &Change::temperature_c, {0.0, 100.0}, "of the liquid"},
      {"dilution", &Change::dilution, {0.0, 1.0, true}, "its share of the volume, the rest is water"}};
  return fields;
}

/// A medium of the library, or the description "of" one, at a temperature and diluted.
Medium changed_medium(const JsonReader& json) {
  Change change;
  read_fields(json, change_fields(), change);
  if (json.has("name") && json.has("of")) json.fail_at("of", "cannot stand beside name, which already says it");
  Medium medium = json.has("of") ? described_medium(json.at("of")) : library_medium(json.text("name"), json.at("name"));
  auto* index = std::get_if<WaterIndex>(&medium.index);
  if (!index) json.fail("cannot be changed: its index is not known to follow water's");
  if (json.has("dilution"))
    dilute(medium, *index, change.dilution,
           json.has("in") ? described_water(json.at("in")) : library_medium("water", json));
  index->temperature_c = change.temperature_c;
  medium.absorption += medium.absorption_per_kelvin * (change.temperature_c - kRoomC);
  return medium;
}

}  // namespace

Medium medium_from_json(const JsonReader& json) {
  if (json.value().is_string()) return library_medium(json.text(), json);
  const bool is_changed = json.has("of") || (json.has("name") && !json.has("index"));
  return is_changed ? changed_medium(json) : described_medium(json);
}

Medium wall_from_json(const JsonReader& json) {
  return json.value().is_string() ? library_medium(json.text(), json, "walls", "wall material")
                                  : described_medium(json, "wall");
}

std::vector<KeyTable> medium_key_tables() {
  return {{"cups[].liquid", "liquid", "Medium", key_rows(medium_fields(), Medium{})},
          {"cups[].liquid.index", "water_like", "Index like water's", key_rows(water_like_fields(), WaterLike{})},
          {"cups[].liquid.index", "dispersion", "Sellmeier's law", key_rows(sellmeier_fields(), SellmeierIndex{})},
          {"cups[].liquid.ranges", "ranges", "Ranges", key_rows(range_fields(), Medium{})},
          {"cups[].liquid", "changed_liquid", "Changed medium", key_rows(change_fields(), Change{})}};
}

}  // namespace fathom
