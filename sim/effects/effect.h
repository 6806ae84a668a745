// An effect: something that the model of a measurement may lack, as a change of what is physically there.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scene/setup.h"

namespace fathom {

struct EffectParameter {
  std::string_view name;  ///< with its unit, as a key: "tilt_x_deg"
  std::string_view meaning;
  double nominal;  ///< where the effect is absent
  double scale;    ///< a typical departure from that
  double lower, upper;
  std::string_view inverse = {};  ///< key of 1 / value, where that is what tables have: files may give either
  double step = 0.0;              ///< it is rounded to whole multiples of this; 0: it is not

  bool is_switch() const { return step > 0.0 && step == upper - lower; }  ///< either there or not
};

/// The values of an effect's parameters, in their order, and of which liquid.
struct EffectSetting {
  std::span<const double> values;
  std::string_view liquid = {};  ///< the only one that it changes, by its label; empty: all
};

struct Effect {
  std::string_view id;
  std::string_view family = {};  ///< the registry sets it
  std::string_view sentence;     ///< one, plain
  /// Sentences for the first parameter above (`more`) and below (`less`) nominal; {} becomes its departure with its
  /// unit. Empty where numbers do not fit into a sentence.
  std::string_view more = {}, less = {};
  bool in_percent = false;  ///< that parameter is a share, and stands there in percent
  std::vector<EffectParameter> parameters;
  std::string_view citation;
  std::vector<std::string_view> confounded;  ///< effects that look alike, in some campaigns at least
  std::string_view discriminated_by;         ///< the measurement that tells them apart
  /// Changes scene, rig, circumstances or processing; at the nominal values it changes nothing.
  void (*apply)(Setup& setup, const EffectSetting& setting);
  bool of_liquids = false;  ///< may be limited to one liquid
  bool of_time = false;     ///< goes by the times of Circumstances
};

}  // namespace fathom
