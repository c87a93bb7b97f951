// Content that nothing wrote, states that imports lack, limits of the device.
#include "rendergraph/compile/flow/validation.h"

#include <string>

#include "rendergraph/compile/flow/cells.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

namespace {

using Problems = std::vector<GraphError::Problem>;

void checkLimits(const Declaration& declaration, const DeviceFacts& device, Problems& problems) {
  for (uint32_t index = 0; index < declaration.resources.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    const auto report = [&](const std::string& what, uint64_t value, uint64_t limit) {
      problems.push_back(declaration.problem(Misuse::overLimit, kNone, index,
                                             what + " " + std::to_string(value) + " is over the device's limit",
                                             "stay within " + std::to_string(limit), resource.where));
    };
    if (!resource.isImage) {
      if (resource.buffer.size > device.maxBufferSize()) {
        report("its size of", resource.buffer.size, device.maxBufferSize());
      }
      continue;
    }
    const ImageDesc& desc = resource.image;
    if (desc.width > device.maxImageSize()) report("its width of", desc.width, device.maxImageSize());
    if (desc.height > device.maxImageSize()) report("its height of", desc.height, device.maxImageSize());
    if (desc.layers > device.maxImageLayers()) report("its layer count of", desc.layers, device.maxImageLayers());
  }
}

/// Buffers may be larger than what a shader can see of one. Each buffer is reported once, with the first pass that binds
/// too much of it.
void checkBoundRanges(const Declaration& declaration, const DeviceFacts& device, Problems& problems) {
  std::vector<uint8_t> reported(declaration.resources.size(), 0);
  for (const DeclaredAccess& access : declaration.accesses) {
    const DeclaredResource& resource = declaration.resources[access.resource];
    const bool isUniform = access.usage == Usage::uniform;
    if (resource.isImage || reported[access.resource] || !(isUniform || access.usage == Usage::storage)) continue;
    const VkDeviceSize limit = isUniform ? device.maxUniformRange() : device.maxStorageRange();
    const VkDeviceSize size = resource.buffer.size;
    // The size itself is reported as a buffer's.
    if (size <= limit || size > device.maxBufferSize()) continue;
    reported[access.resource] = 1;
    problems.push_back(declaration.problem(Misuse::overLimit, access.pass, access.resource,
                                           std::string("it is bound as ") + (isUniform ? "uniform" : "storage") +
                                               " buffer, and its size of " + std::to_string(size) +
                                               " is over what the device can bind",
                                           "stay within " + std::to_string(limit) + ", or split it", access.where));
  }
}

bool hasContent(const DeclaredResource& resource) {
  if (resource.imported()) return !resource.isImage || resource.before.layout != VK_IMAGE_LAYOUT_UNDEFINED;
  return resource.persistent();
}

void checkContent(const Declaration& declaration, const Cells& cells, Problems& problems) {
  std::vector<uint8_t> written(cells.count(), 0);
  for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
    if (!hasContent(declaration.resources[resource])) continue;
    for (uint32_t cell : cells.of(resource)) written[cell] = 1;
  }
  for (uint32_t index = 0; index < declaration.accesses.size(); ++index) {
    const DeclaredAccess& access = declaration.accesses[index];
    bool all = true;
    cells.forEach(index, [&](uint32_t cell) {
      all = all && written[cell];
      if (access.writes()) written[cell] = 1;
    });
    if (all || !access.needsContent()) continue;
    if (declaration.resources[access.resource].imported()) {
      problems.push_back(
          declaration.problem(Misuse::importState, access.pass, access.resource,
                              "its content is read, but it was imported in layout UNDEFINED, which has none",
                              "name the layout in which the host left it, or write it first", access.where));
    } else {
      const bool modifies = access.mode == AccessMode::modify;
      problems.push_back(declaration.problem(
          Misuse::unwrittenRead, access.pass, access.resource,
          modifies ? "its content is kept and changed, but nothing has written it"
                   : "it is read, but nothing has written it",
          modifies ? "write or clear the whole range first" : "write it in an earlier pass", access.where));
    }
  }
  for (uint32_t resource = 0; resource < declaration.resources.size(); ++resource) {
    const DeclaredResource& declared = declaration.resources[resource];
    if (!declared.exported || !declared.created()) continue;
    bool any = false;
    for (uint32_t cell : cells.of(resource)) any = any || written[cell];
    if (!any) {
      problems.push_back(declaration.problem(Misuse::unwrittenRead, kNone, resource,
                                             "it is exported, but nothing has written it",
                                             "write it in a pass before the export", declared.where));
    }
  }
}

void checkPasses(const Declaration& declaration, Problems& problems) {
  for (uint32_t pass = 0; pass < declaration.passes.size(); ++pass) {
    const DeclaredPass& declared = declaration.passes[pass];
    if (declared.kind != PassKind::raster) continue;
    if (declared.renderArea.width > 0 && declared.renderArea.height > 0 && declared.renderLayers > 0) continue;
    problems.push_back(declaration.problem(Misuse::sizeMismatch, pass, kNone,
                                           "a raster pass without attachments has no render area",
                                           "add an attachment or call renderArea()", declared.where));
  }
}

}  // namespace

std::vector<GraphError::Problem> findProblems(const Declaration& declaration, const Cells& cells,
                                              const DeviceFacts& device) {
  Problems problems = declaration.allProblems();
  checkContent(declaration, cells, problems);
  checkPasses(declaration, problems);
  checkLimits(declaration, device, problems);
  checkBoundRanges(declaration, device, problems);
  return problems;
}

}  // namespace lensgraph::rendergraph
