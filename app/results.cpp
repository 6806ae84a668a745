#include "app/results.h"

#include <fmt/format.h>

#include "core/files.h"

namespace fathom {

void keep_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                  const std::string& text) {
  if (common.output.empty()) return;
  make_directory(common.output);
  write_text(common.output / (name + (common.json ? ".json" : extension)), text);
}

void print_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text) {
  fmt::print("{}", text);
  keep_results(common, name, extension, text);
}

}  // namespace fathom
