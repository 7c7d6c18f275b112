#include "app/bench_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace helical {
namespace {

void printLines(const nlohmann::ordered_json& value, const std::string& name) {
  if (value.is_object()) {
    for (const auto& [key, child] : value.items()) printLines(child, name.empty() ? key : name + " " + key);
  } else if (value.is_array()) {
    for (const auto& entry : value) printLines(entry, name + " " + std::to_string(&entry - &value.front()));
  } else if (value.is_number_float()) {
    std::printf("%-60s %.4g\n", name.c_str(), value.get<double>());
  } else {
    std::printf("%-60s %s\n", name.c_str(),
                value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
  }
}

}  // namespace

void printBenchReport(const nlohmann::ordered_json& report, bool as_json) {
  if (as_json)
    std::printf("%s\n", report.dump(2).c_str());
  else
    printLines(report, {});
}

}  // namespace helical
