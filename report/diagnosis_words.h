// What a diagnosis says, in sentences.
#pragma once

#include <string>
#include <vector>

#include "report/effect_words.h"

namespace fathom {

std::string heights_words(const Diagnosis& diagnosis);  ///< which heights were compared: "heights" where cups' were

/// "98 %", "99.6 %" where whole per cent would hide that others are left, "over 99.9 %".
std::string percent_words(double probability, bool are_others_left = false);

/// What departs and is no gap by itself, in two or three sentences; empty where nothing does.
std::string beside_words(const Departures& departures);

/// What was found, in one to three sentences.
std::string finding(const Diagnosis& diagnosis);
/// What to do now, a step each.
std::vector<std::string> advice(const Diagnosis& diagnosis);
/// What was found and, where several explanations are left, what would tell them apart.
std::string answer(const Diagnosis& diagnosis);

}  // namespace fathom
