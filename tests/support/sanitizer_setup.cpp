// Part of every program in a sanitizer build: lets the leak sanitizer tell our leaks from Vulkan's.

// Vulkan's loader unloads drivers with the instance. What a driver keeps in globals (Mesa: its table of
// extensions) would then look lost, and its code has no name to suppress; kept loaded, both are found. This
// overrides the C library's.
extern "C" int dlclose(void* /*library*/) {
  return 0;
}

// The validation layer leaves cycles of its own state objects behind. Vulkan objects that we forget are not
// hidden by this: the layer reports them, and the tests on a device fail.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation.so\n";
}

// Standard error belongs to the program; tests compare it.
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() {
  return "print_suppressions=0";
}
