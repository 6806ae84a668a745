#include "core/visible_text.h"

#include <gtest/gtest.h>

#include "core/json.h"

namespace fathom {
namespace {

TEST(VisibleText, TextThatShowsStaysAsItIs) {
  const std::string text = "milk_tea 30 mm \\ \"'`$@{}^~% é 水 😀 \u00a0\n\tb";
  EXPECT_EQ(visible_text(text), text);
}

TEST(VisibleText, ControlCharactersAreWrittenAsJsonWritesThem) {
  EXPECT_EQ(visible_text("a\x1b[2Jb\rc\x7f"), "a\\u001b[2Jb\\u000dc\\u007f");
  EXPECT_EQ(visible_text("\u009b2J\u0085"), "\\u009b2J\\u0085");  // C1: a terminal's control sequence in one character
  EXPECT_EQ(visible_text(std::string_view("\0", 1)), "\\u0000");
  EXPECT_EQ(on_one_line("a\nb\tc"), "a\\u000ab\\u0009c");
}

TEST(VisibleText, WhatCannotBeShownIsNamed) {
  const auto is_latin = [](char32_t code) { return code < 0x250; };
  EXPECT_EQ(on_one_line("é 牛乳 😀\n", is_latin), "é \\u725b\\u4e73 \\u1f600\\u000a");
}

TEST(VisibleText, BytesThatAreNoUtf8AreNamed) {
  EXPECT_EQ(visible_text("\x9b"), "\\x9b");        // the same control character in Latin-1
  EXPECT_EQ(visible_text("caf\xe9"), "caf\\xe9");  // Latin-1
  EXPECT_EQ(visible_text("\xc0\x9b\xed\xa0\x80"), "\\xc0\\x9b\\xed\\xa0\\x80");           // overlong; a surrogate
  EXPECT_EQ(visible_text("\xf4\x90\x80\x80\xe6\xb0"), "\\xf4\\x90\\x80\\x80\\xe6\\xb0");  // beyond Unicode; cut off
  EXPECT_EQ(visible_text("\uffff"), "\\uffff");                                           // which XML forbids
}

TEST(VisibleText, JsonThatIsPrintedStaysTheSameJson) {
  Json json;
  for (char32_t code = 0; code < 0x100; ++code) {
    std::string text;
    if (code >= 0x80) text += static_cast<char>(0xC0 | code >> 6);
    text += static_cast<char>(code < 0x80 ? code : 0x80 | (code & 0x3F));
    json[text + "key"] = text;
  }
  const std::string printed = visible_text(json_text(json));
  EXPECT_EQ(printed.find('\x1b'), std::string::npos);
  EXPECT_EQ(printed.find("\xc2\x9b"), std::string::npos);
  EXPECT_EQ(Json::parse(printed), json);
}

TEST(JsonText, NamesThatAreNoUtf8AreNoError) {
  EXPECT_EQ(Json::parse(json_text({{"file", "caf\xe9.pcd"}}))["file"], "caf\ufffd.pcd");
}

}  // namespace
}  // namespace fathom
