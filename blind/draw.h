// What is hidden in each set of a pack: classes and shares as the blind tests want them, drawn by seed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "blind/hidden.h"
#include "blind/pack_plan.h"
#include "blind/views.h"
#include "core/json.h"

namespace fathom::blind {

/// One effect as it is hidden.
struct Truth {
  Active active;
  double strength;  ///< s, by itself
};

struct SetTruth {
  int number = 0;
  std::uint64_t seed = 0;
  std::string kind{};  ///< null, single, pair, triple, unknown, aliased, book_keeping
  std::string design{};
  std::vector<Truth> effects{};
  std::string book_keeping{};  ///< what the laboratory did wrong, or ""
  std::string left_out{};      ///< a registered effect that the analyser's registry must lack, or ""
  std::vector<std::string>
      aliased{};        ///< effects that nothing in the set can tell from the one hidden, this one among them
  double escape = 0.0;  ///< of what is unknown
  double noise_scale = 1.0;
  bool heavy_tails = false;
  std::map<std::string, double> strength_by_liquid{};
};

/// The class of each set of a pack: fixed shares, in an order drawn from the seed.
std::vector<std::string> kinds_of_pack(std::uint64_t seed, int sets);

/// Set `number` of a pack of `sets`; `views` of all designs.
SetTruth draw_set(const Views& views, std::uint64_t pack_seed, int number, int sets);

Json json_of(const SetTruth& truth);

}  // namespace fathom::blind
