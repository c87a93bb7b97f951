// SSIM against scikit-image's structural_similarity, called when the test runs.
#include "engine/metrics/ssim.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "engine/metrics/metrics.h"
#include "metrics/metric_pictures.h"
#include "metrics/python_check.h"

namespace lensgraph {
namespace {

using engine::FloatImage;

TEST(Ssim, EqualsScikitImage) {
  struct Size {
    uint32_t width, height;
  };
  // The last one is as small as SSIM can be; the second one lies in three bands.
  const std::vector<Size> sizes = {{64, 48}, {37, 150}, {11, 11}};
  const test::TemporaryFolder folder;
  std::vector<std::string> lines;
  for (const Size& size : sizes) {
    const FloatImage reference = metricScene(size.width, size.height, 4.0f);
    const std::string name = (folder / std::to_string(size.width)).string();
    writeFloats(name + ".picture", metricMistake(reference, 9));
    writeFloats(name + ".reference", reference);
    std::ostringstream line;
    line << size.width << " " << size.height << " " << name << ".picture " << name << ".reference";
    lines.push_back(line.str());
  }
  const auto printed = runPython("ssim_reference.py", lines);
  if (!printed) GTEST_SKIP() << kNoPython;
  std::istringstream figures(*printed);
  for (const Size& size : sizes) {
    const FloatImage reference = metricScene(size.width, size.height, 4.0f);
    const auto measured = engine::compareImages(metricMistake(reference, 9), reference).ssim;
    double expected = 0.0;
    ASSERT_TRUE(figures >> expected);
    EXPECT_LT(expected, 0.98);
    EXPECT_NEAR(measured.value(), expected, 1e-4);
    std::ostringstream difference;
    difference << measured.value() - expected;
    RecordProperty("difference" + std::to_string(size.width), difference.str());
  }
}

}  // namespace
}  // namespace lensgraph
