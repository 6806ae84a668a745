// How effects, their sizes and the parts of a measurement are called.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/decision/diagnosis.h"

namespace fathom {

std::string capitalised(std::string text);  ///< with a large first letter; `text` is not empty
std::string joined(const std::vector<std::string>& words, std::string_view last);  ///< "a, b or c", with `last` "or"

int decimals_of(double low, double high);  ///< digits behind the point that a value with this interval needs

std::string effect_words(const std::string& name);           ///< "subsurface scattering of milk tea"
std::string effects_words(const std::vector<std::string>&);  ///< of a set: "foam + surface tilt", "no effect"
std::string effect_list(const std::vector<std::string>&, std::string_view last);  ///< "foam, ripples or meniscus"
std::string effect_clause(const NamedEffect& effect);  ///< "every pour is 15 % (13 to 17 %) larger than was …"
/// As people know them: where a parameter's inverse has a name, that. Not what is either there or not, which the
/// effect's sentence says.
std::vector<NamedParameter> shown_parameters(const NamedEffect& effect);
std::string parameter_name(std::string_view parameter);        ///< "tilt_x_deg" → "tilt x"
std::string_view parameter_unit(std::string_view parameter);   ///< "tilt_x_deg" → "°"; of shares nothing
std::string parameter_words(const NamedParameter& parameter);  ///< "scattering = 2.1 per mm (1.9 to 2.4)"

std::string place_words(std::string_view stratum);    ///< "in milk tea, 300 mm away"; nothing of everywhere
std::string stratum_words(const GapLocation& where);  ///< "height in the cup, in milk tea"

}  // namespace fathom
