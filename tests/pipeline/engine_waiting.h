#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "engine/pipeline/engine.h"

namespace helical {

/// Reads the engine until `condition` holds; generous, for slow and busy machines.
inline bool waitUntil(Engine& engine, const std::function<bool(const EngineSnapshot&)>& condition) {
  using namespace std::chrono_literals;
  const auto give_up = std::chrono::steady_clock::now() + 120s;
  while (std::chrono::steady_clock::now() < give_up) {
    if (engine.poll() && condition(engine.snapshot())) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

}  // namespace helical
