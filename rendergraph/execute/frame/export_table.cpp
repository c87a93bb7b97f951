// Copies the table of the frame, and which of its resources were exported.
#include "rendergraph/execute/frame/export_table.h"

#include "rendergraph/declare/declaration.h"

namespace lensgraph::rendergraph {

void ExportTable::take(const Declaration& declaration, const ResourceTable& table) {
  serial = declaration.serial;
  objects = table;
  exported.clear();
  sizes.clear();
  for (const DeclaredResource& resource : declaration.resources) {
    exported.push_back(resource.exported);
    sizes.push_back(resource.isImage ? 0 : resource.buffer.size);
  }
}

}  // namespace lensgraph::rendergraph
