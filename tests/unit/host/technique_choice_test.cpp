// Techniques and parameters from configuration files and assignments.
#include "samples/host/technique_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/error.h"
#include "files.h"

namespace lensgraph {

namespace {

using testing::HasSubstr;

/// Any technique with a parameter of this type, so that these tests outlive changes of the techniques.
const passes::ParameterInfo* findParameter(passes::ParameterType type, std::string& technique) {
  for (const auto& each : passes::techniques()) {
    const auto found = std::find_if(each.parameters.begin(), each.parameters.end(),
                                    [&](const auto& info) { return info.type == type; });
    if (found == each.parameters.end()) continue;
    technique = each.name;
    return &*found;
  }
  return nullptr;
}

template <class Action>
engine::ErrorParts errorOf(Action action) {
  try {
    action();
  } catch (const engine::Error& error) {
    return error.parts();
  }
  ADD_FAILURE() << "no error";
  return {};
}

class Assignment : public testing::Test {
 protected:
  void SetUp() override {
    number_ = findParameter(passes::ParameterType::number, choice_.name);
    ASSERT_NE(number_, nullptr);
  }
  std::string name() const { return std::string(number_->name); }

  host::TechniqueChoice choice_;
  const passes::ParameterInfo* number_ = nullptr;
};

TEST_F(Assignment, SetsAParameter) {
  host::setParameter(choice_, name() + "=" + passes::toString(number_->max));
  EXPECT_EQ(std::get<double>(choice_.parameters.at(name())), number_->max);
}

TEST_F(Assignment, LaterAssignmentsWin) {
  host::setParameter(choice_, name() + "=" + passes::toString(number_->max));
  host::setParameter(choice_, name() + "=" + passes::toString(number_->min));
  EXPECT_EQ(std::get<double>(choice_.parameters.at(name())), number_->min);
}

TEST_F(Assignment, TextWithoutKeyOrEqualsSignIsRefused) {
  for (const std::string text : {"", "noEquals", "=1"}) {
    EXPECT_THAT(errorOf([&] { host::setParameter(choice_, text); }).remedy, HasSubstr("key=value")) << text;
  }
}

TEST_F(Assignment, RefusesOtherTypesAndRanges) {
  for (const std::string value : {"", "many", "nan", "inf", "1e99", "-1e99", "1x"}) {
    const auto error = errorOf([&] { host::setParameter(choice_, name() + "=" + value); });
    EXPECT_THAT(error.field, HasSubstr(name())) << value;
    EXPECT_FALSE(error.reason.empty());
    EXPECT_TRUE(choice_.parameters.empty()) << "changed by a refused assignment";
  }
}

TEST_F(Assignment, SuggestsTheNearestParameter) {
  const auto error = errorOf([&] { host::setParameter(choice_, name() + "s=1"); });
  EXPECT_THAT(error.remedy, HasSubstr(name()));
}

class TechniqueFile : public testing::Test {
 protected:
  host::TechniqueChoice read(const std::string& text, std::string_view defaultName = {}) {
    return host::readTechniqueFile(folder_.write("config.json", text), defaultName);
  }
  TestFolder folder_;
};

TEST_F(TechniqueFile, GivesNameAndParameters) {
  std::string technique;
  const auto* info = findParameter(passes::ParameterType::number, technique);
  ASSERT_NE(info, nullptr);
  const auto choice = read("{\"technique\": {\"name\": \"" + technique + "\", \"" + std::string(info->name) +
                           "\": " + passes::toString(info->max) + "}}");
  EXPECT_EQ(choice.name, technique);
  EXPECT_EQ(choice.parameters.size(), 1u);
}

TEST_F(TechniqueFile, MayLeaveTheNameToTheCommandLine) {
  EXPECT_EQ(read(R"({"technique": {}})", "two_pass_filter").name, "two_pass_filter");
  EXPECT_EQ(errorOf([&] { read(R"({"technique": {}})"); }).field, "technique.name");
}

TEST_F(TechniqueFile, IsRefusedWithTheField) {
  EXPECT_EQ(errorOf([&] { read("{}"); }).field, "technique");
  EXPECT_EQ(errorOf([&] { read(R"({"technic": {}})"); }).field, "technic");
  EXPECT_EQ(errorOf([&] { read(R"({"technique": {"name": "no such thing"}})"); }).field, "technique.name");
  EXPECT_EQ(errorOf([&] { read(R"({"technique": {"name": "two_pass_filter", "nonsense": true}})"); }).field,
            "technique.nonsense");
}

TEST(Technique, RaytracedStandsBesideThoseOfTheRegistry) {
  EXPECT_EQ(host::techniques().size(), passes::techniques().size() + 1);
  EXPECT_EQ(host::requireTechnique("raytraced", "", "").name, "raytraced");
  EXPECT_EQ(passes::findTechnique("raytraced"), nullptr) << "it has no graph";
  const auto error = errorOf([] { host::requireTechnique("raytrced", "", ""); });
  EXPECT_THAT(error.remedy, HasSubstr("raytraced"));
  host::TechniqueChoice choice{"raytraced", {}};
  host::setParameter(choice, "samples=12");
  EXPECT_EQ(std::get<int64_t>(choice.parameters.at("samples")), 12);
}

TEST(Technique, UnknownTechniquesAreRefusedWithTheNearestName) {
  const auto error = errorOf([] { host::requireTechnique("two_pas_filter", "file", "field"); });
  EXPECT_EQ(error.file, "file");
  EXPECT_EQ(error.field, "field");
  EXPECT_THAT(error.remedy, HasSubstr("two_pass_filter"));
  const auto far = errorOf([] { host::requireTechnique("qqqqqqqqqqqqqqqqqqqqq", "", ""); });
  EXPECT_THAT(far.remedy, HasSubstr("two_pass_filter")) << "all names when none is near";
}

}  // namespace

}  // namespace lensgraph
