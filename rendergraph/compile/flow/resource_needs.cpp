// Usage flags are the union over the accesses of living passes; the device says what memory the object then takes.
#include "rendergraph/compile/flow/resource_needs.h"

#include "rendergraph/declare/access_table.h"
#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

std::vector<ResourceNeed> findResourceNeeds(const Declaration& declaration, std::span<const uint8_t> alive,
                                            const DeviceFacts& device) {
  std::vector<ResourceNeed> needs(declaration.resources.size());
  for (const DeclaredAccess& access : declaration.accesses) {
    if (!alive[access.pass]) continue;
    const AccessRules& rules = rulesOf(access.usage, access.mode);
    ResourceNeed& need = needs[access.resource];
    need.used = true;
    need.image |= rules.imageUsage;
    need.buffer |= rules.bufferUsage;
  }
  for (uint32_t index = 0; index < needs.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    ResourceNeed& need = needs[index];
    if (!need.used) continue;
    // The executor zeroes what it keeps.
    if (resource.isImage) {
      need.image |= resource.image.extraUsage | (resource.persistent() ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : 0);
      need.buffer = 0;
    } else {
      need.buffer |= resource.buffer.extraUsage | (resource.persistent() ? VK_BUFFER_USAGE_TRANSFER_DST_BIT : 0);
      need.image = 0;
    }
    if (!resource.created()) continue;
    need.requirements = resource.isImage ? device.requirements(resource.image, need.image)
                                         : device.requirements(resource.buffer, need.buffer);
  }
  return needs;
}

}  // namespace lensgraph::rendergraph
