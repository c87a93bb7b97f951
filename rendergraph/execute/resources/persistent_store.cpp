// Persistent content: made, zeroed, kept, swapped.
#include "rendergraph/execute/resources/persistent_store.h"

#include <algorithm>
#include <string>
#include <utility>

#include "rendergraph/declare/declaration.h"
#include "rendergraph/execute/resources/error_names.h"

namespace lensgraph::rendergraph {

namespace {

bool written(const Declaration& declaration, const Plan& plan, uint32_t resource) {
  for (const PlannedPass& pass : plan.passes) {
    for (const DeclaredAccess& access : declaration.accessesOfPass(pass.pass)) {
      if (access.resource == resource && access.writes()) return true;
    }
  }
  return false;
}

}  // namespace

PersistentStore::Entry& PersistentStore::entryFor(const DeclaredResource& resource,
                                                  const PersistentResource& persistent) {
  auto found = entries_.find(resource.key);
  if (found == entries_.end()) found = entries_.emplace(std::string(resource.key), Entry{}).first;
  Entry& entry = found->second;
  const bool sameShape =
      entry.isImage == resource.isImage && entry.imageDesc == resource.image && entry.bufferDesc == resource.buffer;
  const bool same = sameShape && (persistent.imageUsage & ~entry.imageUsage) == 0 &&
                    (persistent.bufferUsage & ~entry.bufferUsage) == 0 && (entry.concurrent || !persistent.concurrent);
  if (!same) {
    retire(entry);
    // Flags are kept, so that two graphs that use it differently settle on one object.
    entry = Entry{.isImage = resource.isImage,
                  .imageDesc = resource.image,
                  .bufferDesc = resource.buffer,
                  .imageUsage = (sameShape ? entry.imageUsage : 0) | persistent.imageUsage,
                  .bufferUsage = (sameShape ? entry.bufferUsage : 0) | persistent.bufferUsage,
                  .concurrent = (sameShape && entry.concurrent) || persistent.concurrent,
                  .previous = 0,
                  .sides = {}};
  }
  return entry;
}

void PersistentStore::retire(Entry& entry) {
  for (Side& side : entry.sides) {
    if (side.object.heap) deletionQueue_.add(std::move(side));
    side = Side{};
  }
}

void PersistentStore::make(const DeclaredResource& resource, const Entry& entry, Side& side) {
  const ObjectRequest request{.isImage = entry.isImage,
                              .imageDesc = entry.imageDesc,
                              .bufferDesc = entry.bufferDesc,
                              .imageUsage = entry.imageUsage,
                              .bufferUsage = entry.bufferUsage,
                              .concurrent = entry.concurrent,
                              .name = resource.key};
  const MemoryRequirements needs = entry.isImage ? backend_.requirements(entry.imageDesc, entry.imageUsage)
                                                 : backend_.requirements(entry.bufferDesc, entry.bufferUsage);
  Side made;
  if (needs.dedicated) {
    made.object = makeDedicated(backend_, request);
  } else {
    const MemoryKind memory = entry.isImage ? MemoryKind::device : entry.bufferDesc.memory;
    UniqueHeap heap(backend_, backend_.createHeap(needs.size, needs.memoryTypeBits, memory, resource.name));
    made.object = makeInHeap(backend_, request, heap.get(), 0);
    made.object.heap = std::move(heap);
  }
  side = std::move(made);
}

void PersistentStore::prepare(const Declaration& declaration, const Plan& plan, ResourceTable& table) {
  current_.clear();
  // Both sides of a history share the flags, so all entries are settled before anything is made.
  for (const PersistentResource& persistent : plan.persistent) {
    entryFor(declaration.resources[persistent.resource], persistent);
  }
  for (const PersistentResource& persistent : plan.persistent) {
    const DeclaredResource& resource = declaration.resources[persistent.resource];
    Entry& entry = entryFor(resource, persistent);
    const uint32_t index = resource.origin == Origin::persistent        ? 0
                           : resource.origin == Origin::historyPrevious ? entry.previous
                                                                        : 1 - entry.previous;
    Side& side = entry.sides[index];
    if (!side.object.heap) namingResource(resource.name, [&] { make(resource, entry, side); });
    current_.push_back(
        {.entry = &entry,
         .side = &side,
         .restLayout = persistent.restLayout,
         .swaps = resource.origin == Origin::historyNext && written(declaration, plan, persistent.resource)});
    table[persistent.resource] = side.object.entry();
  }
}

void PersistentStore::barrier(const CommandStream& commands, const Current& current, VkImageLayout from,
                              VkImageLayout to) {
  // Rare (first frame, change of plan), so the widest scopes are good enough.
  VkMemoryBarrier2 memory{};
  memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  memory.srcStageMask = memory.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  VkImageMemoryBarrier2 image{};
  VkBufferMemoryBarrier2 buffer{};
  if (current.entry->isImage) {
    image.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    image.srcStageMask = memory.srcStageMask;
    image.srcAccessMask = memory.srcAccessMask;
    image.dstStageMask = memory.dstStageMask;
    image.dstAccessMask = memory.dstAccessMask;
    image.oldLayout = from;
    image.newLayout = to;
    image.srcQueueFamilyIndex = image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    image.image = current.side->object.image.get();
    image.subresourceRange = {aspectsOf(current.entry->imageDesc.format), 0, VK_REMAINING_MIP_LEVELS, 0,
                              VK_REMAINING_ARRAY_LAYERS};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &image;
  } else {
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
    buffer.srcStageMask = memory.srcStageMask;
    buffer.srcAccessMask = memory.srcAccessMask;
    buffer.dstStageMask = memory.dstStageMask;
    buffer.dstAccessMask = memory.dstAccessMask;
    buffer.srcQueueFamilyIndex = buffer.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    buffer.buffer = current.side->object.buffer.get();
    buffer.size = VK_WHOLE_SIZE;
    dependency.bufferMemoryBarrierCount = 1;
    dependency.pBufferMemoryBarriers = &buffer;
  }
  backend_.barrier(commands, dependency);
}

void PersistentStore::recordZero(const CommandStream& commands, const Current& current) {
  const VkImage image = current.side->object.image.get();
  if (!current.entry->isImage) {
    backend_.fillBuffer(commands, current.side->object.buffer.get(), 0, VK_WHOLE_SIZE);
    barrier(commands, current, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_UNDEFINED);
    return;
  }
  const ImageDesc& desc = current.entry->imageDesc;
  const VkImageSubresourceRange range{aspectsOf(desc.format), 0, desc.mips, 0, desc.layers};
  barrier(commands, current, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  if ((range.aspectMask & VK_IMAGE_ASPECT_COLOR_BIT) != 0) {
    backend_.clearImage(commands, image, VkClearColorValue{}, range);
  } else {
    backend_.clearDepthImage(commands, image, 0.0f, range);
  }
  barrier(commands, current, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, current.restLayout);
}

bool PersistentStore::needsStart() const {
  return std::ranges::any_of(current_, [](const Current& current) {
    return !current.side->valid || (current.entry->isImage && current.side->layout != current.restLayout);
  });
}

void PersistentStore::recordStart(const CommandStream& commands) {
  for (const Current& current : current_) {
    if (!current.side->valid) {
      recordZero(commands, current);
    } else if (current.entry->isImage && current.side->layout != current.restLayout) {
      barrier(commands, current, current.side->layout, current.restLayout);
    }
  }
}

void PersistentStore::commit() {
  for (const Current& current : current_) {
    current.side->valid = true;
    current.side->layout = current.restLayout;
    if (current.swaps) current.entry->previous = 1 - current.entry->previous;
  }
  current_.clear();
}

void PersistentStore::invalidate() {
  for (const Current& current : current_) current.side->valid = false;
  current_.clear();
}

void PersistentStore::invalidateAll() {
  for (auto& [key, entry] : entries_) {
    for (Side& side : entry.sides) side.valid = false;
  }
}

void PersistentStore::clear() {
  current_.clear();
  for (auto& [key, entry] : entries_) retire(entry);
  entries_.clear();
}

}  // namespace lensgraph::rendergraph
