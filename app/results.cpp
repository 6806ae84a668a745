#include "app/results.h"

#include <fstream>

#include "app/print.h"
#include "core/files.h"
#include "core/folder_owner.h"

namespace fathom {

void keep_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                  const std::string& text) {
  if (common.output.empty()) return;
  const FolderOwner owner(common.output);
  write_results(common, name, extension, text);
}

void write_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text) {
  if (common.output.empty()) return;
  write_text(common.output / (name + (common.json ? ".json" : extension)), text);
}

void remove_results(const CommonOptions& common, const std::string& name, const std::string& extension) {
  for (const std::string& ending : {std::string(".json"), extension})
    std::filesystem::remove(common.output / (name + ending));
}

void remove_if_ours(const std::filesystem::path& file, std::string_view words) {
  if (!std::filesystem::is_regular_file(file)) return;
  std::string head(1000, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.find(words) != std::string::npos) std::filesystem::remove(file);
}

void print_results(const CommonOptions& common, const std::string& name, const std::string& extension,
                   const std::string& text) {
  print_text(text);
  keep_results(common, name, extension, text);
}

}  // namespace fathom
