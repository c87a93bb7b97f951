// An error is one line, whatever is put into it.
#include "engine/error.h"

#include <gtest/gtest.h>

namespace lensgraph {

namespace {

TEST(Error, JoinsItsPartsInOneLine) {
  const engine::Error error({.file = "a.gltf", .field = "meshes[2]", .reason = "is wrong", .remedy = "mend it"});
  EXPECT_STREQ(error.what(), "a.gltf: meshes[2]: is wrong; mend it");
  EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
}

TEST(Error, LeavesOutEmptyParts) {
  EXPECT_STREQ(engine::Error("is wrong").what(), "is wrong");
}

TEST(Error, NeverSpansTwoLines) {
  const engine::Error error({.file = "a\nb.png", .field = {}, .reason = "first\r\nsecond\n", .remedy = {}});
  EXPECT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
}

TEST(Error, LongPartsAreShortenedInTheMiddleAndTheOthersStayWhole) {
  std::string file(3000, 'f'), reason(1000000, 'r');
  file += "/end.gltf";
  reason = "'" + reason + "' is wrong";
  const engine::Error error({.file = file, .field = "meshes[2]", .reason = reason, .remedy = "mend it"});
  const std::string line = error.what();
  EXPECT_LE(line.size(), engine::kLongestLine);
  EXPECT_GT(line.size(), engine::kLongestLine - 40);
  EXPECT_NE(line.find("fff…fff"), std::string::npos) << line;
  EXPECT_NE(line.find("/end.gltf: meshes[2]: 'rrr"), std::string::npos) << line;
  EXPECT_NE(line.find("rrr' is wrong; mend it"), std::string::npos) << line;
  EXPECT_EQ(error.parts().file.size(), 3009u);
}

TEST(Error, CharactersStayWholeWhereverALineIsCut) {
  for (std::size_t limit = 0; limit < 30; ++limit) {
    const std::string line = engine::asLine("äöü€€€𝄞𝄞𝄞aäöü€€€𝄞𝄞𝄞", limit);
    EXPECT_LE(line.size(), limit);
    // Removing whole characters leaves nothing.
    std::string rest = line;
    for (const std::string character : {"ä", "ö", "ü", "€", "𝄞", "a", "…"}) {
      for (auto place = rest.find(character); place != std::string::npos; place = rest.find(character))
        rest.erase(place, character.size());
    }
    EXPECT_EQ(rest, "") << line;
  }
}

TEST(Error, ControlCharactersOfEveryKindBecomeBlanks) {
  EXPECT_EQ(engine::asLine("a\x1b[31mb\x7f"
                           "c\u009b"
                           "d\u2028e\u202ef\u2066g\t"),
            "a [31mb c d e f g");
  EXPECT_EQ(engine::asLine("größer … – “x”"), "größer … – “x”");
}

}  // namespace

}  // namespace lensgraph
