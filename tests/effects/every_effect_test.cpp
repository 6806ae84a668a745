// Every parameter of every effect of the registry changes what is measured: an effect that does nothing is none.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/json.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"
#include "sim/sensor/capture.h"

namespace fathom {
namespace {

/// A cup that has stood for a while, seen by a small sensor.
Setup stood(const char* liquid, const char* quantization) {
  const Json json = {
      {"sensor",
       {{"model", "xtion_pro_live"},
        {"height_mm", 650},
        {"aim_mm", {0, 300, 0}},
        {"ir_size_px", {320, 256}},
        {"depth_size_px", {160, 120}},
        {"focal_px", 142.6},
        {"quantization", quantization}}},
      {"cups", {{{"shape", "paper_cup"}, {"position_mm", {0, 300}}, {"liquid", liquid}, {"fill_mm", 30}}}}};
  Setup setup = setup_from_json(json, "scene.json");
  setup.rig.sensor.law.cut = 0.0;  // steps of depth are not cut to millimetres before an effect does it
  setup.circumstances.time_s = 300.0;
  setup.circumstances.stood_s = 200.0;
  const auto medium_of = [&](const char* name) {
    Json other = json;
    other["cups"][0]["liquid"] = name;
    return setup_from_json(other, "scene.json").scene.cups[0].filling->medium;
  };
  setup.circumstances.liquids = {medium_of("milk_tea"), medium_of("water")};
  return setup;
}

/// All that a shot gives, as bytes: noise is the same in every shot of a seed.
std::string shot(const Setup& setup, CaptureMode mode) {
  const Setup changed = with_effects(setup);
  // As campaigns do: other images have all light anyway.
  const Frame frame = Camera(changed, mode, 1, 1, measured_light(changed)).shoot(0);
  std::string bytes;
  const auto add = [&](const auto& image) {
    bytes.append(reinterpret_cast<const char*>(image.pixels().data()), image.size() * sizeof(image.pixels()[0]));
  };
  add(frame.ir);
  add(frame.cloud);
  return bytes;
}

/// With all parameters of the effect at a typical departure from where it is absent, but for one that may be left
/// there.
Json switched_on(const Effect& effect, const EffectParameter* left_out) {
  Json json = {{"name", effect.id}};
  for (const EffectParameter& p : effect.parameters) {
    const double departed = p.nominal + p.scale <= p.upper ? p.nominal + p.scale : p.nominal - p.scale;
    json[std::string(p.name)] = &p == left_out ? p.nominal : departed;
  }
  return json;
}

class EveryEffect : public testing::TestWithParam<std::string> {};

TEST_P(EveryEffect, ChangesWhatIsMeasured) {
  const Effect& effect = *find_effect(GetParam());
  if (effect.id == "skew_approximation") {  // of how heights are reduced, not of a shot
    fathom::Setup setup = stood("water", "off");
    const std::vector<double> all{1.0};
    effect.apply(setup, {all, ""});
    EXPECT_EQ(setup.processing.bisector, 1.0);
    return;
  }
  const auto changes = [&](const EffectParameter& parameter) {
    for (const CaptureMode mode : {CaptureMode::geometric, CaptureMode::photometric})
      for (const char* quantization : {"off", "device"})
        for (const char* liquid : {"water", "milk_tea"}) {
          fathom::Setup with = stood(liquid, quantization), without = with;
          with.effects = Json::array({switched_on(effect, nullptr)});
          without.effects = Json::array({switched_on(effect, &parameter)});
          if (shot(with, mode) != shot(without, mode)) return true;
        }
    return false;
  };
  for (const EffectParameter& parameter : effect.parameters) EXPECT_TRUE(changes(parameter)) << parameter.name;
}

INSTANTIATE_TEST_SUITE_P(OfTheRegistry, EveryEffect, testing::ValuesIn(effect_ids()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace fathom
