// The code of tinygltf; see tiny_gltf.h.
#define TINYGLTF_IMPLEMENTATION
// Without files tinygltf forgets what its writer needs.
#include <fstream>
#include <sstream>

#include "engine/gltf/read/tiny_gltf.h"
