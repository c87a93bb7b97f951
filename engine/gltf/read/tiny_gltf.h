// tinygltf, compiled into the engine under a name of its own. Debian's libdraco carries a tinygltf of another version and
// exports its symbols: a program that links both would call the wrong one. Private to engine/gltf.
#pragma once

#define tinygltf lensgraph_tinygltf
// Files and images are read in uri.cpp and image.cpp.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
