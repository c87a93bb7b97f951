// Memory of one declaration: names and recordings lie behind each other in blocks that reset() keeps, so that an
// unchanged frame re-declares without asking the heap for anything.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

namespace lensgraph::rendergraph {

class Arena {
 public:
  /// Uninitialised bytes, valid until reset(). `alignment` is a power of two, at most that of max_align_t.
  void* allocate(std::size_t size, std::size_t alignment) {
    const std::size_t offset = (used_ + alignment - 1) & ~(alignment - 1);
    if (current_ < blocks_.size() && offset + size <= blocks_[current_].size) [[likely]] {
      used_ = offset + size;
      return blocks_[current_].bytes.get() + offset;
    }
    return allocateInNextBlock(size);
  }
  /// A copy of the text.
  std::string_view copy(std::string_view text) {
    if (text.empty()) return {};
    char* to = static_cast<char*>(allocate(text.size(), 1));
    std::memcpy(to, text.data(), text.size());
    return {to, text.size()};
  }

  /// Forgets the content and keeps the blocks.
  void reset() { current_ = used_ = 0; }

 private:
  void* allocateInNextBlock(std::size_t size) {
    while (++current_ < blocks_.size()) {
      if (size > blocks_[current_].size) continue;
      used_ = size;
      return blocks_[current_].bytes.get();
    }
    const std::size_t blockSize = size > kBlockSize ? size : kBlockSize;
    blocks_.push_back({std::make_unique<std::byte[]>(blockSize), blockSize});
    current_ = blocks_.size() - 1;
    used_ = size;
    return blocks_.back().bytes.get();
  }

  static constexpr std::size_t kBlockSize = 16 * 1024;  // Bytes; a typical frame needs one or two blocks.
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size;
  };
  std::vector<Block> blocks_;
  std::size_t current_ = 0;  // Block being filled.
  std::size_t used_ = 0;     // Bytes used of it.
};

}  // namespace lensgraph::rendergraph
