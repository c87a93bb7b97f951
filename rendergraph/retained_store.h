// What an executor keeps across frames: persistent images and buffers, and the two sides of histories.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rendergraph/binding_table.h"
#include "rendergraph/owned.h"
#include "rendergraph/plan.h"
#include "rendergraph/view_cache.h"

namespace rendergraph {

struct Declaration;
struct DeclaredResource;

class RetainedStore {
 public:
  explicit RetainedStore(Backend& backend) : backend_(backend) {}

  /// Makes what the plan needs and does not exist, or has another description or too few usage flags; enters all of it
  /// into the table. Throws GraphError (device) that names the resource.
  void prepare(const Declaration& declaration, const Plan& plan, BindingTable& table);

  /// Records the zeroing of what is new, and the change of layout where another plan left a different one.
  void recordStart(VkCommandBuffer commands);

  /// The frame was submitted: new content is valid, and histories whose next side it wrote have changed places.
  void commit();
  /// The frame broke off after a part of it was submitted: content and layouts are unknown, so they are zeroed anew.
  void invalidate();

  void clear();

 private:
  struct Side {
    OwnedHeap heap;
    OwnedImage image;
    OwnedBuffer buffer;
    ViewCache views;
    std::byte* address = nullptr;
    bool valid = false;  // Zeroed or written, and in `layout`.
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  };
  struct Entry {
    bool isImage = true;
    ImageDesc imageDesc;
    BufferDesc bufferDesc;
    VkImageUsageFlags imageUsage = 0;
    VkBufferUsageFlags bufferUsage = 0;
    uint32_t previous = 0;      // Side that is History::previous.
    std::array<Side, 2> sides;  // A persistent resource has only the first.
  };
  /// One resource of the current frame.
  struct Current {
    Entry* entry;
    Side* side;
    VkImageLayout restLayout;
    bool swaps;  // The written next side of a history.
  };

  Entry& entryFor(const DeclaredResource& resource, const RetainedResource& retained);
  void make(const DeclaredResource& resource, const Entry& entry, Side& side);
  void recordZero(VkCommandBuffer commands, const Current& current);
  void barrier(VkCommandBuffer commands, const Current& current, VkImageLayout from, VkImageLayout to);

  Backend& backend_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::vector<Current> current_;
};

}  // namespace rendergraph
