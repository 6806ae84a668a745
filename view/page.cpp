#include "view/page.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "report/html.h"

namespace fathom {
namespace {

constexpr const char* kThreeFiles[] = {"three.min.js", "examples/js/controls/OrbitControls.js",
                                       "examples/js/lines/LineSegmentsGeometry.js", "examples/js/lines/LineMaterial.js",
                                       "examples/js/lines/LineSegments2.js"};

/// As the content of an HTML element <script>, which only its end tag could leave.
std::string script(std::string_view text, std::string_view attributes = "") {
  std::string safe(text);
  for (std::size_t at = 0; (at = safe.find("</", at)) != std::string::npos; at += 3) safe.replace(at, 2, "<\\/");
  return fmt::format("<script{}>{}</script>\n", attributes, safe);
}

std::string three_js(const std::filesystem::path& folder) {
  std::string scripts;
  for (const char* name : kThreeFiles) {
    const std::filesystem::path file = folder / name;
    if (!std::filesystem::is_regular_file(file))
      throw Error(file.string(), "is missing: the page needs three.js, Debian's package libjs-three");
    scripts += script(read_text(file));
  }
  return scripts;
}

/// JSON for an HTML element: no "<", so that no text of a file can end the element or begin a comment.
std::string data_json(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string view_page(std::string_view title, const PageContent& content, const std::filesystem::path& three) {
  const std::string head = fmt::format("<style>{}</style>\n", kPageStyle);
  const std::string body = fmt::format(
      "<h1>{}</h1>\n<div id=\"page\"><noscript>This page is drawn by its script, which is switched off in this "
      "browser.</noscript></div>\n",
      html_escaped(title));
  return html_page(title,
                   body + script(data_json(content.data), " type=\"application/json\" id=\"data\"") + three_js(three) +
                       script(kCommonScript) + script(content.script),
                   head);
}

}  // namespace fathom
