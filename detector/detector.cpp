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

}  // namespace

std::string_view name_of(Liquid liquid) {
  switch (liquid) {
    case Liquid::kYes:
      return "yes";
    case Liquid::kNo:
      return "no";
    case Liquid::kUnknown:
      break;
  }
  return "unknown";
}

std::string_view name_of(LiquidKind kind) {
  switch (kind) {
    case LiquidKind::kTransparent:
      return "transparent";
    case LiquidKind::kOpaque:
      return "opaque";
    case LiquidKind::kUnknown:
      break;
  }
  return "unknown";
}

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
