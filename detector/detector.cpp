#include "detector/detector.h"

#include "core/error.h"
#include "detector/paper.h"
#include "detector/registration.h"
#include "detector/robust.h"

namespace fathom {
namespace {

constexpr std::array kMethods{
    Method{"robust", "round walls that lines of sight find open, what is level inside as a test of hypotheses",
           detect_robust},
    Method{"paper", "circle in the band, ICP to templates, mean height inside against a threshold", detect_paper},
    Method{"sac-ia", "FPFH descriptors and SAC-IA, the paper's baseline; slow", detect_sac_ia},
    Method{"prerejective", "FPFH descriptors and prerejective RANSAC; slow", detect_prerejective},
};

// In the order of the values.
constexpr std::array<std::string_view, 3> kLiquidNames{"no", "yes", "unknown"};
constexpr std::array<std::string_view, 3> kKindNames{"transparent", "opaque", "unknown"};

}  // namespace

std::string_view name_of(Liquid liquid) { return kLiquidNames[static_cast<std::size_t>(liquid)]; }
std::string_view name_of(LiquidKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::span<const Method> methods() { return kMethods; }

const Method& method_named(std::string_view name) {
  std::vector<std::string> names;
  for (const Method& method : kMethods) {
    if (method.name == name) return method;
    names.emplace_back(method.name);
  }
  throw Error(unknown_name("method", name, names));
}

}  // namespace fathom
