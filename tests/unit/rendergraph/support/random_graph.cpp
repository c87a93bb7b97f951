// Draws passes, resources and accesses at random, such that every declaration is legal.
#include "support/random_graph.h"

#include <array>
#include <random>
#include <string>
#include <vector>

namespace lensgraph {

using namespace rendergraph;

namespace {

constexpr VkImageUsageFlags kAllImageUsage = ~VkImageUsageFlags{0};
constexpr VkBufferUsageFlags kAllBufferUsage = ~VkBufferUsageFlags{0};

constexpr std::array<AccessState, 6> kImageStates = {{
    {0, 0, VK_IMAGE_LAYOUT_GENERAL},
    {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
    {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL},
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED},
}};

constexpr std::array<AccessState, 4> kBufferStates = {{
    {},
    {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED},
    {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_UNIFORM_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED},
    {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED},
}};

class Generator {
 public:
  Generator(Graph& graph, uint32_t seed, bool resolves) : graph_(graph), random_(seed), resolves_(resolves) {}

  void run(uint32_t passes) {
    const uint32_t resources = 3 + passes / 2;
    for (uint32_t i = 0; i < resources; ++i) addResource(i);
    for (uint32_t i = 0; i < passes; ++i) addPass(i);
    exportSome();
  }

 private:
  struct Known {
    bool isImage = true, depth = false, readOnly = false, created = true, hostVisible = false;
    bool multisampled = false;  // Only an attachment, and resolved.
    Image image;
    Buffer buffer;
    uint32_t mips = 1, layers = 1;
    std::vector<bool> written;  // By mip × layer.
    uint32_t lastPass = UINT32_MAX;
  };

  uint32_t below(uint32_t bound) { return static_cast<uint32_t>(random_() % bound); }
  bool chance(uint32_t percent) { return below(100) < percent; }

  void addResource(uint32_t index) {
    const std::string name = "r" + std::to_string(index);
    Known known;
    known.isImage = chance(75);
    if (!known.isImage) return addBuffer(name, known);
    known.depth = chance(20);
    known.mips = chance(40) ? 1 + below(4) : 1;
    known.layers = chance(30) ? 1 + below(3) : 1;
    ImageDesc desc{
        .format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 64, .height = 64, .layers = known.layers, .mips = known.mips};
    if (known.depth) desc.format = chance(30) ? VK_FORMAT_D24_UNORM_S8_UINT : VK_FORMAT_D32_SFLOAT;
    if (resolves_ && !known.depth && chance(20)) return addMultisampled(name, desc, known);
    bool written = true;
    switch (below(12)) {
      case 0: {
        const AccessState before = kImageStates[below(kImageStates.size())];
        AccessState after = chance(70) ? kImageStates[below(kImageStates.size())] : AccessState{};
        if (after.layout == VK_IMAGE_LAYOUT_UNDEFINED && chance(50)) after = {};
        known.image = graph_.importImage(name, desc, {VK_NULL_HANDLE, kAllImageUsage, before, after});
        written = before.layout != VK_IMAGE_LAYOUT_UNDEFINED;
        known.created = false;
        break;
      }
      case 1:
        known.image = graph_.persistentImage(name, desc);
        known.created = false;
        break;
      case 2: {
        const History history = graph_.history(name, desc);
        Known previous = known;
        previous.image = history.previous;
        previous.readOnly = true;
        previous.created = false;
        previous.written.assign(known.mips * known.layers, true);
        known_.push_back(previous);
        known.image = history.next;
        known.created = false;
        break;
      }
      default:
        known.image = graph_.createImage(name, desc);
        written = false;
    }
    known.written.assign(known.mips * known.layers, written);
    known_.push_back(known);
  }

  void addMultisampled(const std::string& name, ImageDesc desc, Known known) {
    desc.samples = VK_SAMPLE_COUNT_4_BIT;
    desc.mips = known.mips = 1;
    known.multisampled = true;
    known.image = graph_.createImage(name, desc);
    known.written.assign(known.layers, false);
    known_.push_back(known);
  }

  void addBuffer(const std::string& name, Known known) {
    BufferDesc desc{.size = 64 + 64 * VkDeviceSize{below(4000)}};
    bool written = true;
    switch (below(10)) {
      case 0: {
        const AccessState after = chance(50) ? kBufferStates[below(3)] : AccessState{};
        known.buffer = graph_.importBuffer(
            name, desc, {VK_NULL_HANDLE, kAllBufferUsage, kBufferStates[below(kBufferStates.size())], after});
        known.created = false;
        break;
      }
      case 1:
        known.buffer = graph_.persistentBuffer(name, desc);
        known.created = false;
        break;
      case 2:
        desc.memory = MemoryKind::readback;
        known.hostVisible = true;
        known.buffer = graph_.createBuffer(name, desc);
        written = false;
        break;
      default:
        known.buffer = graph_.createBuffer(name, desc);
        written = false;
    }
    known.written.assign(1, written);
    known_.push_back(known);
  }

