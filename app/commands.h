// Every command of the program, in the order of `fathom --help`.
#pragma once

#include <array>

#include "app/command.h"

namespace fathom {

std::function<void()> define_theory(CLI::App& app, const CommonOptions& common);

inline constexpr std::array kCommands{
    Command{"theory", "The paper's Eq. 7 and the exact triangulation of the raised bottom, as CSV",
            "  fathom theory\n  fathom theory --fill-mm 30 --distance-mm 200,400,600 --lateral-mm 50\n  fathom theory "
            "--max-skew",
            define_theory},
};

}  // namespace fathom
