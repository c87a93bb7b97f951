// The measured figures as Markdown, so that nobody types them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lensgraph::bench {

/// `results`: what main.cpp writes.
std::string markdown(const nlohmann::ordered_json& results);

}  // namespace lensgraph::bench
