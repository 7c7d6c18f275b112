#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "app/bench_markers.h"
#include "app/bench_particles.h"
#include "app/bench_session.h"
#ifdef HELICAL_HAS_WINDOW
#include "app/bench_pipeline.h"
#endif

namespace {

constexpr int kFailed = 1, kBadUsage = 2;

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Helical's benchmarks: side by side in one process, medians of the thread's processor time",
               "helical-bench");
  helical::addMarkersBench(app);
  helical::addParticlesBench(app);
  helical::addSessionBench(app);
#ifdef HELICAL_HAS_WINDOW
  helical::addPipelineBench(app);
#endif
  app.require_subcommand(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kFailed;
  }
  return 0;
}
