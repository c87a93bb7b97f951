// Every replaceable form of operator new and delete, on malloc and free. All of them, since a sanitizer's runtime brings
// its own for those that a program leaves out, and memory from one must not be given back through the other.
#include "allocation_count.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<uint64_t> allocations = 0;

void* counted(std::size_t size) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return std::malloc(size == 0 ? 1 : size);
}

void* counted(std::size_t size, std::align_val_t alignment) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  const auto step = static_cast<std::size_t>(alignment);
  // aligned_alloc() takes multiples of the alignment only.
  return std::aligned_alloc(step, size == 0 ? step : (size + step - 1) / step * step);
}

void* orThrow(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

namespace test_support {
uint64_t allocationsSoFar() {
  return allocations.load(std::memory_order_relaxed);
}
}  // namespace test_support

using Size = std::size_t;
using Alignment = std::align_val_t;
using Nothrow = std::nothrow_t;

// clang-format off: a table of signatures.
void* operator new(Size size) {
  return orThrow(counted(size));
}
void* operator new[](Size size) {
  return orThrow(counted(size));
}
void* operator new(Size size, const Nothrow&) noexcept {
  return counted(size);
}
void* operator new[](Size size, const Nothrow&) noexcept {
  return counted(size);
}
void* operator new(Size size, Alignment alignment) {
  return orThrow(counted(size, alignment));
}
void* operator new[](Size size, Alignment alignment) {
  return orThrow(counted(size, alignment));
}
void* operator new(Size size, Alignment alignment, const Nothrow&) noexcept {
  return counted(size, alignment);
}
void* operator new[](Size size, Alignment alignment, const Nothrow&) noexcept {
  return counted(size, alignment);
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, Size) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, Size) noexcept {
  std::free(memory);
}
void operator delete(void* memory, const Nothrow&) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, const Nothrow&) noexcept {
  std::free(memory);
}
void operator delete(void* memory, Alignment) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, Alignment) noexcept {
  std::free(memory);
}
void operator delete(void* memory, Size, Alignment) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, Size, Alignment) noexcept {
  std::free(memory);
}
void operator delete(void* memory, Alignment, const Nothrow&) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, Alignment, const Nothrow&) noexcept {
  std::free(memory);
}
// clang-format on
