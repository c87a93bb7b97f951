// What every technique asks of its inputs.
#include "passes/technique.h"

namespace lensgraph::passes {

std::vector<Problem> checkInputs(TechniqueInput input, const DofInputs& inputs) {
  std::vector<Problem> problems;
  if (input == TechniqueInput::scene && (inputs.scene == nullptr || !inputs.scene->record)) {
    problems.push_back({"", "the technique draws a scene, and there is none", "set DofInputs::scene"});
  }
  if (input == TechniqueInput::image && !inputs.color) {
    problems.push_back({"", "the technique needs a color image", "set DofInputs::color"});
  }
  if (input == TechniqueInput::image && !inputs.depth) {
    problems.push_back({"", "the technique needs a depth image", "set DofInputs::depth"});
  }
  if (inputs.extent.width == 0 || inputs.extent.height == 0) {
    problems.push_back({"", "the picture has no pixels", "set DofInputs::extent"});
  }
  return problems;
}

}  // namespace lensgraph::passes
