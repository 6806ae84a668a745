#include "sim/scene/medium_json.h"

#include <fmt/format.h>

#include <cmath>

#include "core/library.h"
#include "core/units.h"
#include "sim/optics/water.h"

namespace fathom {
namespace {

constexpr Range kIndex{1.0, 4.0};
constexpr double kRoomC = 20.0;  ///< of every number in a medium's description

/// {"dispersion": "water"} is water; with "n" and "at_nm" the index is water's plus what makes it n there.
WaterIndex water_like_index(const JsonReader& json) {
  json.allow_only({"dispersion", "n", "at_nm"});
  json.at("dispersion").choice(std::vector<std::string>{"water"}, "dispersion");
  WaterIndex index{.temperature_c = kRoomC, .above_water = 0.0};
  if (json.has("n") != json.has("at_nm")) json.fail("needs n and at_nm, or neither");
  if (json.has("n"))
    index.above_water =
        json.number("n", kIndex) - water_index(json.number("at_nm", {kWaterMinNm, kWaterMaxNm}), kRoomC);
  return index;
}

void set_index(const JsonReader& json, Medium& medium) {
  const JsonReader index = json.at("index");
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
  index.allow_only({"sellmeier_a", "sellmeier_b_um2", "range_nm"});
  SellmeierIndex law{index.at("sellmeier_a").numbers(), index.at("sellmeier_b_um2").numbers()};
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

/// The ranges must hold the values that they are about.
void check_ranges(const JsonReader& json, const Medium& medium) {
  const auto check = [&](const char* key, double value) {
    if (!json.has(key)) return;
    const Eigen::Vector2d range = json.at(key).vector2();
    // 1e-6: the coefficients are written with six digits at most.
    if (value < range[0] * (1.0 - 1e-6) || value > range[1] * (1.0 + 1e-6))
      json.fail_at(key, fmt::format("must hold the value itself, {:g}", value));
  };
  json.allow_only({"index", "absorption_per_mm", "reduced_scattering_per_mm"});
  if (const auto* like_water = std::get_if<WaterIndex>(&medium.index))
    check("index", water_index(830.0, kRoomC) + like_water->above_water);
  check("absorption_per_mm", medium.absorption * kMetresPerMm);
  check("reduced_scattering_per_mm", medium.reduced_scattering() * kMetresPerMm);
}

Medium described_medium(const JsonReader& json) {
  json.allow_only({"name", "index", "absorption_per_mm", "absorption_per_mm_k", "scattering_per_mm", "anisotropy",
                   "ranges", "source", "quality"});
  Medium medium;
  medium.name = json.text_or("name", "liquid");
  set_index(json, medium);
  medium.absorption = per_metre_from_per_mm(json.number_or("absorption_per_mm", 0.0, kNonNegative));
  medium.absorption_per_kelvin = per_metre_from_per_mm(json.number_or("absorption_per_mm_k", 0.0));
  medium.scattering = per_metre_from_per_mm(json.number_or("scattering_per_mm", 0.0, kNonNegative));
  medium.anisotropy = json.number_or("anisotropy", 0.0, {-0.999, 0.999});
  medium.source = json.text_or("source", "");
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

/// {"name": …, "temperature_c": …, "dilution": …}; in place of the name the description "of" what is changed and of the
/// water that it is diluted "in".
Medium changed_medium(const JsonReader& json) {
  json.allow_only({"name", "of", "in", "temperature_c", "dilution"});
  if (json.has("name") && json.has("of")) json.fail_at("of", "cannot stand beside name, which already says it");
  Medium medium = json.has("of") ? described_medium(json.at("of")) : library_medium(json.text("name"), json.at("name"));
  auto* index = std::get_if<WaterIndex>(&medium.index);
  if (!index) json.fail("cannot be changed: its index is not known to follow water's");
  if (json.has("dilution"))
    dilute(medium, *index, json.number("dilution", {0.0, 1.0, true}),
           json.has("in") ? described_water(json.at("in")) : library_medium("water", json));
  const double temperature_c = json.number_or("temperature_c", kRoomC, {0.0, 100.0});
  index->temperature_c = temperature_c;
  medium.absorption += medium.absorption_per_kelvin * (temperature_c - kRoomC);
  return medium;
}

}  // namespace

Medium medium_from_json(const JsonReader& json) {
  if (json.value().is_string()) return library_medium(json.text(), json);
  const bool is_changed = json.has("of") || (json.has("name") && !json.has("index"));
  return is_changed ? changed_medium(json) : described_medium(json);
}

Medium wall_from_json(const JsonReader& json) {
  Medium medium =
      json.value().is_string() ? library_medium(json.text(), json, "walls", "wall material") : described_medium(json);
  if (medium.scatters()) json.fail("scatters; a wall of a cup is clear, or opaque with an albedo");
  return medium;
}

}  // namespace fathom
