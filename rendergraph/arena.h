// Memory of one declaration: names and recordings lie behind each other in blocks that reset() keeps, so that an
// unchanged frame re-declares without asking the heap for anything.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

namespace rendergraph {

class Arena {
 public:
  /// Uninitialised bytes, valid until reset(). `alignment` is a power of two, at most that of max_align_t.
  void* allocate(std::size_t size, std::size_t alignment) {
    while (current_ < blocks_.size()) {
      const std::size_t offset = (used_ + alignment - 1) & ~(alignment - 1);
      if (offset + size <= blocks_[current_].size) {
        used_ = offset + size;
        return blocks_[current_].bytes.get() + offset;
      }
      ++current_;
      used_ = 0;
    }
    const std::size_t blockSize = size > kBlockSize ? size : kBlockSize;
    blocks_.push_back({std::make_unique<std::byte[]>(blockSize), blockSize});
    used_ = size;
    return blocks_.back().bytes.get();
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
  static constexpr std::size_t kBlockSize = 16 * 1024;  // Bytes; a typical frame needs one or two blocks.
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size;
  };
  std::vector<Block> blocks_;
  std::size_t current_ = 0;  // Block being filled.
  std::size_t used_ = 0;     // Bytes used of it.
};

}  // namespace rendergraph
