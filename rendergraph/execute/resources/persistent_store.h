// What an executor keeps across frames: persistent images and buffers, and the two sides of histories. They exist once,
// however many frames are in flight: what one frame leaves, the next one finds.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rendergraph/execute/resources/deletion_queue.h"
#include "rendergraph/execute/resources/graph_objects.h"
#include "rendergraph/execute/resources/resource_table.h"
#include "rendergraph/plan.h"

namespace lensgraph::rendergraph {

struct Declaration;
struct DeclaredResource;

class PersistentStore {
 public:
  /// Frames in flight may use what is replaced.
  PersistentStore(Backend& backend, DeletionQueue& deletionQueue) : backend_(backend), deletionQueue_(deletionQueue) {}

  /// Makes what the plan needs and does not exist, or has another description or too few usage flags; enters all of it
  /// into the table. Throws GraphError (outOfMemory, device) that names the resource.
  void prepare(const Declaration& declaration, const Plan& plan, ResourceTable& table);

  /// Whether the frame begins with commands of its own, on the first queue: the zeroing of what is new, and the change
  /// of layout where another plan left a different one.
  bool needsStart() const;
  /// Records them. What precedes them on the device has finished.
  void recordStart(const CommandStream& commands);

  /// The frame was submitted: new content is valid, and histories whose next side it wrote have changed places.
  void commit();
  /// The frame broke off after a part of it was submitted: content and layouts are unknown, so they are zeroed anew.
  void invalidate();
  /// The same for all that is kept: nobody knows which frames were carried out.
  void invalidateAll();

  void clear();

 private:
  struct Side {
    GraphObject object;
    bool valid = false;  // Zeroed or written, and in `layout`.
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  };
  struct Entry {
    bool isImage = true;
    ImageDesc imageDesc;
    BufferDesc bufferDesc;
    VkImageUsageFlags imageUsage = 0;
    VkBufferUsageFlags bufferUsage = 0;
    bool concurrent = false;
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

  Entry& entryFor(const DeclaredResource& resource, const PersistentResource& persistent);
  void make(const DeclaredResource& resource, const Entry& entry, Side& side);
  void retire(Entry& entry);
  void recordZero(const CommandStream& commands, const Current& current);
  void barrier(const CommandStream& commands, const Current& current, VkImageLayout from, VkImageLayout to);

  Backend& backend_;
  DeletionQueue& deletionQueue_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::vector<Current> current_;
};

}  // namespace lensgraph::rendergraph
