// Error messages of one line that are safe for a terminal and for Python, whatever characters are in a name or a file.
#include "core/base/input_message.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/check.hpp"

namespace carom {
namespace {

std::string line_of(const std::string& what) {
  try {
    fail_input("gas.toml", what, "expected text");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string said(const std::string& what) {
  return "gas.toml: " + what + "; expected text";
}

TEST(InputMessage, KeepsTextInAnyLanguage) {
  for (const char* text : {"plain", "\u00fc", "\u20ac", "\U0001f3b1", "\ud7ff\ue000", "\U0010ffff", ""}) {
    EXPECT_EQ(line_of(text), said(text));
  }
}

TEST(InputMessage, StaysOneLineWithoutControlCharacters) {
  EXPECT_EQ(line_of("a\nb\tc\x1b[31md\x7f"), said("a?b?c?[31md?"));
  EXPECT_EQ(line_of(std::string("a\0b", 3)), said("a?b"));
  EXPECT_EQ(line_of("\xc2\x9b"
                    "31m"),
            said("??31m"))
      << "it starts a colour on some terminals";
}

TEST(InputMessage, CharactersThatHideOrTurnTextAreMarked) {
  EXPECT_EQ(line_of("gas\u202Elmot.exe"), said("gas???lmot.exe")) << "it would be shown as \"gasexe.toml\"";
  for (const char* text :
       {"\u200b", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u2060", "\u2066", "\u2069", "\u206f", "\ufeff"}) {
    EXPECT_EQ(line_of(text), said("???")) << text;
  }
  EXPECT_EQ(line_of("\u061c"), said("??"));
  for (const char* text : {"\u200c", "\u200d", "\u2010", "\u2027", "\u202f", "\u205f", "\u2070", "\ufefe", "\u061d",
                           "\u05d0\u05d1", "\u0627\u0644"}) {
    EXPECT_EQ(line_of(text), said(text)) << "neighbouring characters that are letters";
  }
}

TEST(InputMessage, BytesThatAreNoTextAreMarked) {
  EXPECT_EQ(line_of("\xff"), said("?"));
  EXPECT_EQ(line_of("\x80"), said("?"));
  EXPECT_EQ(line_of("a\xc3"), said("a?")) << "a character cut short";
  EXPECT_EQ(line_of("\xe2\x82"), said("??"));
  EXPECT_EQ(line_of("\xe2\x82x"), said("??x"));
  EXPECT_EQ(line_of("\xc0\xaf"), said("??")) << "a longer encoding than needed";
  EXPECT_EQ(line_of("\xe0\x80\xaf"), said("???"));
  EXPECT_EQ(line_of("\xf0\x80\x80\xaf"), said("????"));
  EXPECT_EQ(line_of("\xed\xa0\x80"), said("???")) << "half of a surrogate pair of UTF-16";
  EXPECT_EQ(line_of("\xf4\x90\x80\x80"), said("????")) << "beyond the last character";
  EXPECT_EQ(line_of("\xf5\x80\x80\x80"), said("????"));
}

TEST(InputMessage, AQuoteCutShortIsTextStill) {
  const std::string long_name = std::string(59, 'a') + "\u00fc and more";
  EXPECT_EQ(line_of(in_quotes(long_name)), said("\"" + std::string(59, 'a') + "?...\""));
}

}  // namespace
}  // namespace carom
