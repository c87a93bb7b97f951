// A growing array of plain records that is filled anew every frame. Unlike std::vector it constructs an element in
// place after the one comparison that adding needs, so that the compiler drops defaults which the caller overwrites.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>

namespace lensgraph::rendergraph {

template <class T>
class Records {
 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

  /// A new record at the end. References to others are lost when there was no room.
  [[gnu::always_inline]] T& add() {
    if (size_ == capacity_) [[unlikely]] {
      grow();
    }
    return *new (&data_[size_++]) T;
  }
  /// Forgets the records and keeps the memory.
  void clear() { size_ = 0; }

  uint32_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t index) { return data_[index]; }
  const T& operator[](std::size_t index) const { return data_[index]; }
  T& back() { return data_[size_ - 1]; }
  T* begin() { return data_.get(); }
  T* end() { return data_.get() + size_; }
  const T* begin() const { return data_.get(); }
  const T* end() const { return data_.get() + size_; }

 private:
  [[gnu::noinline]] void grow() {
    const uint32_t capacity = std::max(64u, 2 * capacity_);
    auto data = std::make_unique_for_overwrite<T[]>(capacity);
    std::copy(begin(), end(), data.get());
    data_ = std::move(data);
    capacity_ = capacity;
  }

  std::unique_ptr<T[]> data_;
  uint32_t size_ = 0, capacity_ = 0;
};

}  // namespace lensgraph::rendergraph
