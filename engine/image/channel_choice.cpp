// Choosing channels by their names: see channel_choice.h.
#include "engine/image/channel_choice.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "engine/image/image_format.h"

namespace lensgraph::engine {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

/// A channel, and its names for comparing: lower case.
struct Channel {
  size_t part, index;
  std::string name;   ///< As it is shown: with its layer.
  std::string layer;  ///< As it is shown; may be empty.
  std::string fold;   ///< Lower-case layer.
  std::string leaf;   ///< Lower-case last word.
};

/// A layer that several parts have gets the part's name before its own in each.
void nameParts(const std::vector<PicturePart>& parts, std::vector<Channel>& all) {
  std::map<std::string, std::set<size_t>> partsOf;
  for (const Channel& channel : all) partsOf[channel.fold].insert(channel.part);
  for (Channel& channel : all) {
    const std::string& part = parts[channel.part].name;
    if (partsOf[channel.fold].size() < 2 || part.empty()) continue;
    channel.name = part + "." + channel.name;
    channel.layer = part + "." + channel.layer;
    channel.fold = lower(channel.layer);
  }
}

/// Every channel of the parts that can be read.
std::vector<Channel> channelsOf(const std::vector<PicturePart>& parts) {
  std::vector<Channel> all;
  for (size_t part = 0; part < parts.size(); ++part) {
    if (parts[part].isDeep) continue;
    for (size_t index = 0; index < parts[part].channels.size(); ++index) {
      const std::string& name = parts[part].channels[index];
      const size_t dot = name.rfind('.');
      const bool isPlain = dot == std::string::npos;
      const std::string layer = isPlain ? parts[part].name : name.substr(0, dot);
      const std::string shown = isPlain && !layer.empty() ? layer + "." + name : name;
      all.push_back({part, index, shown, layer, lower(layer), lower(isPlain ? name : name.substr(dot + 1))});
    }
  }
  nameParts(parts, all);
  return all;
}

/// "a, b, c", the first ones when there are many.
std::string listed(const std::vector<std::string>& names) {
  constexpr size_t kMostCharacters = 240;
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0 && text.size() + names[i].size() > kMostCharacters) {
      return text + ", … (" + std::to_string(names.size()) + " in all)";
    }
    text += (i > 0 ? ", " : "") + (names[i].empty() ? "(unnamed)" : names[i].substr(0, kMostCharacters));
  }
  return text.empty() ? "none" : text;
}

