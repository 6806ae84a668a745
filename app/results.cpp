#include "app/results.h"

#include "app/print.h"
#include "core/files.h"
#include "core/folder_owner.h"

namespace fathom {

void write_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text) {
  if (common.output.empty()) return;
  write_text(common.output / (name + (common.json ? ".json" : extension)), text);
}

void remove_results(const CommonOptions& common, const std::string& name, const std::string& extension) {
  for (const std::string& ending : {std::string(".json"), extension})
    std::filesystem::remove(common.output / (name + ending));
}

void print_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text) {
  print_text(text);
  if (common.output.empty()) return;
  const FolderOwner owner(common.output);
  write_results(common, name, extension, text);
}

}  // namespace fathom
