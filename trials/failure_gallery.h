// The failures of an evaluation on one page: counted by kind, each with its picture and the method's words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trials/trial.h"

namespace fathom {

/// How a trial failed first, in one word for a file's name; nothing when all is right: a miss, "liquid" (one is seen in
/// an empty cup, or none in a filled one) or "false_cup".
std::string failure_of(const TrialResult& trial);

/// How many trials failed in which way, as a table in HTML.
std::string failure_counts(const std::vector<TrialResult>& trials);

/// The pictures NUMBER_KIND.png of the trials that failed, by kind, with what happened. `beside` leads to them from the
/// page, "failures/".
std::string failure_figures(const std::vector<TrialResult>& trials, const std::string& beside);

/// Writes folder/failures/index.html, which shows failures/NUMBER_KIND.png of these trials. An earlier run may have
/// left pictures of more.
void write_failure_gallery(const std::filesystem::path& folder, const std::vector<TrialResult>& trials);

}  // namespace fathom