std::vector<std::string> namesOf(const std::vector<Channel>& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

std::string remedyOf(const ChannelChoice& choice) {
  return choice.option.empty() ? "" : "choose one with " + choice.option + " NAME";
}

/// Nothing was found: says why, where that is to be seen.
void refuseUnreadable(const fs::path& path, const std::vector<PicturePart>& parts, const std::vector<Channel>& all) {
  if (all.empty() && std::ranges::any_of(parts, &PicturePart::isDeep)) {
    failImage(path, "holds deep data, which is not read");
  }
}

ChosenChannels chosen(const std::vector<PicturePart>& parts, const std::vector<const Channel*>& channels) {
  ChosenChannels result;
  result.part = channels.front()->part;
  result.names = {.part = parts[result.part].name, .layer = channels.front()->layer, .channels = {}};
  for (const Channel* channel : channels) {
    result.channels.push_back(channel->index);
    const std::string& name = parts[result.part].channels[channel->index];
    if (result.names.channels.empty() || result.names.channels.back() != name) result.names.channels.push_back(name);
  }
  return result;
}

/// Whether a layer's words say that it holds neither colour nor depth, however its channels are called.
bool isOtherData(std::string_view layer) {
  for (size_t start = 0; start <= layer.size();) {
    const size_t end = std::min(layer.find('.', start), layer.size());
    const auto word = layer.substr(start, end - start);
    if (isOneOf(word, {"n", "p", "uv", "st", "mist", "vector", "vectors", "velocity", "motion", "mv", "pos", "xyz"})) {
      return true;
    }
    for (const std::string_view part : {"normal", "position", "tangent", "motionvector", "pworld", "flow", "crypto"}) {
      if (word.find(part) != std::string_view::npos) return true;
    }
    start = end + 1;
  }
  return false;
}

// ---- Colour

/// The channels of one layer of one part.
struct Layer {
  size_t part;
  std::string name, fold;
  std::vector<const Channel*> channels;

  const Channel* find(std::initializer_list<std::string_view> leaves) const {
    for (const Channel* channel : channels) {
      if (isOneOf(channel->leaf, leaves)) return channel;
    }
    return nullptr;
  }
  bool hasRgb() const { return find({"r", "red"}) && find({"g", "green"}) && find({"b", "blue"}); }
  /// A layer of luminance alone: X or Z beside it make it XYZ, RY and BY luminance and chroma.
  bool isGrey() const { return channels.size() == 1 || (find({"y"}) && !find({"x", "z", "ry", "by"})); }
};

std::vector<Layer> layersOf(const std::vector<Channel>& all) {
  std::vector<Layer> layers;
  for (const Channel& channel : all) {
    auto layer = std::ranges::find_if(
        layers, [&](const Layer& each) { return each.part == channel.part && each.fold == channel.fold; });
    if (layer == layers.end()) layer = layers.insert(layer, Layer{channel.part, channel.layer, channel.fold, {}});
    layer->channels.push_back(&channel);
  }
  return layers;
}

/// The layer's picture itself, by the names that renderers give it.
bool isMainLayer(const Layer& layer) {
  const size_t dot = layer.fold.rfind('.');
  const auto word = std::string_view(layer.fold).substr(dot == std::string::npos ? 0 : dot + 1);
  return isOneOf(word, {"", "combined", "beauty", "rgba", "rgb", "color", "colour"});
}

ChosenChannels colorOf(const std::vector<PicturePart>& parts, const Layer& layer) {
  const Channel* alpha = layer.find({"a", "alpha"});
  std::vector<const Channel*> channels;
  if (layer.hasRgb()) {
    channels = {layer.find({"r", "red"}), layer.find({"g", "green"}), layer.find({"b", "blue"})};
  } else {
    const Channel* grey = layer.channels.size() == 1 ? layer.channels.front() : layer.find({"y"});
    channels.assign(alpha != nullptr && grey != alpha ? 3 : 1, grey);
    if (grey == alpha) alpha = nullptr;
  }
  if (alpha != nullptr) channels.push_back(alpha);
  return chosen(parts, channels);
}

std::vector<const Layer*> candidatesForColor(const std::vector<Layer>& layers) {
  std::vector<const Layer*> rgb, main;
  for (const Layer& layer : layers) {
    if (!layer.hasRgb() || isOtherData(layer.fold)) continue;
    rgb.push_back(&layer);
    if (isMainLayer(layer)) main.push_back(&layer);
  }
  const auto unnamed = std::ranges::find_if(main, [](const Layer* layer) { return layer->fold.empty(); });
  if (unnamed != main.end()) return {*unnamed};
  return main.size() == 1 ? main : rgb;
}

std::vector<std::string> namesOf(const std::vector<const Layer*>& layers) {
  std::vector<std::string> names;
  for (const Layer* layer : layers) names.push_back(layer->name);
  return names;
}

// ---- Depth

bool isDepthWord(std::string_view word) {
  return isOneOf(word, {"depth", "zdepth", "z-depth", "z_depth", "depthz"});
}

std::string_view lastWord(std::string_view layer) {
  const size_t dot = layer.rfind('.');
  return dot == std::string_view::npos ? layer : layer.substr(dot + 1);
}

/// Whether names alone say that it is depth.
bool isDepth(const Channel& channel, const Layer& layer) {
  if (isOtherData(channel.fold)) return false;
  if (isDepthWord(channel.leaf)) return true;
  const bool isInDepthLayer = isDepthWord(lastWord(channel.fold)) || lastWord(channel.fold) == "z";
  if (channel.leaf == "z") return isInDepthLayer || layer.find({"x"}) == nullptr;
  return isInDepthLayer && (channel.leaf == "v" || layer.channels.size() == 1);
}

std::vector<const Channel*> candidatesForDepth(const std::vector<Channel>& all) {
  std::vector<const Channel*> found;
  for (const Layer& layer : layersOf(all)) {
    for (const Channel* channel : layer.channels) {
      if (isDepth(*channel, layer)) found.push_back(channel);
    }
  }
  // A layer that is called depth comes before Z of another, such as Blender's "Denoising Depth".
  const auto isNamed = [](const Channel* channel) {
    return channel->fold.empty() || isDepthWord(channel->leaf) || isDepthWord(lastWord(channel->fold)) ||
           lastWord(channel->fold) == "z";
  };
  if (std::ranges::any_of(found, isNamed))
    std::erase_if(found, [&](const Channel* channel) { return !isNamed(channel); });
  // The only channel of a file is its depth, unless it is called like something else.
  if (found.empty() && all.size() == 1 && !isOtherData(all.front().fold) &&
      !isOneOf(all.front().leaf, {"r", "g", "b", "a", "x", "y", "u", "ry", "by", "red", "green", "blue", "alpha",
                                  "luminance", "grey", "gray", "mist"})) {
    found.push_back(&all.front());
  }
  return found;
}

/// By its name as shown, else as in the file; letters as given, else in either case.
std::vector<const Channel*> channelsNamed(const std::vector<PicturePart>& parts, const std::vector<Channel>& all,
                                          const std::string& name) {
  std::vector<const Channel*> found;
  const auto collect = [&](auto matches) {
    if (!found.empty()) return;
    for (const Channel& channel : all) {
      if (matches(channel)) found.push_back(&channel);
    }
  };
  const auto inFile = [&](const Channel& channel) { return parts[channel.part].channels[channel.index]; };
  collect([&](const Channel& channel) { return channel.name == name; });
  collect([&](const Channel& channel) { return lower(channel.name) == lower(name); });
  collect([&](const Channel& channel) { return lower(inFile(channel)) == lower(name); });
  return found;
}

}  // namespace

