// The journal of a benchmark: kept over interruptions, bound to one benchmark.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/error.h"
#include "samples/lensgraph/bench/journal.h"
#include "tests/support/temporary_folder.h"

namespace lensgraph::cli {
namespace {

const nlohmann::ordered_json kIdentity = {{"config", "abc"}, {"commit", "123"}};

TEST(BenchJournal, KeepsRecordsForTheNextRun) {
  test::TemporaryFolder folder;
  {
    Journal journal(folder.path(), kIdentity);
    EXPECT_EQ(journal.find("a"), nullptr);
    journal.add("a", {{"value", 1}});
    journal.add("b", {{"value", 2}});
  }
  const Journal again(folder.path(), kIdentity);
  ASSERT_EQ(again.records().size(), 2u);
  ASSERT_NE(again.find("b"), nullptr);
  EXPECT_EQ((*again.find("b"))["value"], 2);
}

TEST(BenchJournal, DropsALineThatWasCutOff) {
  test::TemporaryFolder folder;
  Journal(folder.path(), kIdentity).add("a", {{"value", 1}});
  std::ofstream(folder / "journal.jsonl", std::ios::app) << R"({"key":"b","val)";
  {
    Journal again(folder.path(), kIdentity);
    EXPECT_EQ(again.records().size(), 1u);
    EXPECT_EQ(again.find("b"), nullptr);
    again.add("b", {{"value", 3}});
  }
  EXPECT_EQ((*Journal(folder.path(), kIdentity).find("b"))["value"], 3);
}

TEST(BenchJournal, RefusesAnotherBenchmarkAndNamesTheDifference) {
  test::TemporaryFolder folder;
  Journal(folder.path(), kIdentity).add("a", {{"value", 1}});
  try {
    Journal other(folder.path(), {{"config", "abc"}, {"commit", "456"}});
    FAIL() << "the commit differs";
  } catch (const engine::Error& error) {
    EXPECT_EQ(error.kind(), engine::ErrorKind::badInput);
    EXPECT_THAT(error.what(), testing::HasSubstr("commit: is 123, this benchmark's is 456"));
  }
  EXPECT_EQ(Journal(folder.path(), kIdentity).records().size(), 1u);
}

TEST(BenchJournal, RefusesASecondWriterAndForeignFiles) {
  test::TemporaryFolder folder;
  {
    Journal journal(folder.path(), kIdentity);
    EXPECT_THROW(Journal(folder.path(), kIdentity), engine::Error);
  }
  std::ofstream(folder / "journal.jsonl") << "something else\n";
  EXPECT_THROW(Journal(folder.path(), kIdentity), engine::Error);
  EXPECT_THROW(Journal(folder / "none", kIdentity), engine::Error);
}

}  // namespace
}  // namespace lensgraph::cli
