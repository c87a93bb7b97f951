#include "rendergraph/compile/flow/resource_needs.h"

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

std::vector<ResourceUse> findUses(const Declaration& declaration, std::span<const uint8_t> alive,
                                  const DeviceFacts& device) {
  std::vector<ResourceUse> uses(declaration.resources.size());
  for (const DeclaredAccess& access : declaration.accesses) {
    if (!alive[access.pass]) continue;
    const AccessRules& rules = rulesOf(access.usage, access.mode);
    ResourceUse& use = uses[access.resource];
    use.used = true;
    use.image |= rules.imageUsage;
    use.buffer |= rules.bufferUsage;
  }
  for (uint32_t index = 0; index < uses.size(); ++index) {
    const DeclaredResource& resource = declaration.resources[index];
    ResourceUse& use = uses[index];
    if (!use.used) continue;
    // The executor zeroes what it keeps.
    if (resource.isImage) {
      use.image |= resource.image.extraUsage | (resource.retained() ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : 0);
      use.buffer = 0;
    } else {
      use.buffer |= resource.buffer.extraUsage | (resource.retained() ? VK_BUFFER_USAGE_TRANSFER_DST_BIT : 0);
      use.image = 0;
    }
    if (!resource.created()) continue;
    use.requirements = resource.isImage ? device.requirements(resource.image, use.image)
                                        : device.requirements(resource.buffer, use.buffer);
  }
  return uses;
}

}  // namespace lensgraph::rendergraph
