// Views on demand.
#include "rendergraph/execute/frame/recording_context.h"

#include "rendergraph/execute/resources/error_names.h"
#include "rendergraph/execute/resources/view_cache.h"

namespace lensgraph::rendergraph {

VkImageView RecordingContext::viewOf(uint32_t resource, const Subresources& range, VkImageViewType type) {
  const DeclaredResource& declared = declaration->resources[resource];
  const ResourceObjects& object = objects[resource];
  const ViewDesc desc{.image = object.image, .format = declared.image.format, .type = type, .range = range};
  // One lock for all images: a lookup takes less time than the call that needs the view.
  const std::scoped_lock lock(views_);
  return namingResource(declared.name, [&] { return object.views->get(backend, desc, declared.name); });
}

}  // namespace lensgraph::rendergraph