  PassKind someKind() {
    if (!drawn_.empty() && chance(40)) return PassKind::raster;  // Often several in a row.
    const uint32_t roll = below(20);
    return roll < 8    ? PassKind::compute
           : roll < 15 ? PassKind::raster
           : roll < 19 ? PassKind::transfer
                       : PassKind::host;
  }

  void addPass(uint32_t index) {
    const PassKind kind = someKind();
    Pass pass = graph_.addPass("p" + std::to_string(index), kind);
    if (kind == PassKind::compute && chance(40)) pass.prefer(QueuePreference::asyncCompute);
    if (kind == PassKind::transfer && chance(70)) {
      pass.prefer(chance(70) ? QueuePreference::transfer : QueuePreference::asyncCompute);
    }
    const bool repeating = kind == PassKind::raster && !drawn_.empty() && chance(60);
    if (repeating) {
      repeatAttachments(pass, index);
    } else {
      drawn_.clear();
      if (kind == PassKind::raster) addAttachments(pass, index);
    }
    // A pass that only draws on can share the rendering of the one before.
    const uint32_t accesses = repeating ? below(3) : 1 + below(4);
    for (uint32_t i = 0; i < accesses; ++i) {
      Known& known = known_[pick()];
      if (known.lastPass == index || known.multisampled) continue;
      known.lastPass = index;
      if (known.isImage) {
        if (kind != PassKind::host) useImage(pass, kind, known);
      } else {
        useBuffer(pass, kind, known);
      }
    }
    if (chance(4)) pass.sideEffect();
  }

  /// Prefers resources close to each other, so that lifetimes are short and memory is shared.
  std::size_t pick() {
    if (chance(30)) return below(static_cast<uint32_t>(known_.size()));
    const uint32_t window = std::min<uint32_t>(8, static_cast<uint32_t>(known_.size()));
    start_ = std::min<std::size_t>(known_.size() - window, start_ + (chance(25) ? 1 : 0));
    return start_ + below(window);
  }

  Subresources someRange(const Known& known) {
    if (chance(50)) return {.firstMip = 0, .mipCount = known.mips, .firstLayer = 0, .layerCount = known.layers};
    const uint32_t mip = below(known.mips), layer = below(known.layers);
    return {.firstMip = mip,
            .mipCount = 1 + below(known.mips - mip),
            .firstLayer = layer,
            .layerCount = 1 + below(known.layers - layer)};
  }
  static bool isWritten(const Known& known, const Subresources& range) {
    for (uint32_t m = range.firstMip; m < range.firstMip + range.mipCount; ++m) {
      for (uint32_t l = range.firstLayer; l < range.firstLayer + range.layerCount; ++l) {
        if (!known.written[m * known.layers + l]) return false;
      }
    }
    return true;
  }
  static void markWritten(Known& known, const Subresources& range) {
    for (uint32_t m = range.firstMip; m < range.firstMip + range.mipCount; ++m) {
      for (uint32_t l = range.firstLayer; l < range.firstLayer + range.layerCount; ++l) {
        known.written[m * known.layers + l] = true;
      }
    }
  }

  /// An attachment of the raster pass before.
  struct Drawn {
    std::size_t known;
    Subresources range;
    bool tested = false;    // Read only.
    bool resolved = false;  // Receives the samples of the one before it.
  };

  void draw(Pass& pass, uint32_t index, const Drawn& drawn, LoadOp load) {
    Known& known = known_[drawn.known];
    known.lastPass = index;
    drawn_.push_back(drawn);
    if (drawn.tested) return pass.depthReadOnly(known.image, drawn.range);
    if (drawn.resolved) {
      known.image = pass.resolve(known.image, drawn.range);
    } else if (known.depth) {
      known.image = pass.depth(known.image, {.load = load, .range = drawn.range});
    } else {
      known.image = pass.color(known.image, {.load = load, .range = drawn.range});
    }
    markWritten(known, drawn.range);
  }

  void repeatAttachments(Pass& pass, uint32_t index) {
    const std::vector<Drawn> before = std::move(drawn_);
    drawn_.clear();
    const LoadOp load = chance(85) ? LoadOp::load : chance(50) ? LoadOp::dontCare : LoadOp::clear;
    for (const Drawn& drawn : before) draw(pass, index, drawn, load);
    if (before.empty()) pass.renderArea({64, 64});
  }

