// Pages that are one file: text, tables and pictures, nothing to load.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/table.h"

namespace fathom {

/// Text of any characters for HTML, also between the quotation marks (") of an attribute; visible_text().
std::string html_escaped(std::string_view text);

/// The page from its doctype to its closing tag. `title` is plain text, `body` is HTML, as is what `head` adds to its
/// head.
std::string html_page(std::string_view title, std::string_view body, std::string_view head = "");

/// A PNG file inside the page.
std::string html_picture(const std::filesystem::path& png, std::string_view alternative);

/// An image inside the page.
std::string html_picture(const Image<std::uint8_t>& grey, std::string_view alternative);

/// Plain texts; columns of numbers are set right when `numbers`.
std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       bool numbers = false);

/// HTML that a click on its summary, a plain text, opens.
std::string html_folded(std::string_view summary, std::string_view body);

/// A table that a click on its name and number of rows opens; only a pointer to the file when it has no rows.
std::string html_details(const Table& table, const std::string& file);

}  // namespace fathom
