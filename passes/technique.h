// What a technique is to a host that chooses among several: its name, its parameters, and the functions that check and
// declare it; and how such an entry is made from a technique's own typed functions.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "passes/dof_io.h"
#include "passes/parameters.h"
#include "rendergraph/graph.h"

namespace lensgraph::passes {

enum class TechniqueInput : uint8_t {
  image,  ///< Works on colour and depth of the pinhole view; usable on any RGBZ image.
  scene,  ///< Draws the scene through SceneDraw.
};

/// What is wrong with the inputs of any technique of this kind; empty when nothing is. Pure.
std::vector<Problem> checkInputs(TechniqueInput input, const DofInputs& inputs);

/// A technique with its parameters. Immutable; a host makes one when its settings change, and keeps it over frames.
/// What it declares does not refer to it.
class ConfiguredTechnique {
 public:
  virtual ~ConfiguredTechnique() = default;

  /// Problems that need the inputs to be seen, those of checkInputs() included. Pure.
  virtual std::vector<Problem> validate(const DofInputs& inputs) const = 0;
  /// Declares the technique's nodes. Precondition: validate() found nothing.
  virtual DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs) const = 0;
  /// Executions of the graph that make one finished picture, DofInputs::frame counting them; 1 for most.
  virtual uint32_t frameCount(const DofInputs& inputs) const = 0;
};

/// Settings with which a small picture takes little time and yet all parts of the technique are at work: for tests that
/// hold every technique to the same laws, and for previews.
struct QuickSettings {
  ParameterSet parameters = {};  ///< Those that differ from the defaults.
  /// Points of a pixel that the technique looks at with them: without an aperture its picture is that of `pinhole` with
  /// as many pixelSamples.
  int pixelSamples = 1;
};

struct Technique {
  std::string_view name;    ///< As configuration names it, snake_case.
  std::string_view title;   ///< For people.
  std::string_view source;  ///< Paper.
  TechniqueInput input = TechniqueInput::image;
  std::vector<ParameterInfo> parameters;
  /// Fields of passes::Lens that change nothing in its picture, so that hosts can say so. The pinhole has no lens and
  /// lists none.
  std::span<const std::string_view> ignoredLensFields;
  /// Those of which only the size of the blur follows, not its shape.
  std::span<const std::string_view> sizeOnlyLensFields;
  std::string_view blurLimit;  ///< The parameter that limits blur radii in px, beside Lens::maxCocRadius; empty: none.
  QuickSettings quick;

  /// The technique with these parameters; absent ones take their defaults. Precondition: check() of the set against
  /// `parameters` found nothing. The result may outlive the Technique.
  std::function<std::unique_ptr<ConfiguredTechnique>(const ParameterSet& set)> configure;
};

/// A technique's own functions on its own Parameters, and what users are told of it.
template <class Parameters>
struct TechniqueDescription {
  std::string_view name, title, source;
  TechniqueInput input = TechniqueInput::image;
  std::span<const Field<Parameters>> fields = {};             ///< Of static storage duration.
  std::span<const std::string_view> ignoredLensFields = {};   ///< Likewise. See Technique.
  std::span<const std::string_view> sizeOnlyLensFields = {};  ///< Likewise.
  std::string_view blurLimit = {};                            ///< See Technique.
  DofOutputs (*declare)(rendergraph::Graph& graph, const DofInputs& inputs, const Parameters& parameters) = nullptr;
  /// Problems beyond those of checkInputs() and of single parameters; null: none.
  std::vector<Problem> (*validate)(const Parameters& parameters, const DofInputs& inputs) = nullptr;
  /// Null: 1.
  uint32_t (*frameCount)(const Parameters& parameters, const DofInputs& inputs) = nullptr;
  /// See QuickSettings.
  Parameters quick = {};
  int quickPixelSamples = 1;
};

namespace detail {

template <class Parameters>
class TypedTechnique final : public ConfiguredTechnique {
 public:
  TypedTechnique(const TechniqueDescription<Parameters>& description, Parameters parameters)
      : description_(description), parameters_(std::move(parameters)) {}

  std::vector<Problem> validate(const DofInputs& inputs) const override {
    auto problems = checkInputs(description_.input, inputs);
    if (problems.empty() && description_.validate != nullptr) problems = description_.validate(parameters_, inputs);
    return problems;
  }
  DofOutputs declare(rendergraph::Graph& graph, const DofInputs& inputs) const override {
    return description_.declare(graph, inputs, parameters_);
  }
  uint32_t frameCount(const DofInputs& inputs) const override {
    return description_.frameCount == nullptr ? 1 : description_.frameCount(parameters_, inputs);
  }

 private:
  TechniqueDescription<Parameters> description_;
  Parameters parameters_;
};

}  // namespace detail

/// The registry's entry of a technique.
template <class Parameters>
Technique makeTechnique(const TechniqueDescription<Parameters>& description) {
  return {.name = description.name,
          .title = description.title,
          .source = description.source,
          .input = description.input,
          .parameters = describe<Parameters>(description.fields),
          .ignoredLensFields = description.ignoredLensFields,
          .sizeOnlyLensFields = description.sizeOnlyLensFields,
          .blurLimit = description.blurLimit,
          .quick = {.parameters = toSet<Parameters>(description.quick, description.fields),
                    .pixelSamples = description.quickPixelSamples},
          .configure = [description](const ParameterSet& set) -> std::unique_ptr<ConfiguredTechnique> {
            return std::make_unique<detail::TypedTechnique<Parameters>>(description,
                                                                        fromSet<Parameters>(set, description.fields));
          }};
}

}  // namespace lensgraph::passes