ChosenChannels chooseColor(const fs::path& path, const std::vector<PicturePart>& parts, const ChannelChoice& choice) {
  const std::vector<Channel> all = channelsOf(parts);
  refuseUnreadable(path, parts, all);
  const std::vector<Layer> layers = layersOf(all);
  if (!choice.name.empty()) {
    std::vector<const Layer*> usable;
    for (const Layer& layer : layers) {
      if (!layer.hasRgb() && !layer.isGrey()) continue;
      if (layer.fold == lower(choice.name)) return colorOf(parts, layer);
      usable.push_back(&layer);
    }
    failImage(path, "has no colour layer '" + choice.name + "'; it has " + listed(namesOf(usable)));
  }
  const auto candidates = candidatesForColor(layers);
  if (candidates.size() == 1) return colorOf(parts, *candidates.front());
  if (candidates.size() > 1) {
    failImage(path, "has several colour layers: " + listed(namesOf(candidates)), remedyOf(choice));
  }
  if (layers.size() == 1 && layers.front().isGrey()) return colorOf(parts, layers.front());
  const auto grey = std::ranges::find_if(
      layers, [](const Layer& layer) { return layer.fold.empty() && layer.find({"y"}) != nullptr && layer.isGrey(); });
  if (grey != layers.end()) return colorOf(parts, *grey);
  const bool isXyz =
      std::ranges::any_of(layers, [](const Layer& layer) { return layer.find({"y"}) && layer.find({"x"}); });
  const bool isYc = std::ranges::any_of(layers, [](const Layer& layer) { return layer.find({"ry", "by"}) != nullptr; });
  failImage(path, "has no colour channels R, G, B; it has " + listed(namesOf(all)),
            isYc    ? "luminance and chroma are not read: store it as R, G, B"
            : isXyz ? "X, Y, Z are not read as colour: store it as R, G, B"
                    : remedyOf(choice));
}

ChosenChannels chooseDepth(const fs::path& path, const std::vector<PicturePart>& parts, const ChannelChoice& choice) {
  const std::vector<Channel> all = channelsOf(parts);
  refuseUnreadable(path, parts, all);
  const auto named = [](const std::vector<const Channel*>& channels) {
    std::vector<std::string> names;
    for (const Channel* channel : channels) names.push_back(channel->name);
    return listed(names);
  };
  if (!choice.name.empty()) {
    const auto found = channelsNamed(parts, all, choice.name);
    if (found.size() == 1) return chosen(parts, found);
    if (found.size() > 1)
      failImage(path, "has several channels '" + choice.name + "': " + named(found), remedyOf(choice));
    failImage(path, "has no channel '" + choice.name + "'; it has " + listed(namesOf(all)));
  }
  const auto found = candidatesForDepth(all);
  if (found.size() == 1) return chosen(parts, found);
  if (found.empty()) {
    failImage(path, "has no depth channel (Z, depth, Depth.Z …); it has " + listed(namesOf(all)), remedyOf(choice));
  }
  failImage(path, "has several depth channels: " + named(found), remedyOf(choice));
}

}  // namespace lensgraph::engine
