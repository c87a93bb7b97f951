// Cases and shards: see bench_case.h.
#include "samples/lensgraph/bench/bench_case.h"

#include <charconv>

#include "engine/error.h"
#include "engine/image/image_io.h"
#include "samples/lensgraph/bench/names.h"

namespace lensgraph::cli {
namespace {

/// Whether the shard takes pair `index` of all `count`.
bool takes(const Shard& shard, std::size_t index, std::size_t count) {
  const auto border = [&](int part) {
    return count * static_cast<std::size_t>(part) / static_cast<std::size_t>(shard.count);
  };
  return index >= border(shard.index - 1) && index < border(shard.index);
}

void requireSize(const std::filesystem::path& reference, const host::Shot& shot) {
  const auto picture = engine::readImage(reference);
  const bool fits = static_cast<int>(picture.width) == shot.width && static_cast<int>(picture.height) == shot.height;
  if (fits) return;
  throw engine::Error({.file = reference.string(),
                       .field = "reference",
                       .reason = "is " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                                 " px, the shot is rendered in " + std::to_string(shot.width) + "x" +
                                 std::to_string(shot.height),
                       .remedy = "leave out the reference, or choose its size"});
}

}  // namespace

std::optional<Shard> shardFrom(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool hasSlash = index.ec == std::errc{} && index.ptr != end && *index.ptr == '/';
  const auto count = hasSlash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  const bool isPart =
      hasSlash && count.ec == std::errc{} && count.ptr == end && shard.index >= 1 && shard.index <= shard.count;
  if (!isPart) return {};
  return shard;
}

std::string nameOf(const Shard& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

std::vector<BenchCase> casesOf(const BenchConfig& config, const Shard& shard) {
  std::vector<BenchSize> sizes = config.sizes;
  if (sizes.empty()) sizes.push_back({});
  const std::size_t pairs = config.shots.size() * sizes.size() * config.variants.size();
  std::vector<BenchCase> cases;
  std::size_t pair = 0;
  for (const BenchShot& benchShot : config.shots) {
    host::Shot shot = host::readShot(benchShot.shot);
    for (const BenchSize& size : sizes) {
      if (size.width > 0) {
        shot.width = size.width;
        shot.height = size.height;
      }
      BenchCase each{
          .id = {}, .shotId = shotId(benchShot.shot), .shot = shot, .reference = benchShot.reference, .variants = {}};
      each.id = each.shotId + "_" + std::to_string(shot.width) + "x" + std::to_string(shot.height);
      for (const BenchVariant& variant : config.variants) {
        if (takes(shard, pair++, pairs)) each.variants.push_back(variant);
      }
      if (each.variants.empty()) continue;
      if (each.reference) requireSize(*each.reference, shot);
      cases.push_back(std::move(each));
    }
  }
  return cases;
}

}  // namespace lensgraph::cli
