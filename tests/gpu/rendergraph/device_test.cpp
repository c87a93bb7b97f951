// Listing and choosing devices, as a user of --device meets it.
#include "engine/vulkan/device.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>

#include "engine/error.h"
#include "tests/support/gpu/gpu_test.h"

namespace lensgraph {

namespace {

using testing::HasSubstr;
using testing::Not;

class Devices : public support::GpuTest {};

std::string mapped(std::string text, int (*letter)(int)) {
  std::transform(text.begin(), text.end(), text.begin(), [=](unsigned char c) { return static_cast<char>(letter(c)); });
  return text;
}

TEST_F(Devices, AreListedWithWhatAUserNeedsToChoose) {
  const auto list = engine::listDevices();
  ASSERT_FALSE(list.empty());
  for (const auto& device : list) {
    EXPECT_FALSE(device.name.empty());
    EXPECT_THAT(device.type, testing::AnyOf("discrete", "integrated", "virtual", "cpu", "other"));
    // A name and a version, not a lone blank.
    EXPECT_THAT(device.driver, testing::ContainsRegex("[a-zA-Z].* .*[0-9]"));
  }
  EXPECT_TRUE(std::any_of(list.begin(), list.end(), [](const auto& d) { return d.missing.empty(); }));
}

TEST_F(Devices, AreChosenByIndexAndByPartOfTheNameInAnyCase) {
  const auto list = engine::listDevices();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].missing.empty()) continue;
    const engine::Device byIndex({.select = std::to_string(i), .validation = false});
    EXPECT_EQ(byIndex.description().name, list[i].name);
    EXPECT_EQ(byIndex.description().driver, list[i].driver);
    EXPECT_TRUE(byIndex.description().missing.empty());
    EXPECT_NE(byIndex.handle(), VkDevice{VK_NULL_HANDLE});
    const std::string part = list[i].name.substr(0, 5);
    for (const auto& select : {mapped(part, std::toupper), mapped(part, std::tolower)}) {
      const engine::Device byName({.select = select, .validation = false});
      EXPECT_THAT(mapped(byName.description().name, std::tolower), HasSubstr(mapped(part, std::tolower))) << select;
    }
  }
}

TEST_F(Devices, AnUnknownDeviceIsRefusedWithTheListOfDevices) {
  const auto list = engine::listDevices();
  for (const std::string& select : {std::string("no such device"), std::to_string(list.size()), std::string("-1")}) {
    try {
      const engine::Device device({.select = select, .validation = false});
      ADD_FAILURE() << "'" << select << "' was taken for " << device.description().name;
    } catch (const engine::Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("'" + select + "'"));
      for (std::size_t i = 0; i < list.size(); ++i) {
        EXPECT_THAT(error.what(), HasSubstr(std::to_string(i) + ": " + list[i].name));
      }
      EXPECT_EQ(error.parts().field, "device");
      EXPECT_THAT(error.parts().remedy, Not(testing::IsEmpty()));
    }
  }
}

}  // namespace

}  // namespace lensgraph
