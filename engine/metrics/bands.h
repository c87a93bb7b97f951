// Work on a picture in bands of rows, on every processor: what keeps the memory of a metric small and its time short.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace lensgraph::engine {

/// Rows of a picture: first, first + 1, … end - 1.
struct Band {
  uint32_t first = 0;
  uint32_t end = 0;
};

/// The bands of a picture, from the top: `rows` rows each (at least 1), the last one fewer.
std::vector<Band> bandsOf(uint32_t height, uint32_t rows);

/// Calls work(i) for i from 0 to count - 1, on as many threads as the machine has processors, in any order. Results must
/// not depend on that order; whoever sums keeps one sum for each i and adds them up afterwards. The first exception that
/// `work` throws is thrown again once all threads have ended.
void forEachInParallel(size_t count, const std::function<void(size_t)>& work);

}  // namespace lensgraph::engine