  void addAttachments(Pass& pass, uint32_t index) {
    const bool multisampled = resolves_ && chance(30);
    const uint32_t mip = multisampled ? 0 : below(3), layers = 1 + below(2);
    bool depthTaken = false;
    for (uint32_t i = 0; i < 3; ++i) {
      const std::size_t picked = pick();
      const Known& known = known_[picked];
      const bool fits = known.isImage && !known.readOnly && known.lastPass != index && mip < known.mips &&
                        layers <= known.layers && !(known.depth && (depthTaken || multisampled)) &&
                        known.multisampled == multisampled;
      if (!fits) continue;
      const uint32_t layer = below(known.layers - layers + 1);
      const Subresources range{.firstMip = mip, .mipCount = 1, .firstLayer = layer, .layerCount = layers};
      const bool written = isWritten(known, range);
      const LoadOp load = written && chance(50) ? LoadOp::load : chance(50) ? LoadOp::clear : LoadOp::dontCare;
      const bool tested = known.depth && written && chance(40);
      depthTaken = depthTaken || known.depth;
      draw(pass, index, {.known = picked, .range = range, .tested = tested}, load);
      if (tested && chance(50)) pass.sample(known.image, range);
      if (multisampled && chance(80)) addResolve(pass, index, layers);
    }
    if (drawn_.empty()) pass.renderArea({64, 64});
  }

  /// Of the colour attachment just declared, if a target is found.
  void addResolve(Pass& pass, uint32_t index, uint32_t layers) {
    for (uint32_t i = 0; i < 4; ++i) {
      const std::size_t picked = pick();
      const Known& known = known_[picked];
      const bool fits = known.isImage && !known.depth && !known.readOnly && !known.multisampled &&
                        known.lastPass != index && layers <= known.layers;
      if (!fits) continue;
      const uint32_t layer = below(known.layers - layers + 1);
      const Subresources range{.firstMip = 0, .mipCount = 1, .firstLayer = layer, .layerCount = layers};
      return draw(pass, index, {.known = picked, .range = range, .resolved = true}, LoadOp::dontCare);
    }
  }

  void useImage(Pass& pass, PassKind kind, Known& known) {
    Subresources range = someRange(known);
    const bool written = isWritten(known, range);
    const bool reading = known.readOnly || (written && chance(55));
    if (kind == PassKind::transfer) {
      if (reading) return pass.read(known.image, Usage::transferSource, range);
      known.image = written && chance(30) ? pass.modify(known.image, Usage::transferDestination, range)
                                          : pass.write(known.image, Usage::transferDestination, range);
      return markWritten(known, range);
    }
    if (reading) {
      VkPipelineStageFlags2 stages = 0;
      if (kind == PassKind::raster && chance(50)) stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
      if (known.depth || chance(70)) {
        if (known.depth && chance(50)) range.aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
        return pass.sample(known.image, range, stages);
      }
      return pass.read(known.image, Usage::storage, range, stages);
    }
    if (known.depth) return;
    const VkPipelineStageFlags2 stages =
        kind == PassKind::raster ? VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    if (written && chance(15)) pass.sample(known.image, range, stages);  // Both ways at once.
    known.image = written && chance(40) ? pass.modify(known.image, Usage::storage, range, stages)
                                        : pass.write(known.image, Usage::storage, range, stages);
    // A mip chain built in one pass: reads one part, writes another.
    markWritten(known, range);
  }

  void useBuffer(Pass& pass, PassKind kind, Known& known) {
    const bool written = known.written[0];
    const bool reading = written && chance(55);
    if (kind == PassKind::host) {
      if (!known.hostVisible) return;
      if (reading) return pass.read(known.buffer, Usage::host);
      known.buffer = pass.write(known.buffer, Usage::host);
      known.written[0] = true;
      return;
    }
    if (kind == PassKind::transfer) {
      if (reading) return pass.read(known.buffer, Usage::transferSource);
      known.buffer = pass.write(known.buffer, Usage::transferDestination);
      known.written[0] = true;
      return;
    }
    if (reading) {
      constexpr std::array<Usage, 5> kReads = {Usage::storage, Usage::uniform, Usage::indirect, Usage::vertex,
                                               Usage::index};
      return pass.read(known.buffer, kReads[below(kind == PassKind::raster ? 5 : 3)]);
    }
    known.buffer =
        written && chance(50) ? pass.modify(known.buffer, Usage::storage) : pass.write(known.buffer, Usage::storage);
    known.written[0] = true;
  }

  void exportSome() {
    for (Known& known : known_) {
      bool written = false;
      for (bool part : known.written) written = written || part;
      const bool persistentToo = !known.created && !known.readOnly && chance(5);
      if (!written || known.multisampled || !(known.created ? chance(30) : persistentToo)) continue;
      if (known.isImage) {
        AccessState after = kImageStates[below(5)];
        graph_.exportImage(known.image, after);
      } else {
        graph_.exportBuffer(known.buffer, kBufferStates[below(4)]);
      }
    }
  }

  Graph& graph_;
  std::mt19937 random_;
  bool resolves_;
  std::vector<Known> known_;
  std::vector<Drawn> drawn_;  // Attachments of the pass before, when that was a raster pass.
  std::size_t start_ = 0;
};

}  // namespace

void declareRandom(Graph& graph, uint32_t seed, uint32_t passes, bool resolves) {
  Generator(graph, seed, resolves).run(passes);
}

}  // namespace lensgraph
