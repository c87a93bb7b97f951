// Turns the JSON of measurements into the Markdown tables of docs/rendergraph_measured.md.
#include "tables.h"

#include <cstdio>
#include <initializer_list>

namespace lensgraph::bench {

namespace {

using nlohmann::ordered_json;

std::string format(const char* how, double value) {
  char text[32];
  std::snprintf(text, sizeof text, how, value);
  return text;
}

std::string line(std::initializer_list<std::string> cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string speedCell(const ordered_json& speed, const std::string& step, const char* workload, const char* field,
                      const char* how) {
  std::string cell;
  for (int passes : {10, 100, 1000, 10000}) {
    for (const ordered_json& row : speed) {
      if (row["step"] != step || row["workload"] != workload || row["passes"] != passes) continue;
      cell += (cell.empty() ? "" : " / ") + format(how, row[field]);
    }
  }
  return cell;
}

std::string speedTable(const ordered_json& speed) {
  std::string text = line({"CPU ns per pass at 10 / 100 / 1000 / 10 000 passes", "chain2", "dag16", "wide8"});
  text += "|---|---|---|---|\n";
  for (const char* step : {"declare", "declare+hash", "unchanged frame", "compile, no aliasing", "compile, fast",
                           "compile, best", "pack, fast", "pack, best"}) {
    const bool compiles = std::string_view(step).starts_with("compile");
    const auto cell = [&](const char* workload) { return speedCell(speed, step, workload, "leastNsPerPass", "%.0f"); };
    text += line({(compiles ? "declare + " : "") + std::string(step), cell("chain2"), cell("dag16"), cell("wide8")});
  }
  const auto cell = [&](const char* workload) {
    return speedCell(speed, "unchanged frame", workload, "allocations", "%.0f");
  };
  return text + line({"heap allocations in an unchanged frame", cell("chain2"), cell("dag16"), cell("wide8")});
}

/// The two ways of declaring a compute pass, on chain2 with a dispatch of three bindings and 32 bytes of constants.
std::string dispatchTable(const ordered_json& speed) {
  std::string text =
      line({"CPU ns per pass at 10 / 100 / 1000 / 10 000 passes", "`Pass`", "`ComputePass`"}) + "|---|---|---|\n";
  for (const char* step : {"declare dispatches", "unchanged frame of dispatches"}) {
    const auto cell = [&](const char* form) {
      return speedCell(speed, std::string(step) + ", " + form, "chain2", "leastNsPerPass", "%.0f");
    };
    text += line({step, cell("Pass"), cell("ComputePass")});
  }
  return text;
}

std::string aliasingTable(const ordered_json& rows) {
  std::string text =
      line({"heap ÷ largest live sum, mean (worst)", "chain2", "dag16", "wide8"}) + "|---|---|---|---|\n";
  for (const char* level : {"fast", "best"}) {
    const auto cell = [&](const char* workload) {
      for (const ordered_json& row : rows) {
        if (row["level"] != level || row["workload"] != workload) continue;
        return format("%.3f", row["meanHeapPerBound"]) + " (" + format("%.2f", row["worstHeapPerBound"]) + ")";
      }
      return std::string();
    };
    text += line({"`Aliasing::" + std::string(level) + "`", cell("chain2"), cell("dag16"), cell("wide8")});
  }
  return text;
}

std::string batchesTable(const ordered_json& rows) {
  std::string text = line({"order", "memory budget", "batches, mean (most)", "bytes ÷ bound, mean (worst)"});
  text += "|---|---|---|---|\n";
  for (const ordered_json& row : rows) {
    const ordered_json budget = row.value("memoryBudget", ordered_json("–"));
    text += line({"`" + std::string(row["order"]) + "`",
                  budget.is_number() ? format("%.2f", budget) : budget.get<std::string>(),
                  format("%.1f", row["meanBatches"]) + " (" + format("%.0f", row["mostBatches"]) + ")",
                  format("%.3f", row["meanBytesPerBound"]) + " (" + format("%.2f", row["worstBytesPerBound"]) + ")"});
  }
  return text;
}

std::string techniquesTable(const ordered_json& rows) {
  std::string text = line({"technique", "size", "passes", "barrier batches", "heap, MiB", "heap ÷ bound",
                           "unaliased ÷ heap", "compile fast / best, µs"});
  text += "|---|---|---|---|---|---|---|---|\n";
  for (const ordered_json& row : rows) {
    const double peak = row["peakBytes"], bound = row["lowerBound"], unaliased = row["unaliasedBytes"];
    const double width = row["width"], height = row["height"], passes = row["passes"], batches = row["batches"];
    text += line({std::string(row["technique"]), format("%.0f", width) + "×" + format("%.0f", height),
                  format("%.0f", passes), format("%.0f", batches), format("%.1f", peak / (1 << 20)),
                  format("%.3f", bound > 0 ? peak / bound : 1.0), format("%.2f", peak > 0 ? unaliased / peak : 1.0),
                  format("%.0f", row["compileFastUs"]) + " / " + format("%.0f", row["compileBestUs"])});
  }
  return text;
}

}  // namespace

std::string markdown(const ordered_json& results) {
  return speedTable(results.at("speed")) + "\n" + dispatchTable(results.at("speed")) + "\n" +
         aliasingTable(results.at("aliasing")) + "\n" + batchesTable(results.at("batches")) + "\n" +
         techniquesTable(results.at("techniques"));
}

}  // namespace lensgraph::bench
