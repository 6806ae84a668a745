// What a diagnosis says, in sentences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/decision/diagnosis.h"

namespace fathom {

std::string capitalised(std::string text);              ///< with a large first letter; `text` is not empty
std::string effect_words(const std::string& name);      ///< "subsurface scattering of milk tea"
std::string heights_words(const Diagnosis& diagnosis);  ///< which heights were compared: "heights" where cups' were
std::string effects_words(const std::vector<std::string>&);  ///< "foam and surface tilt", "nothing"
std::string place_words(std::string_view stratum);           ///< "where liquid is milk tea"; nothing of everywhere
std::string stratum_words(const GapLocation& where);         ///< "height in the cup where liquid is milk tea"
std::string effect_clause(const NamedEffect& effect);        ///< "every pour is 15 % (13 to 17 %) larger than was …"
/// As people know them: where a parameter's inverse has a name, that.
std::vector<NamedParameter> shown_parameters(const NamedEffect& effect);
std::string parameter_words(const NamedParameter& parameter);  ///< "scattering = 2.1 per mm (1.9 to 2.4)"

/// What departs and is no gap by itself, in two or three sentences; empty where nothing does.
std::string beside_words(const Departures& departures);

/// The answer in one to three sentences.
std::string answer(const Diagnosis& diagnosis);

}  // namespace fathom
