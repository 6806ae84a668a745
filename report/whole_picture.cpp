#include "report/whole_picture.h"

#include <vector>

#include "core/files.h"
#include "core/image_file.h"

namespace fathom {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// What ends the piece of markup that begins with `text`.
std::string_view end_of_markup(std::string_view text) {
  if (text.starts_with("<!--")) return "-->";
  if (text.starts_with("<![CDATA[")) return "]]>";
  if (text.starts_with("<?")) return "?>";
  return ">";
}

}  // namespace

bool is_whole_svg(std::string_view text) {
  std::vector<std::string_view> open;  // names of elements
  bool seen = false;
  for (std::size_t begin = text.find('<'); begin != std::string_view::npos; begin = text.find('<')) {
    if (open.empty() && text.find_first_not_of(kBlanks) != begin) return false;
    text.remove_prefix(begin);
    const std::string_view last = end_of_markup(text);
    const std::size_t end = text.find(last);
    if (end == std::string_view::npos) return false;
    const std::string_view markup = text.substr(1, end - 1);
    text.remove_prefix(end + last.size());
    if (markup.starts_with('!') || markup.starts_with('?')) continue;
    if (markup.find('<') != std::string_view::npos) return false;  // a hole swallowed an end
    const bool closes = markup.starts_with('/');
    const std::string_view name = markup.substr(closes, markup.find_first_of(" \t\r\n/", closes) - closes);
    if (open.empty() && (closes || seen || name != "svg")) return false;
    if (closes && open.back() != name) return false;
    seen = true;
    if (closes)
      open.pop_back();
    else if (!markup.ends_with('/'))
      open.push_back(name);
  }
  return seen && open.empty() && text.find_first_not_of(kBlanks) == std::string_view::npos;
}

bool is_whole_picture(const std::filesystem::path& path) {
  return path.extension() == ".svg" ? is_whole_svg(read_text(path)) : is_whole_png(path);
}

}  // namespace fathom
