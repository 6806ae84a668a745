// The groups of measurements. Each function prepares its inputs and registers its benchmarks as group/case/side.
#pragma once

namespace fathom {

void register_geometric();
void register_photometric();
void register_light();
void register_match();
void register_detect();
void register_generate();
void register_others();

}  // namespace fathom
